// SPDX-License-Identifier: Apache-2.0
// Every operation on intervals against MPFR, on random and corner intervals: each result holds what it must,
// and those of the forward operations are the tightest. 10^6 cases an operation, in turn under the four
// rounding modes and with subnormal numbers flushed by the caller, and from two threads at once.
// HCSP_CAMPAIGN=n sets the number of cases, HCSP_FULL=1 makes it 10^9, with new numbers for every 10^6.
//
// A function of one variable is evaluated by MPFR at 250,000 of these numbers, one of two at the 100,000
// points of a grid, and every interval between them is a case; arithmetic is evaluated anew in each case.
// Every other case of a reverse operation is around one of 20,000 real solutions, which are seldom doubles.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "tests/soundness/interval_sources.h"
#include "tests/support/environment.h"
#include "tests/support/truth.h"

namespace hcsp::campaign {
namespace {

constexpr std::uint64_t kSeed = 20240611, kCasesOfRun = 1000000;
constexpr std::size_t kBatch = 512;

std::uint64_t cases_asked() {
  if (const char* count = std::getenv("HCSP_CAMPAIGN")) return std::strtoull(count, nullptr, 10);
  return std::getenv("HCSP_FULL") != nullptr ? 1000000000 : kCasesOfRun;
}

/// An environment of the caller: a rounding mode, and whether subnormal numbers are flushed.
struct Caller {
  int mode;
  bool flush;
};
Caller caller_number(std::uint64_t k, const Operation& operation) {
  return {oracle::kRoundingModes[k % 4], k / 4 % 2 == 1 && operation.flushes};
}

std::vector<Case> draw_cases(Source& source, std::size_t count, Draw& draw) {
  std::vector<Case> cases;
  cases.reserve(count);
  for (std::size_t k = 0; k < count; ++k) cases.push_back(source.next(draw));
  return cases;
}

/// Nothing but the operation under test runs in the caller's environment. False where it is not left as
/// found.
[[gnu::noinline]] bool run(const Operation& operation, std::size_t variant, const std::vector<Case>& cases,
                           const Caller& caller, std::vector<Outcome>& outcomes) {
  outcomes.resize(cases.size());
  const oracle::Environment environment(caller.mode, caller.flush);
  const unsigned before = oracle::control_bits();
  bool kept = true;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    outcomes[k] = operation.apply(cases[k].in, variant);
    kept &= oracle::control_bits() == before;
  }
  return kept;
}

/// Bounds as the kernels want them: the empty set has one form, others are no NaN.
bool is_well_formed(const Interval& a) {
  if (a.is_empty()) return a.lo() == kInfinity && a.hi() == -kInfinity;
  return a.lo() < kInfinity && a.hi() > -kInfinity;
}

bool holds(const Outcome& found, const Case& c, const Operation& operation) {
  const auto all_in = [&](const Interval& a) {
    for (std::size_t k = 0; k < c.count; ++k) {
      if (!c.inside[k].is_within(a)) return false;
    }
    return true;
  };
  switch (operation.promise) {
    case Promise::tightest:
      return found[0] == c.exact && all_in(found[0]);
    case Promise::part_of_last:
      return all_in(found[0]) && leq(found[0], c.in[operation.arity - 1]);
    case Promise::either:
      return (found[1].is_empty() || found[0].is_empty() || found[0].hi() <= found[1].lo()) &&
             (c.count == 0 || c.inside[0].is_within(found[0]) || c.inside[0].is_within(found[1]));
    case Promise::each:
      for (std::size_t k = 0; k < c.count; ++k) {
        if (!c.inside[k].is_within(found[k])) return false;
      }
      return leq(found[0], c.in[1]) && leq(found[1], c.in[2]);
  }
  return false;
}

/// Everything to see a failure again by hand.
std::string description(const Operation& operation, std::size_t variant, const Case& c, const Outcome& found,
                        const Caller& caller) {
  std::ostringstream out;
  out << operation.name << ", variant " << variant << ", mode " << caller.mode << ", flush " << caller.flush
      << ':';
  for (std::size_t k = 0; k < operation.arity; ++k) PrintTo(c.in[k], &(out << ' '));
  PrintTo(found[0], &(out << " gave "));
  if (operation.promise == Promise::either || operation.promise == Promise::each)
    PrintTo(found[1], &(out << ' '));
  if (operation.promise == Promise::tightest) PrintTo(c.exact, &(out << " for "));
  for (std::size_t k = 0; k < c.count; ++k)
    PrintTo(Interval::raw(c.inside[k].lo, c.inside[k].hi), &(out << " with "));
  return out.str();
}

void check(const Operation& operation, std::size_t variant, const std::vector<Case>& cases,
           const std::vector<Outcome>& outcomes, const Caller& caller) {
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const bool formed = is_well_formed(outcomes[k][0]) && is_well_formed(outcomes[k][1]);
    EXPECT_TRUE(formed && holds(outcomes[k], cases[k], operation))
        << description(operation, variant, cases[k], outcomes[k], caller);
  }
}

/// The cases of one variant, from one seed.
void run_variant(const Operation& operation, std::size_t variant, std::uint64_t seed, std::uint64_t count) {
  Draw draw(seed);
  const auto source = operation.source(draw, variant);
  std::vector<Outcome> outcomes;
  for (std::uint64_t done = 0, batch = 0; done < count; done += kBatch, ++batch) {
    const std::vector<Case> cases = draw_cases(*source, std::min<std::uint64_t>(kBatch, count - done), draw);
    const Caller caller = caller_number(batch, operation);
    EXPECT_TRUE(run(operation, variant, cases, caller, outcomes)) << "environment, mode " << caller.mode;
    check(operation, variant, cases, outcomes, caller);
    if (::testing::Test::HasFailure()) return;
  }
}

/// One test an operation, named after it.
class IntervalCampaign : public ::testing::Test {
 public:
  explicit IntervalCampaign(const Operation& operation) : operation_(operation) {}

  void TestBody() override {
    const std::uint64_t asked = cases_asked();
    for (std::uint64_t done = 0, seed = kSeed; done < asked; done += kCasesOfRun, ++seed) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed);
      const std::uint64_t of_run = std::min(kCasesOfRun, asked - done);
      const std::uint64_t share = (of_run + operation_.variants - 1) / operation_.variants;
      for (std::size_t variant = 0; variant < operation_.variants; ++variant) {
        run_variant(operation_, variant, seed, share);
        if (HasFailure()) return;
      }
    }
  }

 private:
  const Operation& operation_;
};

const bool kRegistered = [] {
  for (const Operation& operation : operations()) {
    ::testing::RegisterTest("IntervalCampaign", operation.name.c_str(), nullptr, nullptr, __FILE__, __LINE__,
                            [&operation]() -> ::testing::Test* { return new IntervalCampaign(operation); });
  }
  return !operations().empty();
}();

// ---- Two threads.

/// The cases of an operation, and its outcomes in one thread.
struct Recorded {
  const Operation* operation;
  std::vector<Case> cases;
  std::vector<Outcome> outcomes;
};

bool same_bits(const Interval& a, const Interval& b) {
  return std::bit_cast<std::uint64_t>(a.lo()) == std::bit_cast<std::uint64_t>(b.lo()) &&
         std::bit_cast<std::uint64_t>(a.hi()) == std::bit_cast<std::uint64_t>(b.hi());
}

/// Every operation again, from the first to the last or the other way round; the number of differences.
int differences(const std::vector<Recorded>& records, const Caller& caller, bool backwards) {
  int count = 0;
  std::vector<Outcome> outcomes;
  for (std::size_t k = 0; k < records.size(); ++k) {
    const Recorded& record = records[backwards ? records.size() - 1 - k : k];
    const Caller own{caller.mode, caller.flush && record.operation->flushes};
    if (!run(*record.operation, 0, record.cases, own, outcomes)) ++count;
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
      const Outcome &found = outcomes[i], &expected = record.outcomes[i];
      if (!same_bits(found[0], expected[0]) || !same_bits(found[1], expected[1])) ++count;
    }
  }
  return count;
}

TEST(IntervalCampaignThreads, TwoAtOnceGiveTheSameBits) {
  ASSERT_TRUE(kRegistered);
  const std::uint64_t count = std::min<std::uint64_t>(cases_asked() / 50, 20000);
  std::vector<Recorded> records;
  for (const Operation& operation : operations()) {
    Draw draw(kSeed);
    const auto source = operation.source(draw, 0);
    Recorded record{&operation, draw_cases(*source, count, draw), {}};
    ASSERT_TRUE(run(operation, 0, record.cases, caller_number(0, operation), record.outcomes));
    check(operation, 0, record.cases, record.outcomes, caller_number(0, operation));
    records.push_back(std::move(record));
  }
  int up = -1, down = -1;
  std::thread upward([&] { up = differences(records, {FE_UPWARD, false}, false); });
  std::thread downward([&] { down = differences(records, {FE_DOWNWARD, true}, true); });
  upward.join();
  downward.join();
  EXPECT_EQ(up, 0);
  EXPECT_EQ(down, 0);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
}

}  // namespace
}  // namespace hcsp::campaign
