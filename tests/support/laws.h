// SPDX-License-Identifier: Apache-2.0
// The laws of a lattice of domains, checked on samples of one shape: every type that models hcsp::Lattice
// must pass, with samples that include the top, the bottom, and pairs that overlap, touch, nest and are
// disjoint.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "domains/lattice.h"

namespace hcsp {

template <Lattice D>
void check_laws_of_one(const D& a) {
  EXPECT_TRUE(a == a);
  EXPECT_TRUE(meet(a, a) == a) << "meet is idempotent";
  EXPECT_TRUE(join(a, a) == a) << "join is idempotent";
  EXPECT_TRUE(leq(a, a)) << "order is reflexive";
  EXPECT_TRUE(leq(bottom(a), a) && leq(a, top(a)));
  EXPECT_TRUE(meet(a, top(a)) == a && join(a, bottom(a)) == a) << "top and bottom are neutral";
  EXPECT_TRUE(meet(a, bottom(a)) == bottom(a) && join(a, top(a)) == top(a)) << "top and bottom absorb";
  EXPECT_EQ(a.is_empty(), a == bottom(a)) << "there is one empty domain";
  EXPECT_TRUE(typename D::Delta{}.is_none());
}

template <Lattice D>
void check_laws_of_two(const D& a, const D& b) {
  const D met = meet(a, b), joined = join(a, b);
  EXPECT_TRUE(met == meet(b, a)) << "meet commutes";
  EXPECT_TRUE(joined == join(b, a)) << "join commutes";
  EXPECT_TRUE(meet(a, joined) == a) << "meet absorbs join";
  EXPECT_TRUE(join(a, met) == a) << "join absorbs meet";
  EXPECT_TRUE(leq(met, a) && leq(met, b)) << "meet is below both";
  EXPECT_TRUE(leq(a, joined) && leq(b, joined)) << "join is above both";
  EXPECT_EQ(leq(a, b), met == a) << "order is consistent with meet";
  EXPECT_EQ(leq(a, b), joined == b) << "order is consistent with join";
  EXPECT_EQ(leq(a, b) && leq(b, a), a == b) << "order is antisymmetric";
  D contracted = a;
  auto delta = contract(contracted, b);
  EXPECT_TRUE(contracted == met) << "contract is meet";
  EXPECT_EQ(delta.is_none(), contracted == a) << "a Delta is none exactly when nothing changed";
  const bool was_none = delta.is_none();
  delta.join(typename D::Delta{});
  EXPECT_EQ(delta.is_none(), was_none) << "nothing is neutral among Deltas";
  EXPECT_TRUE(contract(contracted, b).is_none()) << "contract is idempotent";
}

template <Lattice D>
void check_laws_of_three(const D& a, const D& b, const D& c) {
  EXPECT_TRUE(meet(meet(a, b), c) == meet(a, meet(b, c))) << "meet is associative";
  EXPECT_TRUE(join(join(a, b), c) == join(a, join(b, c))) << "join is associative";
  if (leq(a, b)) {
    EXPECT_TRUE(leq(meet(a, c), meet(b, c)) && leq(join(a, c), join(b, c))) << "both are monotone";
    EXPECT_TRUE(!leq(b, c) || leq(a, c)) << "order is transitive";
  }
}

/// Checks every law on every sample, pair and triple; the samples' numbers are told on failure.
template <Lattice D>
void check_lattice_laws(const std::vector<D>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    SCOPED_TRACE(::testing::Message() << "sample " << i);
    check_laws_of_one(samples[i]);
    for (std::size_t j = 0; j < samples.size(); ++j) {
      SCOPED_TRACE(::testing::Message() << "and sample " << j);
      check_laws_of_two(samples[i], samples[j]);
      for (std::size_t k = 0; k < samples.size(); ++k) {
        SCOPED_TRACE(::testing::Message() << "and sample " << k);
        check_laws_of_three(samples[i], samples[j], samples[k]);
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

}  // namespace hcsp
