// SPDX-License-Identifier: Apache-2.0
// How long all solutions of the gallery's systems take, with one thread and with two.
#include "gallery_bench.h"

namespace {

using namespace hcsp;

void solve_all(benchmark::State& state, const lang::CompiledModel& model) {
  const SearchOptions options = gallery_bench::options_of(model, state);
  Result result;
  for (auto _ : state) result = model.problem->solve_all(options);
  state.counters["cells"] = static_cast<double>(result.search->cells);
  state.counters["boxes"] = static_cast<double>(result.search->solutions.size());
}

}  // namespace

int main(int argc, char** argv) {
  return gallery_bench::run(argc, argv, lang::SolveItem::Goal::all, solve_all);
}
