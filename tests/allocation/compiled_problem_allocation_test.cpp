// SPDX-License-Identifier: Apache-2.0
// The loop around a compiled problem allocates nothing. operator new counts, in this executable alone.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <random>

#include "tests/support/straight_line.h"
#include "tests/support/two_circles.h"

namespace {
std::size_t allocations = 0;

void* counted(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void* operator new(std::size_t size, std::align_val_t) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }

namespace hcsp {
namespace {

static_assert(noexcept(std::declval<CompiledProblem&>().solve()));
static_assert(noexcept(std::declval<CompiledProblem&>().set({}, 0.0)));
static_assert(noexcept(std::declval<CompiledProblem&>().objective()));

template <class Draw>
std::size_t allocations_of(CompiledProblem& compiled,
                           const std::vector<CompiledProblem::Parameter>& parameters, Draw draw,
                           std::array<int, 4>& counts) {
  const std::vector<CompiledProblem::Variable> read{compiled.variable("x")};
  const std::size_t before = allocations;
  for (int k = 0; k < 2000; ++k) {
    for (const CompiledProblem::Parameter& parameter : parameters) compiled.set(parameter, draw(k));
    ++counts[static_cast<std::size_t>(compiled.solve())];
    if (compiled.has_solution() && compiled.value(read[0]).empty()) return ~std::size_t{0};
    if (compiled.reason().size() > 1000 || compiled.objective().width() < 0.0) return ~std::size_t{0};
  }
  return allocations - before;
}

TEST(Allocation, ALoopAllocatesNothing) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(0.1, 3.0);
  std::array<int, 4> counts{};
  oracle::StraightLine line(1);
  CompiledProblem motion = line.compiled();
  const std::vector moved{motion.parameter("d"), motion.parameter("v0"), motion.parameter("vmax"),
                          motion.parameter("amax"), motion.parameter("jmax")};
  const auto with_bad = [&](int k) { return k % 97 == 0 ? std::nan("") : uniform(random); };
  EXPECT_EQ(allocations_of(motion, moved, with_bad, counts), 0U);
  oracle::TwoCircles circles;
  CompiledProblem point = circles.compiled();
  const std::vector changed{point.parameter("r"), point.parameter("c"), point.parameter("s"),
                            point.parameter("a")};
  EXPECT_EQ(allocations_of(point, changed, with_bad, counts), 0U);
  EXPECT_GT(counts[static_cast<std::size_t>(OnlineStatus::solved)], 500);
  EXPECT_GT(counts[static_cast<std::size_t>(OnlineStatus::infeasible)], 100);
  EXPECT_GT(counts[static_cast<std::size_t>(OnlineStatus::invalid)], 10);
}

}  // namespace
}  // namespace hcsp
