// SPDX-License-Identifier: Apache-2.0
#include "solver/search/checkpoint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/problem.h"

namespace hcsp {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Checkpoint, KeepsBoundsExactly) {
  const std::vector<Interval> box{{0.1, 1.0 / 3}, {-kInfinity, 5e-324}, {1.0, 1.0}};
  const std::string bytes = sealed(json_of(box), 7);
  EXPECT_EQ(box_of(opened(bytes, 7)), box);
}

TEST(Checkpoint, RefusesWhatIsDamagedOrAnothers) {
  const std::string bytes = sealed({{"a", 1}}, 7);
  EXPECT_THAT([&] { opened(bytes, 8); }, ThrowsMessage<std::invalid_argument>(HasSubstr("of another model")));
  EXPECT_THAT([&] { opened("no such thing", 7); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("no checkpoint")));
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    EXPECT_THROW(opened(damaged, 7), std::invalid_argument) << i;
    EXPECT_THROW(opened(bytes.substr(0, i), 7), std::invalid_argument) << i;
  }
}

// Caprasse's system, which takes some hundreds of cells.
void state_caprasse(Problem& problem, double bound) {
  Box domain(4);
  for (Eigen::Index i = 0; i < domain.dim(); ++i) domain[i] = Interval(-bound, bound);
  const VectorVariable all = problem.vector("x", domain);
  const VectorExpr v = problem(all);
  const Expr x = v[0], y = v[1], z = v[2], t = v[3];
  const auto number = [&](double value) { return problem.constant(Interval(value)); };
  const auto zero = Interval(0.0);
  problem.constrain("1", sqr(y) * z + number(2) * x * y * t - number(2) * x - z == zero);
  problem.constrain("2", -pown(x, 3) * z + number(4) * x * sqr(y) * z + number(4) * sqr(x) * y * t +
                                 number(2) * pown(y, 3) * t + number(4) * sqr(x) - number(10) * sqr(y) +
                                 number(4) * x * z - number(10) * y * t + number(2) ==
                             zero);
  problem.constrain("3", number(2) * y * z * t + x * sqr(t) - x - number(2) * z == zero);
  problem.constrain("4", -x * pown(z, 3) + number(4) * y * sqr(z) * t + number(4) * x * z * sqr(t) +
                                 number(2) * y * pown(t, 3) + number(4) * x * z + number(4) * sqr(z) -
                                 number(10) * y * t - number(10) * sqr(t) + number(2) ==
                             zero);
}

std::vector<std::vector<Interval>> boxes_of(const Result& result) {
  std::vector<std::vector<Interval>> boxes;
  for (const Solution& solution : result.search->solutions) {
    auto& box = boxes.emplace_back();
    const Box& x = std::get<Box>(solution.variables.front().domain);
    for (Eigen::Index i = 0; i < x.dim(); ++i) box.push_back(x[i]);
  }
  return boxes;
}

TEST(Checkpoint, AnyStateLeadsToTheSameAnswer) {
  Problem problem("caprasse");
  state_caprasse(problem, 10);
  const Result whole = problem.solve_all();
  std::vector<std::string> states;
  SearchOptions options;
  options.threads = 2;
  options.checkpoint_period = 1e-3;
  options.checkpoint = [&](const std::string& state) { states.push_back(state); };
  problem.solve_all(options);
  ASSERT_GT(states.size(), 3U);
  for (std::size_t i = 0; i < states.size(); i += 1 + states.size() / 4) {
    SearchOptions again;
    again.resume = states[i];
    const Result result = problem.solve_all(again);
    EXPECT_EQ(boxes_of(result), boxes_of(whole));
    EXPECT_EQ(result.search->cells, whole.search->cells);
  }
  SearchOptions ended;
  ended.resume = states.back();
  EXPECT_EQ(boxes_of(problem.solve_all(ended)), boxes_of(whole));
  Problem other("caprasse");
  state_caprasse(other, 11);
  EXPECT_THROW(other.solve_all(ended), std::invalid_argument);
}

}  // namespace
}  // namespace hcsp
