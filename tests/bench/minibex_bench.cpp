// SPDX-License-Identifier: Apache-2.0
// Every Minibex file of a folder on one thread and on two: seconds to read it, seconds to solve it, cells,
// and how many boxes have which certificate. What a limit stops is marked with a star.
//   minibex_bench FOLDER [SECONDS]        SECONDS a file and number of threads, 60 when none are given
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "lang/lang.h"
#include "lang/minibex/minibex.h"

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void solve(const hcsp::lang::CompiledModel& model, unsigned threads, double limit) {
  hcsp::SearchOptions options;
  options.precision = model.precision;
  options.threads = threads;
  options.time_limit = limit;
  const hcsp::Result result = model.problem->solve_all(options);
  std::size_t unique = 0, exists = 0;
  for (const hcsp::Solution& solution : result.search->solutions) {
    unique += solution.certificate == hcsp::Certificate::unique ? 1 : 0;
    exists += solution.certificate == hcsp::Certificate::exists ? 1 : 0;
  }
  const std::size_t boxes = result.search->solutions.size();
  fmt::print("{:>10.4f}{} {:>9} {:>6} {:>6} {:>6}", result.statistics.seconds,
             result.status == hcsp::Status::limit ? '*' : ' ', result.search->cells, unique, exists,
             boxes - unique - exists);
}

void run(const std::filesystem::path& path, double limit) {
  const double start = now();
  const auto compilation = hcsp::lang::compile_file(path.string());
  fmt::print("{:<32} {:>8.4f}", path.filename().string(), now() - start);
  if (!compilation.model) {
    fmt::print("  not read\n{}", compilation.diagnostics.text());
  } else if (compilation.model->goal != hcsp::lang::SolveItem::Goal::all) {
    fmt::print("  minimizes\n");
  } else {
    for (const unsigned threads : {1U, 2U}) solve(*compilation.model, threads, limit);
    fmt::print("\n");
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  constexpr double kLimit = 60.0;
  if (argc < 2) {
    fmt::print(stderr, "minibex_bench FOLDER [SECONDS]\n");
    return 2;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& file : std::filesystem::recursive_directory_iterator(argv[1])) {
    if (hcsp::lang::minibex::is_minibex(file.path().string())) files.push_back(file.path());
  }
  std::sort(files.begin(), files.end());
  fmt::print("{:<32} {:>8}{:>11} {:>9} {:>6} {:>6} {:>6}{:>11} {:>9} {:>6} {:>6} {:>6}\n", "system", "read",
             "1 thread", "cells", "unique", "exists", "other", "2 threads", "cells", "unique", "exists",
             "other");
  for (const auto& file : files) run(file, argc > 2 ? std::atof(argv[2]) : kLimit);
  return 0;
}
