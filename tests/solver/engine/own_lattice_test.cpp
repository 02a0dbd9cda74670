// SPDX-License-Identifier: Apache-2.0
// A lattice that the library does not know, with its own Delta and its own contractors, in one graph with the
// library's intervals. docs/contractors.md walks through this file: it is the template for a new lattice and
// a new contractor.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "domains/interval/interval.h"
#include "solver/engine/propagation.h"
#include "tests/support/laws.h"
#include "tests/support/oracle.h"

namespace own {

// [lattice] A set of integers 0, ..., 63 that a variable may take, one bit each. Its Delta is the set of the
// values that it lost.
class SmallIntegers {
 public:
  struct Delta {
    std::uint64_t lost = 0;
    [[nodiscard]] bool is_none() const { return lost == 0; }
    void join(const Delta& other) { lost |= other.lost; }
  };

  SmallIntegers() = default;  // all of them
  explicit SmallIntegers(std::uint64_t bits) : bits_(bits) {}

  [[nodiscard]] bool is_empty() const { return bits_ == 0; }
  [[nodiscard]] std::uint64_t bits() const { return bits_; }
  [[nodiscard]] int smallest() const { return std::countr_zero(bits_); }
  [[nodiscard]] int largest() const { return 63 - std::countl_zero(bits_); }
  friend bool operator==(const SmallIntegers&, const SmallIntegers&) = default;

 private:
  std::uint64_t bits_ = ~std::uint64_t{0};
};

SmallIntegers meet(const SmallIntegers& a, const SmallIntegers& b) {
  return SmallIntegers(a.bits() & b.bits());
}
SmallIntegers join(const SmallIntegers& a, const SmallIntegers& b) {
  return SmallIntegers(a.bits() | b.bits());
}
bool leq(const SmallIntegers& a, const SmallIntegers& b) { return (a.bits() & ~b.bits()) == 0; }
SmallIntegers top(const SmallIntegers&) { return {}; }
SmallIntegers bottom(const SmallIntegers&) { return SmallIntegers(0); }
SmallIntegers::Delta everything(const SmallIntegers&) { return {~std::uint64_t{0}}; }
SmallIntegers::Delta contract(SmallIntegers& a, const SmallIntegers& b) {
  const std::uint64_t lost = a.bits() & ~b.bits();
  a = meet(a, b);
  return {lost};
}

static_assert(hcsp::Lattice<SmallIntegers>);
// [lattice]

// [contractor] y == x + step. A value that one side has lost is lost on the other: a run costs what the
// Deltas cost.
class ShiftContractor final : public hcsp::Contractor {
 public:
  ShiftContractor(const std::string& name, hcsp::VariableId x, hcsp::VariableId y, int step)
      : hcsp::Contractor(name, name, hcsp::Cost::constant, {x, y}, {x, y}), x_(x), y_(y), step_(step) {}

  void contract(hcsp::Access& access) override {
    constexpr std::uint64_t kAll = ~std::uint64_t{0};
    const std::uint64_t gone_x = gone(access, x_), gone_y = gone(access, y_);
    remove(access, y_, (gone_x << step_) | ~(kAll << step_));
    remove(access, x_, (gone_y >> step_) | ~(kAll >> step_));
    access.settled();  // what was removed is what the other side has lost already
  }

 private:
  // The first run is told "everything", which is more than was lost.
  static std::uint64_t gone(const hcsp::Access& access, hcsp::VariableId v) {
    return access.delta<SmallIntegers>(v).lost & ~access.domain<SmallIntegers>(v).bits();
  }

  static void remove(hcsp::Access& access, hcsp::VariableId v, std::uint64_t values) {
    access.report<SmallIntegers>(v, own::contract(access.edit<SmallIntegers>(v), SmallIntegers(~values)));
  }

  hcsp::VariableId x_, y_;
  int step_;
};
// [contractor]

// n == r: an integer of the new lattice is a real of the library's.
class ChannelContractor final : public hcsp::Contractor {
 public:
  ChannelContractor(const std::string& name, hcsp::VariableId n, hcsp::VariableId r)
      : hcsp::Contractor(name, name, hcsp::Cost::linear, {n, r}, {n, r}), n_(n), r_(r) {}

  void contract(hcsp::Access& access) override {
    std::uint64_t possible = 0;
    for (int value = 0; value < 64; ++value) {
      if (access.domain<hcsp::Interval>(r_).contains(value)) possible |= std::uint64_t{1} << value;
    }
    auto& n = access.edit<SmallIntegers>(n_);
    access.report<SmallIntegers>(n_, own::contract(n, SmallIntegers(possible)));
    if (n.is_empty()) return;
    auto& r = access.edit<hcsp::Interval>(r_);
    access.report<hcsp::Interval>(r_, hcsp::contract(r, hcsp::Interval(n.smallest(), n.largest())));
  }

 private:
  hcsp::VariableId n_, r_;
};

}  // namespace own

namespace hcsp {
namespace {

using own::ChannelContractor;
using own::ShiftContractor;
using own::SmallIntegers;

std::uint64_t bits_of(std::initializer_list<int> values) {
  std::uint64_t bits = 0;
  for (const int value : values) bits |= std::uint64_t{1} << value;
  return bits;
}

TEST(OwnLattice, ObeysTheLaws) {
  check_lattice_laws<SmallIntegers>({SmallIntegers(), SmallIntegers(0), SmallIntegers(bits_of({1, 2, 3})),
                                     SmallIntegers(bits_of({3, 4})), SmallIntegers(bits_of({40, 63})),
                                     SmallIntegers(bits_of({2}))});
}

// [use]
TEST(OwnLattice, PropagatesWithTheLibrarysIntervals) {
  ContractorGraph graph;
  const VariableId m = graph.add_variable("m", SmallIntegers(bits_of({1, 4, 9, 16, 25, 36})));
  const VariableId n = graph.add_variable("n", SmallIntegers());
  const VariableId r = graph.add_variable("r", Interval(8.5, 30));
  graph.add_contractor(std::make_unique<ShiftContractor>("n == m + 3", m, n, 3));
  graph.add_contractor(std::make_unique<ChannelContractor>("n == r", n, r));

  Propagation run(graph, {});
  ASSERT_EQ(run.run(), Ending::fixed_point);
  EXPECT_EQ(run.domain<SmallIntegers>(m), SmallIntegers(bits_of({9, 16, 25})));
  EXPECT_EQ(run.domain<SmallIntegers>(n), SmallIntegers(bits_of({12, 19, 28})));
  EXPECT_EQ(run.domain<Interval>(r), Interval(12, 28));
}
// [use]

TEST(OwnLattice, IsFoundEmpty) {
  ContractorGraph graph;
  const VariableId m = graph.add_variable("m", SmallIntegers(bits_of({1, 4})));
  const VariableId n = graph.add_variable("n", SmallIntegers());
  const VariableId r = graph.add_variable("r", Interval(8, 9));
  graph.add_contractor(std::make_unique<ShiftContractor>("shift", m, n, 3));
  graph.add_contractor(std::make_unique<ChannelContractor>("channel", n, r));
  Propagation run(graph, {});
  EXPECT_EQ(run.run(), Ending::empty);
  ASSERT_TRUE(run.failure().has_value());
  EXPECT_EQ(graph.contractors()[run.failure()->contractor.value()]->name(), "channel");
  EXPECT_EQ(run.failure()->variable, n);
}

// The exact solutions of a random chain n_{i+1} == n_i + step_i, n_last == r, by trying every value.
TEST(OwnLattice, RandomChainsAreSolvedExactlyInEveryOrder) {
  oracle::for_seeds(200, [](oracle::Dice& dice) {
    constexpr int kLength = 4;
    ContractorGraph graph;
    std::vector<VariableId> chain;
    std::vector<std::uint64_t> domains;
    std::vector<int> offsets{0};
    for (int i = 0; i < kLength; ++i) {
      std::uint64_t bits = 0;
      for (int value = 0; value < 64; ++value)
        bits |= static_cast<std::uint64_t>(dice.below(4) != 0) << value;
      domains.push_back(bits);
      chain.push_back(graph.add_variable("n" + std::to_string(i), SmallIntegers(bits)));
    }
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      const int step = dice.below(9);
      offsets.push_back(offsets.back() + step);
      graph.add_contractor(
          std::make_unique<ShiftContractor>("s" + std::to_string(i), chain[i], chain[i + 1], step));
    }
    const Interval bound(dice.below(30), 30 + dice.below(30));
    const VariableId r = graph.add_variable("r", bound);
    graph.add_contractor(std::make_unique<ChannelContractor>("channel", chain.back(), r));

    std::uint64_t first = 0;  // the values of n0 that a solution takes
    for (int value = 0; value + offsets.back() < 64; ++value) {
      bool holds = bound.contains(value + offsets.back());
      for (std::size_t i = 0; i < chain.size(); ++i)
        holds = holds && ((domains[i] >> (value + offsets[i])) & 1U) != 0;
      first |= static_cast<std::uint64_t>(holds) << value;
    }
    for (const Order order : {Order::declared, Order::reversed, Order::shuffled}) {
      PropagationOptions options;
      options.order = order;
      Propagation run(graph, options);
      const Ending ending = run.run();
      ASSERT_EQ(ending, first == 0 ? Ending::empty : Ending::fixed_point);
      if (first == 0) continue;
      for (std::size_t i = 0; i < chain.size(); ++i) {
        EXPECT_EQ(run.domain<SmallIntegers>(chain[i]), SmallIntegers(first << offsets[i]));
      }
    }
  });
}

}  // namespace
}  // namespace hcsp
