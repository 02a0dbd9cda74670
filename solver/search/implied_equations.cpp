// SPDX-License-Identifier: Apache-2.0
#include "solver/search/implied_equations.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "domains/interval/kernel.h"

namespace hcsp {

namespace {

constexpr Interval kZero = Interval::raw(0.0, 0.0);

// A linear equation: its slopes, then its value at 0.
struct LinearRow {
  std::uint32_t number;
  std::vector<Interval> entries;
};

std::vector<LinearRow> linear_rows(const System& system) {
  TapeRun run(*system.tape);
  const std::size_t n = system.size();
  const std::vector<Interval> everywhere(n, Interval::entire()), origin(n, kZero);
  std::vector<LinearRow> rows;
  std::uint32_t number = 0;
  for (std::uint32_t i = 0; i < system.relations.size(); ++i) {
    if (!system.relations[i].is_equation()) continue;
    if (system.relations[i].is_implied) {
      ++number;
      continue;
    }
    LinearRow row{number++, std::vector<Interval>(n + 1, kZero)};
    run.evaluate(everywhere, true);
    run.gradient(i, row.entries);
    run.evaluate(origin, false);
    row.entries[n] = run.value(i);
    const bool is_linear = std::all_of(row.entries.begin(), row.entries.end(),
                                       [](const Interval& entry) { return entry.is_point(); });
    if (is_linear) rows.push_back(std::move(row));
  }
  return rows;
}

// Of entries of one size, 1 loses nothing.
std::size_t pivot_of(const std::vector<Interval>& entries, std::size_t unknowns) {
  std::size_t pivot = unknowns;
  double best = 0.0;
  for (std::size_t v = 0; v < unknowns; ++v) {
    if (!entries[v].is_point() || entries[v] == kZero) continue;
    const double merit = entries[v].mag() == 1.0 ? kInfinity : entries[v].mag();
    if (merit > best) {
      best = merit;
      pivot = v;
    }
  }
  return pivot;
}

}  // namespace

std::vector<std::uint8_t> implied_equations(const System& system) {
  std::vector<std::uint8_t> implied;
  std::set<std::uint32_t> stated;
  for (std::uint32_t i = 0; i < system.relations.size(); ++i) {
    if (!system.relations[i].is_equation()) continue;
    const bool is_implied = system.relations[i].is_implied || !stated.insert(system.tape->root(i)).second;
    implied.push_back(is_implied ? 1 : 0);
  }
  std::vector<LinearRow> rows = linear_rows(system);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::vector<Interval> by = rows[k].entries;
    const std::size_t pivot = pivot_of(by, system.size());
    if (pivot == system.size()) {
      implied[rows[k].number] =
          std::all_of(by.begin(), by.end(), [](const Interval& x) { return x == kZero; });
      continue;
    }
    for (std::size_t j = k + 1; j < rows.size(); ++j) {
      if (rows[j].entries[pivot] == kZero) continue;
      const Interval factor = up::div(rows[j].entries[pivot], by[pivot]);
      for (std::size_t v = 0; v < by.size(); ++v)
        rows[j].entries[v] = up::sub(rows[j].entries[v], up::mul(factor, by[v]));
    }
  }
  return implied;
}

}  // namespace hcsp
