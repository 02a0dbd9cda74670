// SPDX-License-Identifier: Apache-2.0
// Reads the systems of IBEX's benchmark collection in a folder and solves them: each has as many certified
// solutions as are known.
//   minibex_benchmarks FOLDER
#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>

#include "lang/lang.h"

namespace {

struct Known {
  std::string_view file;
  std::size_t solutions;
};
constexpr std::array<Known, 12> kSystems{{{"Brown-07.bch", 3},
                                          {"BroydenBanded-020.bch", 1},
                                          {"BroydenTri-0100.bch", 2},
                                          {"Caprasse.bch", 18},
                                          {"Design.bch", 1},
                                          {"Directkin.bch", 2},
                                          {"Discrete-Integralf2-16.bch", 3},
                                          {"Eco9.bch", 16},
                                          {"I5.bch", 30},
                                          {"Kin1.bch", 16},
                                          {"Trigexp2-11.bch", 0},
                                          {"yamamura8a.bch", 7}}};

bool is_right(const std::filesystem::path& path, std::size_t known) {
  const auto compilation = hcsp::lang::compile_file(path.string());
  if (!compilation.model) {
    fmt::print("{}", compilation.diagnostics.text());
    return false;
  }
  hcsp::SearchOptions options;
  options.precision = compilation.model->precision;
  const hcsp::Result result = compilation.model->problem->solve_all(options);
  std::size_t unique = 0;
  for (const hcsp::Solution& solution : result.search->solutions)
    unique += solution.certificate == hcsp::Certificate::unique ? 1 : 0;
  const std::size_t boxes = result.search->solutions.size();
  fmt::print("{}: {} unique of {} boxes, {:.2f} s\n", path.filename().string(), unique, boxes,
             result.statistics.seconds);
  return unique == known && boxes == known;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "minibex_benchmarks FOLDER\n");
    return 2;
  }
  bool good = true;
  for (const Known& known : kSystems) {
    if (is_right(std::filesystem::path(argv[1]) / known.file, known.solutions)) continue;
    fmt::print("{}: {} solutions are known\n", known.file, known.solutions);
    good = false;
  }
  return good ? 0 : 1;
}
