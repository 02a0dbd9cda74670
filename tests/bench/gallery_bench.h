// SPDX-License-Identifier: Apache-2.0
// A benchmark of the gallery's models of one goal, each with one thread and with two.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "lang/lang.h"

namespace hcsp::gallery_bench {

/// The options that a model asks for, with the threads of a benchmark's argument.
inline SearchOptions options_of(const lang::CompiledModel& model, const benchmark::State& state) {
  SearchOptions options;
  options.precision = model.precision;
  options.threads = static_cast<unsigned>(state.range(0));
  return options;
}

/// Runs `measure` on each model that has the goal.
inline int run(int argc, char** argv, lang::SolveItem::Goal goal,
               void (*measure)(benchmark::State& state, const lang::CompiledModel& model)) {
  std::vector<std::filesystem::path> paths;
  for (const auto& file : std::filesystem::directory_iterator(HCSP_SOURCE_DIR "/models/gallery"))
    paths.push_back(file.path());
  std::sort(paths.begin(), paths.end());
  std::vector<lang::Compilation> models;
  models.reserve(paths.size());
  for (const auto& path : paths) {
    lang::Compilation compilation = lang::compile_file(path);
    if (!compilation.model || compilation.model->goal != goal) continue;
    const lang::CompiledModel& model = *models.emplace_back(std::move(compilation)).model;
    benchmark::RegisterBenchmark(path.stem().c_str(),
                                 [measure, &model](benchmark::State& state) { measure(state, model); })
        ->Arg(1)
        ->Arg(2)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace hcsp::gallery_bench
