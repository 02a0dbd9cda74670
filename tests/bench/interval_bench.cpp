// SPDX-License-Identifier: Apache-2.0
// Nanoseconds an interval operation in the engine's hot loops, the batch forms and the bytecode, over arrays
// of intervals of mixed sign; beside them the plain double operation, MPFI at 53 bits and Boost.Interval.
// `ns` is the time of one operation, `ratio` that in units of the plain double operation's, of the same run.
#include <benchmark/benchmark.h>
#include <mpfi.h>

#include <algorithm>
#include <boost/numeric/interval.hpp>
#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "domains/interval/batch.h"
#include "domains/rounding.h"
#include "solver/expression/expr.h"
#include "solver/expression/program.h"

namespace {

using hcsp::Evaluation;
using hcsp::Expr;
using hcsp::Interval;

/// Bounds of n intervals: of mixed sign and width below 3, or positive.
struct Arrays {
  std::vector<double> lo, hi;

  Arrays(std::size_t n, bool positive, unsigned seed) : lo(n), hi(n) {
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> place(positive ? 0.1 : -10.0, 10.0), width(0.0, 3.0);
    for (std::size_t i = 0; i < n; ++i) {
      lo[i] = place(engine);
      hi[i] = lo[i] + width(engine);
    }
  }
  [[nodiscard]] hcsp::batch::Intervals in() const { return {lo.data(), hi.data()}; }
  hcsp::batch::Results out() { return {lo.data(), hi.data()}; }
  /// As the engine's domains hold them.
  [[nodiscard]] std::vector<Interval> intervals() const {
    std::vector<Interval> result;
    for (std::size_t i = 0; i < lo.size(); ++i) result.push_back(Interval::raw(lo[i], hi[i]));
    return result;
  }
};

struct Operation {
  const char* name;
  bool positive;
  std::function<void(std::size_t, const double*, const double*, double*)> plain;
  std::function<void(std::size_t, hcsp::batch::Intervals, hcsp::batch::Intervals, hcsp::batch::Results)>
      batch;
  std::function<Expr(Expr, Expr)> expression;  // none where the bytecode has no such operator
  std::function<int(mpfi_ptr, mpfi_srcptr, mpfi_srcptr)> mpfi;
};

/// Measures body(), which does n operations.
void measure(benchmark::State& state, const std::string& name, std::size_t n, bool is_plain,
             const std::function<void()>& body) {
  static std::map<std::string, double> plain;
  const auto begin = std::chrono::steady_clock::now();
  for (auto _ : state) {
    body();
    benchmark::ClobberMemory();
  }
  const std::chrono::duration<double, std::nano> taken = std::chrono::steady_clock::now() - begin;
  const double each = taken.count() / (static_cast<double>(state.iterations()) * static_cast<double>(n));
  const std::string key = name + "/" + std::to_string(n);
  if (is_plain) plain[key] = each;
  state.counters["ns"] = each;
  state.counters["ratio"] = each / plain[key];
}

/// The bytecode of one operation, on registers that hold the operands, or with the copies of operands into
/// registers and of results out of them.
void run_bytecode(benchmark::State& state, const Operation& operation, const Arrays& a, const Arrays& b,
                  bool with_copies) {
  constexpr std::size_t kLanes = Evaluation::kMaxLanes;
  const std::vector<Interval> operands[] = {a.intervals(), b.intervals()};
  std::vector<Interval> result = operands[0];
  const std::size_t n = result.size();
  hcsp::Dag dag;
  const auto input = [&](hcsp::VariableId id) {
    return Expr(dag, dag.input({hcsp::Input::Kind::real, id, 0, 0}));
  };
  const Expr root = operation.expression(input(0), input(1));
  const hcsp::Program program(dag, {root.node()});
  const std::size_t blocks = (n + kLanes - 1) / kLanes;
  std::vector<Evaluation> evaluations(with_copies ? 1 : blocks, Evaluation(program, kLanes));
  const auto load = [&](Evaluation& evaluation, std::size_t begin) {
    for (std::uint32_t reg = 0; reg < program.inputs().size(); ++reg)
      std::copy_n(&operands[program.inputs()[reg].variable][begin], std::min(kLanes, n - begin),
                  evaluation.row(reg).begin());
  };
  for (std::size_t k = 0; k < evaluations.size(); ++k) load(evaluations[k], k * kLanes);
  const hcsp::RoundUpward guard;
  measure(state, operation.name, n, false, [&] {
    for (std::size_t block = 0; block < blocks; ++block) {
      const std::size_t begin = block * kLanes, lanes = std::min(kLanes, n - begin);
      Evaluation& evaluation = evaluations[with_copies ? 0 : block];
      if (with_copies) load(evaluation, begin);
      evaluation.forward(lanes);
      if (with_copies) std::copy_n(evaluation.row(program.root()).begin(), lanes, &result[begin]);
    }
  });
}

void run_mpfi(benchmark::State& state, const Operation& operation, const Arrays& a, const Arrays& b) {
  const std::size_t n = a.lo.size();
  std::vector<mpfi_t> left(n), right(n), result(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (auto* number : {&left[i], &right[i], &result[i]}) mpfi_init2(*number, 53);
    mpfi_interv_d(left[i], a.lo[i], a.hi[i]);
    mpfi_interv_d(right[i], b.lo[i], b.hi[i]);
  }
  measure(state, operation.name, n, false, [&] {
    for (std::size_t i = 0; i < n; ++i) operation.mpfi(result[i], left[i], right[i]);
  });
  for (std::size_t i = 0; i < n; ++i)
    for (auto* number : {&left[i], &right[i], &result[i]}) mpfi_clear(*number);
}

using Peer = boost::numeric::interval<double>;

void run_boost(benchmark::State& state, const char* name, const std::function<Peer(Peer, Peer)>& each,
               const Arrays& a, const Arrays& b) {
  const std::size_t n = a.lo.size();
  std::vector<Peer> left, right, result(n);
  for (std::size_t i = 0; i < n; ++i) {
    left.emplace_back(a.lo[i], a.hi[i]);
    right.emplace_back(b.lo[i], b.hi[i]);
  }
  measure(state, name, n, false, [&] {
    for (std::size_t i = 0; i < n; ++i) result[i] = each(left[i], right[i]);
  });
}

template <class Each>
auto plain_loop(Each each) {
  return [each](std::size_t n, const double* a, const double* b, double* result) {
    for (std::size_t i = 0; i < n; ++i) result[i] = each(a[i], b[i]);
  };
}

using Batch2 = void (*)(std::size_t, hcsp::batch::Intervals, hcsp::batch::Intervals, hcsp::batch::Results);
Batch2 of_two(Batch2 f) { return f; }
using Batch1 = void (*)(std::size_t, hcsp::batch::Intervals, hcsp::batch::Results);
auto of_one(Batch1 f) {
  return [f](std::size_t n, hcsp::batch::Intervals a, hcsp::batch::Intervals, hcsp::batch::Results result) {
    f(n, a, result);
  };
}
auto of_one(int (*f)(mpfi_ptr, mpfi_srcptr)) {
  return [f](mpfi_ptr result, mpfi_srcptr a, mpfi_srcptr) { return f(result, a); };
}

int mpfi_cube(mpfi_ptr result, mpfi_srcptr a, mpfi_srcptr) {
  mpfi_sqr(result, a);
  return mpfi_mul(result, result, a);
}

std::vector<Operation> operations() {
  namespace batch = hcsp::batch;
  const std::function<Expr(Expr, Expr)> none;
  return {
      {"add", false, plain_loop([](double a, double b) { return a + b; }), of_two(batch::add),
       [](Expr a, Expr b) { return a + b; }, mpfi_add},
      {"mul", false, plain_loop([](double a, double b) { return a * b; }), of_two(batch::mul),
       [](Expr a, Expr b) { return a * b; }, mpfi_mul},
      {"div", false, plain_loop([](double a, double b) { return a / b; }), of_two(batch::div),
       [](Expr a, Expr b) { return a / b; }, mpfi_div},
      {"sqr", false, plain_loop([](double a, double) { return a * a; }), of_one(batch::sqr),
       [](Expr a, Expr) { return sqr(a); }, of_one(mpfi_sqr)},
      {"exp", false, plain_loop([](double a, double) { return std::exp(a); }), of_one(batch::exp), none,
       of_one(mpfi_exp)},
      {"log", true, plain_loop([](double a, double) { return std::log(a); }), of_one(batch::log), none,
       of_one(mpfi_log)},
      {"sin", false, plain_loop([](double a, double) { return std::sin(a); }), of_one(batch::sin),
       [](Expr a, Expr) { return sin(a); }, of_one(mpfi_sin)},
      {"cos", false, plain_loop([](double a, double) { return std::cos(a); }), of_one(batch::cos),
       [](Expr a, Expr) { return cos(a); }, of_one(mpfi_cos)},
      {"atan2", false, plain_loop([](double a, double b) { return std::atan2(a, b); }), batch::atan2,
       [](Expr a, Expr b) { return atan2(a, b); }, mpfi_atan2},
      {"pow3", false, plain_loop([](double a, double) { return a * a * a; }),
       [](std::size_t n, batch::Intervals a, batch::Intervals, batch::Results r) { batch::pown(n, a, 3, r); },
       none, mpfi_cube},
  };
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& body) {
  benchmark::RegisterBenchmark(name.c_str(), body);
}

void add_all(const Operation& operation, std::size_t n) {
  const Arrays a(n, operation.positive, 1), b(n, operation.positive, 2);
  const std::string name = operation.name, size = "/" + std::to_string(n);
  add(name + "/double" + size, [=](benchmark::State& state) {
    std::vector<double> result(n);
    measure(state, name, n, true, [&] { operation.plain(n, a.lo.data(), b.lo.data(), result.data()); });
  });
  add(name + "/batch" + size, [=](benchmark::State& state) {
    Arrays result = a;
    measure(state, name, n, false, [&] { operation.batch(n, a.in(), b.in(), result.out()); });
  });
  if (operation.expression)
    for (const bool with_copies : {false, true})
      add(name + (with_copies ? "/bytecode_with_copies" : "/bytecode") + size,
          [=](benchmark::State& state) { run_bytecode(state, operation, a, b, with_copies); });
  add(name + "/mpfi" + size, [=](benchmark::State& state) { run_mpfi(state, operation, a, b); });
  static const std::map<std::string, std::function<Peer(Peer, Peer)>> peers{
      {"add", [](Peer x, Peer y) { return x + y; }},
      {"mul", [](Peer x, Peer y) { return x * y; }},
      {"div", [](Peer x, Peer y) { return x / y; }},
      {"sqr", [](Peer x, Peer) { return square(x); }},
      {"pow3", [](Peer x, Peer) { return pow(x, 3); }}};
  const auto peer = peers.find(name);
  if (peer != peers.end())
    add(name + "/boost" + size,
        [=](benchmark::State& state) { run_boost(state, operation.name, peer->second, a, b); });
}

}  // namespace

int main(int argc, char** argv) {
  for (const Operation& operation : operations())
    for (const std::size_t n : {std::size_t{1000}, std::size_t{100000}}) add_all(operation, n);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
