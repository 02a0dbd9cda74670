// SPDX-License-Identifier: Apache-2.0
// How long the gallery's optimisation problems take, with one thread and with two.
#include "gallery_bench.h"

namespace {

using namespace hcsp;

void minimize(benchmark::State& state, const lang::CompiledModel& model) {
  const SearchOptions options = gallery_bench::options_of(model, state);
  Result result;
  for (auto _ : state) result = model.problem->minimize(*model.objective, options);
  state.counters["cells"] = static_cast<double>(result.search->cells);
  state.counters["minimum"] = result.objective->hi();
}

}  // namespace

int main(int argc, char** argv) {
  return gallery_bench::run(argc, argv, lang::SolveItem::Goal::minimize, minimize);
}
