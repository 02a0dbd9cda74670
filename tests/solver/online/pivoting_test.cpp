// SPDX-License-Identifier: Apache-2.0
#include "solver/online/pivoting.h"

#include <gtest/gtest.h>

#include <random>

namespace hcsp::online {
namespace {

TEST(Pivoting, SolvesAgainForOtherRightSides) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (std::size_t size = 1; size <= 6; ++size) {
    Pivoting pivoting(size, size);
    std::vector<double> matrix(size * size), wanted(size);
    for (double& entry : matrix) entry = uniform(random);
    const auto set_right = [&] {
      for (double& x : wanted) x = uniform(random);
      for (std::size_t i = 0; i < size; ++i) {
        pivoting.right(i) = 0.0;
        for (std::size_t j = 0; j < size; ++j) pivoting.right(i) += matrix[i * size + j] * wanted[j];
      }
    };
    const auto expect_solution = [&] {
      for (std::size_t k = 0; k < size; ++k)
        EXPECT_NEAR(pivoting.solution(k), wanted[pivoting.column(k)], 1e-9) << size;
    };
    pivoting.start(size, size);
    for (std::size_t i = 0; i < size * size; ++i) pivoting.at(i / size, i % size) = matrix[i];
    set_right();
    ASSERT_TRUE(pivoting.eliminate(1e-15));
    ASSERT_EQ(pivoting.rank(), size);
    expect_solution();
    set_right();
    pivoting.solve_again();
    expect_solution();
  }
}

}  // namespace
}  // namespace hcsp::online
