// SPDX-License-Identifier: Apache-2.0
#include "domains/set_interval.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "domains/set_descent.h"
#include "tests/support/laws.h"

namespace hcsp {
namespace {

// A zone that settles a fixed random set of cells, whatever blocks it is asked about.
struct CellsZone {
  const std::map<CellIndex, bool>& cells;
  std::size_t dim;
  Decision decide(const Region& box) const {
    for (std::size_t axis = 0; axis < dim; ++axis) {
      if (box.hi[axis] - box.lo[axis] > 1) return Decision::split;
    }
    return cells.contains(box.lo) ? Decision::all : Decision::none;
  }
};

std::map<CellIndex, bool> random_cells(std::size_t dim, std::int64_t reach, int count, std::mt19937& random) {
  std::uniform_int_distribution<std::int64_t> coordinate(-reach, reach - 1);
  std::map<CellIndex, bool> cells;
  for (int i = 0; i < count; ++i) {
    CellIndex cell{};
    for (std::size_t axis = 0; axis < dim; ++axis) cell[axis] = coordinate(random);
    cells[cell] = true;
  }
  return cells;
}

Region square(std::size_t dim, std::int64_t reach) {
  CellIndex lo{};
  for (std::size_t axis = 0; axis < dim; ++axis) lo[axis] = -reach;
  return Region::block(lo, 2 * reach, dim);
}

SetInterval random_set(std::size_t dim, std::mt19937& random, std::int64_t reach = 12) {
  SetInterval set(dim, 0.25);
  const auto removed = random_cells(dim, reach, 60, random);
  CellsZone outside{removed, dim};
  set.exclude(square(dim, reach), outside);
  auto kept = random_cells(dim, reach, 60, random);
  for (const auto& [cell, yes] : removed) kept.erase(cell);
  CellsZone inside{kept, dim};
  set.include(square(dim, reach), inside);
  return set;
}

TEST(SetInterval, ObeysTheLatticeLaws) {
  std::mt19937 random(1);
  for (std::size_t dim = 1; dim <= 3; ++dim) {
    std::vector<SetInterval> samples{SetInterval(dim, 0.25)};
    samples.push_back(bottom(samples.front()));
    for (int i = 0; i < 4; ++i) samples.push_back(random_set(dim, random));
    check_lattice_laws(samples);
  }
}

TEST(SetInterval, IncludesAndExcludesExactlyTheCellsOfAZone) {
  std::mt19937 random(2);
  for (std::size_t dim = 1; dim <= 3; ++dim) {
    const auto cells = random_cells(dim, 40, 500, random);
    SetInterval set(dim, 0.1);
    CellsZone zone{cells, dim};
    EXPECT_FALSE(set.include(square(dim, 40), zone).is_none());
    EXPECT_TRUE(set.include(square(dim, 40), zone).is_none());
    for (const auto& [cell, yes] : cells) EXPECT_EQ(set.at_cell(cell), CellState::inside);
    for (const auto& [cell, yes] : random_cells(dim, 45, 500, random)) {
      EXPECT_EQ(set.at_cell(cell), cells.contains(cell) ? CellState::inside : CellState::unknown);
    }
    EXPECT_FALSE(set.is_empty());
    set.exclude(square(dim, 40), zone);
    EXPECT_TRUE(set.is_empty());
  }
}

TEST(SetInterval, FourStatesUnderFigureFive) {
  std::mt19937 random(3);
  const SetInterval a = random_set(2, random), b = random_set(2, random);
  const auto possible = [](CellState s) { return s == CellState::unknown || s == CellState::inside; };
  const auto certain = [](CellState s) { return s == CellState::inside; };
  const auto state = [](bool lower, bool upper) {
    return lower ? CellState::inside : (upper ? CellState::unknown : CellState::outside);
  };
  const SetInterval united = set_union(a, b), common = set_intersection(a, b), minus = set_difference(a, b),
                    either = set_symmetric_difference(a, b), without = set_complement(a);
  for (std::int64_t i = -14; i < 14; ++i) {
    for (std::int64_t j = -14; j < 14; ++j) {
      const CellIndex cell{i, j, 0};
      const CellState x = a.at_cell(cell), y = b.at_cell(cell);
      EXPECT_EQ(united.at_cell(cell), state(certain(x) || certain(y), possible(x) || possible(y)));
      EXPECT_EQ(common.at_cell(cell), state(certain(x) && certain(y), possible(x) && possible(y)));
      EXPECT_EQ(minus.at_cell(cell), state(certain(x) && !possible(y), possible(x) && !certain(y)));
      EXPECT_EQ(either.at_cell(cell), state((certain(x) && !possible(y)) || (certain(y) && !possible(x)),
                                            (possible(x) || possible(y)) && !(certain(x) && certain(y))));
      EXPECT_EQ(without.at_cell(cell), state(!possible(x), !certain(x)));
    }
  }
}

TEST(SetInterval, AFrameKeepsTheCellsThatItsClosedFacesTouch) {
  const SetInterval set(2, 0.05, Box{Interval(-10, 10), Interval(-10, 10)});
  EXPECT_EQ(set.background(), CellState::outside);
  EXPECT_EQ(set.at_cell({200, -200, 0}), CellState::unknown);  // [10, 10.05) touches the face at 10
  EXPECT_EQ(set.at_cell({201, 0, 0}), CellState::outside);
  EXPECT_EQ(set.at_cell({-201, 0, 0}), CellState::outside);  // [-10.05, -10) does not
  EXPECT_NEAR(set.upper_volume(), 401 * 401 * 0.0025, 1e-9);
  EXPECT_GE(set.upper_volume(), 401 * 401 * 0.0025 * (1 - 1e-15));
  EXPECT_LE(set.boxes(CellState::unknown).size(),
            9U);  // whole blocks in the middle, thin ones along the faces
  EXPECT_THROW(SetInterval(2, 0.05, Box{Interval(1, 1), Interval(0, 1)}), std::invalid_argument);
  EXPECT_THROW(SetInterval(2, 0.0), std::invalid_argument);
  EXPECT_THROW(SetInterval(4, 1.0), std::invalid_argument);
}

TEST(SetInterval, GrowsWithoutLosingCells) {
  SetInterval set(2, 1.0);
  const std::map<CellIndex, bool> near{{CellIndex{2, -3, 0}, true}},
      far{{CellIndex{100000, -70000, 0}, true}};
  CellsZone near_zone{near, 2}, far_zone{far, 2};
  set.include(Region::block({2, -3, 0}, 1, 2), near_zone);
  set.include(Region::block({100000, -70000, 0}, 1, 2), far_zone);
  EXPECT_EQ(set.at_cell({2, -3, 0}), CellState::inside);
  EXPECT_EQ(set.at_cell({100000, -70000, 0}), CellState::inside);
  EXPECT_EQ(set.lower_volume(), 2.0);
  EXPECT_EQ(set.upper_volume(), kInfinity);
  const double point[2] = {100000.5, -69999.5};
  EXPECT_EQ(set.at(point), CellState::inside);
}

TEST(Grid, LinesAreTheNearestDoublesAndCellsPartition) {
  for (const double h : {0.05, 0.02, 0.1, 1.0, 1e-3, 0.7}) {
    const Grid grid(2, h);
    std::mt19937 random(5);
    std::uniform_int_distribution<std::int64_t> index(-2000000, 2000000);
    for (int k = 0; k < 2000; ++k) {
      const std::int64_t i = index(random);
      EXPECT_EQ(grid.line(i), static_cast<double>(i) * h);  // the tests run in rounding to nearest
      EXPECT_EQ(grid.cell_of(grid.line(i)), i);
      EXPECT_EQ(grid.cell_of(std::nextafter(grid.line(i), -1e300)), i - 1);
    }
  }
}

TEST(SetInterval, PartsOfBlocksSumUpTheirCells) {
  std::mt19937 random(7);
  const SetInterval set = random_set(2, random, 30);
  std::vector<SetInterval::Block> stack{set.root()};
  std::size_t cells = 0;
  while (!stack.empty()) {
    const SetInterval::Block block = stack.back();
    stack.pop_back();
    if (block.edge == 1) {
      const CellState state = set.at_cell(block.lo);
      EXPECT_EQ(block.any_upper, state == CellState::unknown || state == CellState::inside);
      EXPECT_EQ(block.all_lower, state == CellState::inside);
      ++cells;
      continue;
    }
    bool any_upper = false, all_lower = true;
    for (int i = 0; i < 4; ++i) {
      const SetInterval::Block part = set.part(block, i);
      any_upper = any_upper || part.any_upper;
      all_lower = all_lower && part.all_lower;
      stack.push_back(part);
    }
    EXPECT_EQ(block.any_upper, any_upper);
    EXPECT_EQ(block.all_lower, all_lower);
  }
  const Region reach = set.reach();
  EXPECT_EQ(cells, static_cast<std::size_t>((reach.hi[0] - reach.lo[0]) * (reach.hi[1] - reach.lo[1])));
}

}  // namespace
}  // namespace hcsp
