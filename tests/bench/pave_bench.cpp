// SPDX-License-Identifier: Apache-2.0
// How long subpavings take, with one thread and with two: a ring, a wavy set, and a set of parameters.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <functional>

#include "solver/problem.h"

namespace {

using namespace hcsp;

std::vector<Expr> ring(Problem& p) {
  const Interval side(-3.0, 3.0);
  const Expr x = p(p.real("x", side)), y = p(p.real("y", side)), r = sqr(x) + sqr(y);
  p.constrain("ring", Interval(1.0) <= r && r <= Interval(4.0));
  return {x, y};
}

std::vector<Expr> waves(Problem& p) {
  const Interval side(-10.0, 10.0);
  const Expr x = p(p.real("x", side)), y = p(p.real("y", side));
  const Expr f = sin(x + y) - Interval::of_decimal("0.1") * x * y;
  p.constrain("waves", Interval(0.0) <= f && f <= Interval(2.0));
  return {x, y};
}

// The parameters of a decay that agree with ten readings within their errors.
std::vector<Expr> decay(Problem& p) {
  const Expr a = p(p.real("a", Interval(0.0, 10.0))), b = p(p.real("b", Interval(0.0, 2.0)));
  for (int i = 0; i < 10; ++i) {
    const double t = 0.5 * i, reading = 5.0 * std::exp(-0.6 * t) + 0.1 * ((i * 7) % 5 - 2);
    const Expr error = a * exp(Interval(-t) * b) - Interval(reading);
    p.constrain("reading", Interval(-0.5) <= error && error <= Interval(0.5));
  }
  return {a, b};
}

// The numbers a for which x^2 + a x + b has a root in [0, 1] for some b near 0.
std::vector<Expr> projection(Problem& p) {
  const Expr a = p(p.real("a", Interval(-4.0, 4.0))), b = p(p.real("b", Interval(-4.0, 4.0)));
  const Expr x = p(p.real("x", Interval(0.0, 1.0)));
  p.constrain("root", sqr(x) + a * x + b == Interval(0.0));
  return {a, b};
}

// (c, d) for which a family of polynomials with p in [1, 2] stays positive.
std::vector<Expr> robust(Problem& p) {
  const Expr c = p(p.real("c", Interval(-4.0, 4.0))), d = p(p.real("d", Interval(-4.0, 4.0)));
  p.constrain("positive", p.for_every("p", Interval(1.0, 2.0),
                                      [&](Expr q) { return sqr(q) + c * q + d > Interval(0.0); }));
  return {c, d};
}

void pave(benchmark::State& state, const std::function<std::vector<Expr>(Problem&)>& state_it,
          double precision) {
  Problem problem("bench");
  const std::vector<Expr> variables = state_it(problem);
  SearchOptions options;
  options.precision = precision;
  options.threads = static_cast<unsigned>(state.range(0));
  Result result;
  double seconds = 0.0;
  for (auto _ : state) {
    result = problem.pave(variables, options);
    seconds = seconds == 0.0 ? result.statistics.seconds : std::min(seconds, result.statistics.seconds);
  }
  state.counters["least_ms"] = 1e3 * seconds;
  state.counters["cells"] = static_cast<double>(result.paving->cells);
  state.counters["boundary"] = result.paving->boundary_volume;
  state.counters["inside"] = result.paving->inside_volume;
  state.counters["boxes"] = static_cast<double>(result.paving->boundary.size() / result.paving->names.size());
}

}  // namespace

int main(int argc, char** argv) {
  const auto add = [](const char* name, auto state_it, double precision) {
    benchmark::RegisterBenchmark(name, pave, state_it, precision)
        ->Arg(1)
        ->Arg(2)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
  };
  add("ring", ring, 1e-3);
  add("waves", waves, 0.01);
  add("decay", decay, 1e-3);
  add("projection", projection, 0.02);
  add("robust", robust, 0.02);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
