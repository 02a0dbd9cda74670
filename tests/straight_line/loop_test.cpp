// SPDX-License-Identifier: Apache-2.0
// In a control loop nothing is allocated, and what is wrong with the numbers is a status.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <limits>
#include <new>
#include <vector>

#include "lang/online.h"

namespace {

std::atomic<std::size_t> allocations{0};

}  // namespace

// Pairs of malloc and free, which the compiler cannot tell from a mistake.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
void* operator new(std::size_t size) {
  ++allocations;
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
void operator delete(void* place) noexcept { std::free(place); }
void operator delete(void* place, std::size_t) noexcept { std::free(place); }

namespace hcsp {
namespace {

CompiledProblem seven_joints(const std::string& type) {
  lang::CompileOptions options;
  options.parameters = {{"K", "7"}, {"p1", "zeros(K)"}};
  return compile(std::string(HCSP_SOURCE_DIR) + "/models/straight_line/" + type + ".hcsp", options);
}

class Loop : public ::testing::TestWithParam<const char*> {};

TEST_P(Loop, AllocatesNothing) {
  CompiledProblem problem = seven_joints(GetParam());
  const auto p1 = problem.parameter("p1"), v0 = problem.parameter("v0");
  const auto p = problem.tube("p");
  std::vector<double> target{0.3, -1.2, 0.77, 0.1, 1.9, -0.4, 0.05}, velocity(7);
  const std::size_t before = allocations;
  const auto bytes_before = mallinfo2().uordblks;
  for (int cycle = 0; cycle < 200; ++cycle) {
    for (std::size_t k = 0; k < 7; ++k) velocity[k] = 1e-3 * cycle * target[k];
    problem.set(p1, target);
    problem.set(v0, velocity);
    ASSERT_EQ(problem.solve(), OnlineStatus::solved) << cycle << ' ' << problem.reason();
    ASSERT_FALSE(problem.value(p).at(0, Interval(0.1)).is_empty());
  }
  EXPECT_EQ(allocations, before);
  EXPECT_EQ(mallinfo2().uordblks, bytes_before);
}

TEST(LoopInput, WrongNumbersAreAStatus) {
  CompiledProblem problem = seven_joints("type1");
  const auto p1 = problem.parameter("p1"), vmax = problem.parameter("vmax");
  const std::vector<double> target{0.3, -1.2, 0.77, 0.1, 1.9, -0.4, 0.05}, limits(7, 1.0);
  std::vector<double> wrong = target;
  wrong[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(problem.set(p1, wrong));
  EXPECT_EQ(problem.solve(), OnlineStatus::invalid);
  EXPECT_EQ(problem.reason(), "p1");
  EXPECT_FALSE(problem.set(p1, std::span<const double>(target).first(3)));
  EXPECT_EQ(problem.solve(), OnlineStatus::invalid);
  EXPECT_TRUE(problem.set(p1, target));
  EXPECT_EQ(problem.solve(), OnlineStatus::solved);
  EXPECT_TRUE(problem.set(vmax, std::vector<double>(7, -1.0)));
  EXPECT_EQ(problem.solve(), OnlineStatus::infeasible);
  EXPECT_TRUE(problem.set(vmax, limits));
  EXPECT_EQ(problem.solve(), OnlineStatus::solved);
}

INSTANTIATE_TEST_SUITE_P(Types, Loop, ::testing::Values("type1", "type3"));

}  // namespace
}  // namespace hcsp
