// SPDX-License-Identifier: Apache-2.0
// Random cases by number: some by default, many under HCSP_FULL=1, one under HCSP_SEED=n.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>

namespace hcsp::straight_line {

/// Random numbers of one case.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : generator_(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(generator_); }
  bool chance(double p) { return in(0, 1) < p; }
  double sign() { return chance(0.5) ? 1 : -1; }
  /// Of any magnitude between the two.
  double magnitude(double low, double high) { return std::exp(in(std::log(low), std::log(high))); }

 private:
  std::mt19937_64 generator_;
};

inline bool full() {
  const char* value = std::getenv("HCSP_FULL");
  return value != nullptr && std::string(value) == "1";
}

/// Runs cases 1 to `count` (`full_count`), or the one that the environment names; a case that fails tells how
/// to run it again. Many failures end a run.
template <typename Case>
void run_cases(std::uint64_t count, std::uint64_t full_count, const Case& run_case) {
  const char* only = std::getenv("HCSP_SEED");
  const std::uint64_t first = only != nullptr ? std::strtoull(only, nullptr, 10) : 1;
  const std::uint64_t last = only != nullptr ? first : full() ? full_count : count;
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::uint64_t most_failures = full() ? 1000 : 10;
  for (std::uint64_t seed = first, failed = 0; seed <= last && failed < most_failures; ++seed) {
    SCOPED_TRACE(::testing::Message() << "again: HCSP_SEED=" << seed << " straight_line_tests --gtest_filter="
                                      << test->test_suite_name() << '.' << test->name());
    const int before = ::testing::UnitTest::GetInstance()->current_test_info()->result()->total_part_count();
    Draw draw(seed);
    run_case(draw);
    failed += test->result()->total_part_count() > before ? 1 : 0;
  }
}

}  // namespace hcsp::straight_line
