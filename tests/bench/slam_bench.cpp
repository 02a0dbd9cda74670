// SPDX-License-Identifier: Apache-2.0
// The solve phase of range-only SLAM: the shipped room, finer cells, a mission twice as long, and the general
// path that any other sensor takes. Ratios in one run are what to compare.
#include <benchmark/benchmark.h>

#include <stdexcept>
#include <string>

#include "lang/lang.h"

namespace {

std::string model_path(const std::string& name) {
  return std::string(HCSP_SOURCE_DIR) + "/models/slam/" + name;
}

void solve(benchmark::State& state, const std::string& model, const std::string& eps) {
  hcsp::lang::CompileOptions options;
  options.parameters["eps"] = eps;
  const auto compiled = hcsp::lang::compile_file(model_path(model), options);
  if (!compiled.model) throw std::runtime_error("the model does not compile");
  hcsp::PropagationOptions run;
  for (auto _ : state) benchmark::DoNotOptimize(compiled.model->problem->propagate(run));
}

void compile(benchmark::State& state, const std::string& model) {
  for (auto _ : state) benchmark::DoNotOptimize(hcsp::lang::compile_file(model_path(model)));
}

BENCHMARK_CAPTURE(solve, room_0_05, "slam.hcsp", "0.05")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, room_0_02, "slam.hcsp", "0.02")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, room_0_1, "slam.hcsp", "0.1")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, curves_0_05, "curves.hcsp", "0.05")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(solve, aperture_0_05, "aperture.hcsp", "0.05")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(compile, room, "slam.hcsp")->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
