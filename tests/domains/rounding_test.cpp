// SPDX-License-Identifier: Apache-2.0
// The floating-point environment of the embedding program: whatever rounding mode, flush-to-zero or
// denormals-are-zero flags it set, results are the same bits and the environment is left as found, on every
// thread.
#include "domains/rounding.h"
#include "domains/interval/reverse.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <thread>
#include <vector>

#include "domains/interval/kernel.h"
#include "tests/support/environment.h"
#include "tests/support/truth.h"

namespace hcsp {
namespace {

using oracle::Dice;
using oracle::Environment;

struct Operands {
  Interval a, b;
};

std::vector<Operands> operands() {
  Dice dice;
  std::vector<Operands> result;
  for (int i = 0; i < 400; ++i) result.push_back({dice.interval(), dice.interval()});
  const Interval subnormal = Interval::raw(0.0, 0x1p-1074);
  result.push_back({subnormal, Interval(0.0)});
  result.push_back({-subnormal, Interval::raw(0x1p-1074, 1.0)});
  return result;
}

std::vector<Interval> everything_of(const Operands& o) {
  Interval y = o.a, x = o.b;
  atan2_rev(Interval::raw(0.5, 2.5), y, x);
  return {o.a + o.b,
          o.a - o.b,
          o.a * o.b,
          o.a / o.b,
          sqr(o.a),
          abs(o.a),
          min(o.a, o.b),
          max(o.a, o.b),
          sqrt(o.a),
          sin(o.a),
          cos(o.b),
          atan2(o.a, o.b),
          sin_rev(o.a, o.b),
          cos_rev(o.a, o.b),
          y,
          x,
          Interval::of_decimal("0.1"),
          Interval::of_decimal("-1e-310")};
}

/// Equal bits but for the sign of zero. Bits, since the environment under test may compare subnormals equal
/// to zero.
bool same_bits(double a, double b) {
  constexpr std::uint64_t kMagnitude = ~(std::uint64_t{1} << 63);
  const auto x = std::bit_cast<std::uint64_t>(a), y = std::bit_cast<std::uint64_t>(b);
  return x == y || ((x | y) & kMagnitude) == 0;
}

void expect_same_under(int mode, bool flush, const std::vector<Operands>& inputs,
                       const std::vector<std::vector<Interval>>& expected) {
  std::vector<std::vector<Interval>> found;
  bool kept = true;
  {
    Environment environment(mode, flush);
    const unsigned before = oracle::control_bits();
    for (const Operands& o : inputs) {
      found.push_back(everything_of(o));
      kept = kept && oracle::control_bits() == before;
    }
  }
  EXPECT_TRUE(kept) << "mode " << mode << " flush " << flush;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (std::size_t k = 0; k < expected[i].size(); ++k) {
      const Interval &f = found[i][k], &e = expected[i][k];
      ASSERT_TRUE(same_bits(f.lo(), e.lo()) && same_bits(f.hi(), e.hi()))
          << "mode " << mode << " flush " << flush << " operation " << k << " on " << to_string(inputs[i].a)
          << ", " << to_string(inputs[i].b) << ": " << to_string(f) << " for " << to_string(e) << ", seed "
          << Dice::kSeed;
    }
  }
}

TEST(Rounding, GuardsSetTheModeAndRestoreIt) {
  for (const int mode : oracle::kRoundingModes) {
    for (const bool flush : {false, true}) {
      Environment environment(mode, flush);
      const unsigned before = oracle::control_bits();
      {
        RoundUpward upward;
        EXPECT_GT(opaque(1.0) + opaque(0x1p-1074), 1.0);
        EXPECT_EQ(opaque(0x1p-1022) * opaque(0.5), 0x1p-1023) << "gradual underflow";
        {
          RoundNearest nearest;
          EXPECT_EQ(opaque(1.0) + opaque(0x1p-53), 1.0);
          EXPECT_EQ(opaque(1.0) + opaque(0x1.8p-53), 1.0 + 0x1p-52);
        }
        EXPECT_GT(opaque(1.0) + opaque(0x1p-1074), 1.0);
      }
      EXPECT_EQ(oracle::control_bits(), before);
    }
  }
}

TEST(Rounding, EveryModeGivesTheSameBits) {
  const auto inputs = operands();
  std::vector<std::vector<Interval>> expected;
  for (const Operands& o : inputs) expected.push_back(everything_of(o));
  for (const int mode : oracle::kRoundingModes) {
    for (const bool flush : {false, true}) expect_same_under(mode, flush, inputs, expected);
  }
}

TEST(Rounding, ThreadsDoNotDisturbEachOther) {
  const auto inputs = operands();
  std::vector<std::vector<Interval>> expected;
  for (const Operands& o : inputs) expected.push_back(everything_of(o));
  std::thread upward([&] { expect_same_under(FE_UPWARD, false, inputs, expected); });
  std::thread downward([&] { expect_same_under(FE_DOWNWARD, true, inputs, expected); });
  upward.join();
  downward.join();
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

}  // namespace
}  // namespace hcsp
