// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/disjoint.h"

#include <gtest/gtest.h>

#include <map>

#include "domains/set_descent.h"
#include "solver/engine/propagation.h"
#include "tests/solver/engine/probe.h"
#include "tests/support/cells.h"

namespace hcsp {
namespace {

using oracle::Dice;
using oracle::for_seeds;

constexpr std::int64_t kWorld = 10;

// Settles the cells of a plain map that are in a state.
struct CellsIn {
  const std::map<CellIndex, CellState>& cells;
  CellState state;
  Decision decide(const Region& block) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (block.hi[axis] - block.lo[axis] > 1) return Decision::split;
    }
    const auto found = cells.find(block.lo);
    return found != cells.end() && found->second == state ? Decision::all : Decision::none;
  }
};

struct Sample {
  std::map<CellIndex, CellState> plain;
  SetInterval set;
};

Sample random_sample(Dice& dice, std::size_t dim, int insides) {
  Sample sample{{}, SetInterval(dim, 0.5)};
  oracle::for_cells(dim, dim == 3 ? kWorld / 2 : kWorld, [&](const CellIndex& cell) {
    const int draw = dice.below(1000);
    sample.plain[cell] =
        draw < insides ? CellState::inside : (draw < 400 ? CellState::outside : CellState::unknown);
  });
  CellIndex lo{};
  for (std::size_t axis = 0; axis < dim; ++axis) lo[axis] = -kWorld;
  CellsIn inside{sample.plain, CellState::inside}, outside{sample.plain, CellState::outside};
  sample.set.include(Region::block(lo, 2 * kWorld, dim), inside);
  sample.set.exclude(Region::block(lo, 2 * kWorld, dim), outside);
  if (dice.below(2) == 0) sample.set.exclude_background();
  return sample;
}

TEST(DisjointContractor, IsTheDifferenceOfPlainMaps) {
  int feasible = 0;
  for_seeds(150, [&](Dice& dice) {
    const std::size_t dim = 1 + static_cast<std::size_t>(dice.below(3));
    const Sample a = random_sample(dice, dim, dice.below(30)), b = random_sample(dice, dim, dice.below(30));
    ContractorGraph graph;
    const VariableId x = graph.add_variable("a", a.set), y = graph.add_variable("b", b.set);
    graph.add_contractor(make_disjoint_contractor("apart", "apart", x, y));
    Propagation run(graph, {});
    const Ending ending = run.run();
    bool overlap = false;
    for (const auto& [cell, state] : a.plain) {
      overlap = overlap || (state == CellState::inside && b.plain.at(cell) == CellState::inside);
    }
    ASSERT_EQ(ending, overlap ? Ending::empty : Ending::fixed_point);
    if (overlap) return;
    ++feasible;
    const auto without = [](CellState state, CellState other) {
      return other == CellState::inside ? CellState::outside : state;
    };
    for (const auto& [cell, state] : a.plain) {
      ASSERT_EQ(run.domain<SetInterval>(x).at_cell(cell), without(state, b.plain.at(cell)));
      ASSERT_EQ(run.domain<SetInterval>(y).at_cell(cell), without(b.plain.at(cell), state));
    }
    EXPECT_EQ(run.domain<SetInterval>(x).background(), a.set.background());
    EXPECT_EQ(run.domain<SetInterval>(y).background(), b.set.background());
  });
  EXPECT_TRUE(feasible > 30 || ::testing::GTEST_FLAG(random_seed) > 0 || HasFailure());
}

// A set that grows while the propagation runs: only the cells that became certain are looked at, and none is
// missed.
TEST(DisjointContractor, FollowsWhatBecomesCertain) {
  for_seeds(60, [](Dice& dice) {
    const std::size_t dim = 1 + static_cast<std::size_t>(dice.below(3));
    const Sample growing = random_sample(dice, dim, 150);
    ContractorGraph graph;
    const VariableId a = graph.add_variable("a", SetInterval(dim, 0.5)),
                     b = graph.add_variable("b", SetInterval(dim, 0.5));
    const VariableId step = graph.add_variable("step", Interval(0, 8));
    graph.add_contractor(make_disjoint_contractor("apart", "apart", a, b));
    // Includes a band of cells a step.
    add_probe(graph, "grow", Cost::search, {step}, {step, a}, [&](Access& access) {
      const double left = access.domain<Interval>(step).hi();
      std::map<CellIndex, CellState> band;
      for (const auto& [cell, state] : growing.plain) {
        if ((cell[0] + 64) % 8 == static_cast<std::int64_t>(left) % 8) band[cell] = state;
      }
      CellsIn zone{band, CellState::inside};
      CellIndex lo{};
      for (std::size_t axis = 0; axis < dim; ++axis) lo[axis] = -kWorld;
      access.report<SetInterval>(
          a, access.edit<SetInterval>(a).include(Region::block(lo, 2 * kWorld, dim), zone));
      if (left > 0) narrow(access, step, {0, left - 1});
    });
    Propagation run(graph, {});
    ASSERT_EQ(run.run(), Ending::fixed_point);
    for (const auto& [cell, state] : growing.plain) {
      const CellState expected = state == CellState::inside ? CellState::outside : CellState::unknown;
      ASSERT_EQ(run.domain<SetInterval>(b).at_cell(cell), expected);
    }
  });
}

}  // namespace
}  // namespace hcsp
