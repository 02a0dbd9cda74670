// SPDX-License-Identifier: Apache-2.0
#include "solver/support.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/support/oracle.h"

namespace hcsp {
namespace {

using Parts = std::vector<std::size_t>;

const auto kNeverStop = [] { return false; };

// Infeasible as soon as one of some conflicts is kept whole: monotone by construction.
struct Conflicts {
  std::vector<Parts> conflicts;
  int* asked = nullptr;
  bool operator()(const Parts& kept) const {
    if (asked != nullptr) ++*asked;
    return std::any_of(conflicts.begin(), conflicts.end(), [&](const Parts& conflict) {
      return std::all_of(conflict.begin(), conflict.end(), [&](std::size_t part) {
        return std::find(kept.begin(), kept.end(), part) != kept.end();
      });
    });
  }
};

Parts numbers(std::size_t count) {
  Parts parts(count);
  std::iota(parts.begin(), parts.end(), std::size_t{0});
  return parts;
}

TEST(MinimalConflict, FindsAConflictOfWhichNoPartCanBeLeftOut) {
  oracle::for_seeds(300, [](oracle::Dice& dice) {
    const std::size_t count = 1 + static_cast<std::size_t>(dice.below(24));
    Conflicts problem;
    for (int c = 0; c <= dice.below(4); ++c) {
      Parts conflict;
      for (int k = 0; k <= dice.below(5); ++k)
        conflict.push_back(static_cast<std::size_t>(dice.below(static_cast<int>(count))));
      problem.conflicts.push_back(conflict);
    }
    Parts preferred = numbers(count);
    for (std::size_t i = count; i > 1; --i)
      std::swap(preferred[i - 1], preferred[static_cast<std::size_t>(dice.below(static_cast<int>(i)))]);
    const Parts found = minimal_conflict(preferred, problem, kNeverStop);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_TRUE(problem(found)) << "the parts found are jointly infeasible";
    for (const std::size_t left_out : found) {
      Parts others = found;
      std::erase(others, left_out);
      EXPECT_FALSE(problem(others)) << "part " << left_out << " can be left out";
    }
  });
}

TEST(MinimalConflict, PrefersTheLikelier) {
  const Conflicts problem{{{0, 1}, {6, 7}}};
  EXPECT_EQ(minimal_conflict({0, 1, 2, 3, 4, 5, 6, 7}, problem, kNeverStop), (Parts{0, 1}));
  EXPECT_EQ(minimal_conflict({7, 6, 5, 4, 3, 2, 1, 0}, problem, kNeverStop), (Parts{6, 7}));
}

TEST(MinimalConflict, IsEmptyWhereNoPartIsNeeded) {
  EXPECT_TRUE(minimal_conflict(numbers(5), Conflicts{{{}}}, kNeverStop).empty());
  EXPECT_TRUE(minimal_conflict({}, Conflicts{{{}}}, kNeverStop).empty());
}

TEST(MinimalConflict, AsksFewQuestions) {
  int asked = 0;
  EXPECT_EQ(minimal_conflict(numbers(1024), Conflicts{{{17, 900}}, &asked}, kNeverStop), (Parts{17, 900}));
  EXPECT_LE(asked, 2 * 2 * 11) << "about 2 k log2(n / k) + 2 k of them for k parts among n (Junker 2004)";
}

TEST(MinimalConflict, StoppedEarlyIsStillAConflict) {
  for (int limit = 0; limit < 30; ++limit) {
    int asked = 0;
    const Conflicts problem{{{3, 40, 41}}, &asked};
    const Parts found = minimal_conflict(numbers(64), problem, [&] { return asked >= limit; });
    EXPECT_TRUE(problem(found)) << "stopped after " << limit;
  }
}

}  // namespace
}  // namespace hcsp
