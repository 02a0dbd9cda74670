// SPDX-License-Identifier: Apache-2.0
// How long a large model takes from its text: a chain of constraints over as many unknowns.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>

#include "lang/lang.h"
#include "lang/syntax/parser.h"

namespace {

using namespace hcsp::lang;

// x[i + 1] follows from x[i]; constraint by constraint, with names of their own.
std::string chain(std::int64_t constraints) {
  std::string text = "model chain;\n";
  for (std::int64_t i = 0; i <= constraints; ++i) text += fmt::format("var x{} : real in [-10, 10];\n", i);
  text += "constraint x0 == 1;\n";
  for (std::int64_t i = 1; i <= constraints; ++i)
    text += fmt::format("constraint c{0}: x{0} == 0.5*x{1} + sin(x{1})/4 - {0}/20000;\n", i, i - 1);
  return text + "solve propagate;\n";
}

// The same as an array and a quantifier.
std::string chain_of_array(std::int64_t constraints) {
  return fmt::format(
      "model chain;\nvar x : array[0..{0}] of real in [-10, 10];\nconstraint x[0] == 1;\n"
      "constraint c: forall(i in 1..{0}) x[i] == 0.5*x[i - 1] + sin(x[i - 1])/4 - i/20000;\n"
      "solve propagate;\n",
      constraints);
}

void compile(benchmark::State& state, const std::string& text) {
  for (auto _ : state) {
    Compilation compilation = compile_text({"chain.hcsp", text});
    if (!compilation.model) state.SkipWithError(compilation.diagnostics.text().c_str());
    benchmark::DoNotOptimize(compilation);
  }
}

void parse(benchmark::State& state) {
  const std::string text = chain(state.range(0));
  for (auto _ : state) {
    SyntaxTree tree;
    Diagnostics diagnostics;
    parse_items(tree.add_source("chain.hcsp", text), tree, diagnostics);
    benchmark::DoNotOptimize(tree);
  }
}

void compile_chain(benchmark::State& state) { compile(state, chain(state.range(0))); }
void compile_chain_of_array(benchmark::State& state) { compile(state, chain_of_array(state.range(0))); }

void propagate_chain(benchmark::State& state) {
  const Compilation compilation = compile_text({"chain.hcsp", chain(state.range(0))});
  for (auto _ : state) benchmark::DoNotOptimize(compilation.model->problem->propagate());
}

BENCHMARK(parse)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(compile_chain)->Arg(1000)->Arg(10000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(compile_chain_of_array)->Arg(10000)->Unit(benchmark::kMillisecond);
BENCHMARK(propagate_chain)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
