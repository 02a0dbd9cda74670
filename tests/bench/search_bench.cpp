// SPDX-License-Identifier: Apache-2.0
// How long all solutions of the gallery's systems take, with one thread and with two.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "lang/lang.h"

namespace {

using namespace hcsp;

void solve_all(benchmark::State& state, const std::string& path) {
  lang::Compilation compilation = lang::compile_file(path);
  if (!compilation.model) return state.SkipWithError(compilation.diagnostics.text().c_str());
  if (compilation.model->goal != lang::SolveItem::Goal::all) return state.SkipWithError("no `solve all`");
  SearchOptions options;
  options.precision = compilation.model->precision;
  options.threads = static_cast<unsigned>(state.range(0));
  Result result;
  for (auto _ : state) result = compilation.model->problem->solve_all(options);
  state.counters["cells"] = static_cast<double>(result.search->cells);
  state.counters["boxes"] = static_cast<double>(result.search->solutions.size());
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::filesystem::path> models;
  for (const auto& file : std::filesystem::directory_iterator(HCSP_SOURCE_DIR "/models/gallery"))
    models.push_back(file.path());
  std::sort(models.begin(), models.end());
  for (const auto& model : models) {
    const lang::Compilation compilation = lang::compile_file(model);
    if (!compilation.model || compilation.model->goal != lang::SolveItem::Goal::all) continue;
    benchmark::RegisterBenchmark(model.stem().c_str(), solve_all, model.string())
        ->Arg(1)
        ->Arg(2)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
