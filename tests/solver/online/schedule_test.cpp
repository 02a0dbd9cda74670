// SPDX-License-Identifier: Apache-2.0
#include "solver/online/schedule.h"

#include <gtest/gtest.h>

#include <random>

namespace hcsp::online {
namespace {

struct Step {
  int kind;
  std::uint32_t y, a, b, c;
};

int kind_of(const Step& step) { return step.kind; }

std::size_t runs(const std::vector<Step>& steps) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < steps.size(); ++i)
    count += i == 0 || steps[i].kind != steps[i - 1].kind ? 1 : 0;
  return count;
}

TEST(Schedule, PutsOperandsFirstAndLosesNothing) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 200; ++round) {
    constexpr std::uint32_t kInputs = 4;
    std::vector<Step> steps;
    const std::size_t size = random() % 60;
    for (std::uint32_t i = 0; i < size; ++i) {
      const auto operand = [&] { return static_cast<std::uint32_t>(random() % (kInputs + i)); };
      steps.push_back({static_cast<int>(random() % 4), kInputs + i, operand(), operand(), operand()});
    }
    std::vector<Step> ordered = steps;
    reorder(ordered, 0, kind_of);
    ASSERT_EQ(ordered.size(), steps.size());
    std::vector<bool> is_known(kInputs + size);
    std::fill_n(is_known.begin(), kInputs, true);
    for (const Step& step : ordered) {
      EXPECT_TRUE(is_known[step.a] && is_known[step.b] && is_known[step.c]);
      EXPECT_FALSE(is_known[step.y]);
      EXPECT_EQ(step.kind, steps[step.y - kInputs].kind);
      is_known[step.y] = true;
    }
  }
}

// Chains of the same kinds need no more runs than one of them; that of most changes sets the pace.
TEST(Schedule, MakesOneRunOfWhatChainsShare) {
  std::vector<Step> steps;
  std::uint32_t next = 10;
  for (const std::size_t length : {6, 6, 3, 1}) {
    std::uint32_t last = 0;
    for (std::size_t i = 6 - length; i < 6; ++i) {
      steps.push_back({static_cast<int>(i % 3), next, last, last, last});
      last = next++;
    }
  }
  reorder(steps, 0, kind_of);
  EXPECT_EQ(runs(steps), 6U);
}

}  // namespace
}  // namespace hcsp::online
