// SPDX-License-Identifier: Apache-2.0
// The one algebra of hcsp: every unknown lives in a complete lattice and its domain is an interval of it.
// A domain type models Lattice; its Delta tells what a contraction changed, so that the engine wakes only
// what looks at the part that moved (Jaulin, IEEE T-RO 27(5), 2011, section III; docs/mathematics.md).
#pragma once

#include <concepts>

namespace hcsp {

/// What a contraction changed. A default-constructed Delta is "nothing"; join accumulates.
template <class T>
concept DeltaType = std::default_initializable<T> && std::copyable<T> && requires(T a, const T& b) {
  { b.is_none() } -> std::convertible_to<bool>;
  a.join(b);
};

/// A lattice of domains. For domains a, b of one shape (dimension, time line, grid):
///   meet(a, b)      the intersection: the greatest domain below both;
///   join(a, b)      the interval hull of the union: the least domain above both;
///   leq(a, b)       every value of a is a value of b;
///   a.is_empty()    no value is left: the one least domain;
///   top(a), bottom(a)   the greatest and the least domain of a's shape;
///   contract(a, b)  a := meet(a, b), in place, and the Delta of that change;
///   everything(a)   the Delta that says "any part may have changed".
template <class D>
concept Lattice = std::copyable<D> && DeltaType<typename D::Delta> && requires(D& m, const D& a, const D& b) {
  { meet(a, b) } -> std::convertible_to<D>;
  { join(a, b) } -> std::convertible_to<D>;
  { leq(a, b) } -> std::convertible_to<bool>;
  { a.is_empty() } -> std::convertible_to<bool>;
  { top(a) } -> std::convertible_to<D>;
  { bottom(a) } -> std::convertible_to<D>;
  { contract(m, b) } -> std::convertible_to<typename D::Delta>;
  { everything(a) } -> std::convertible_to<typename D::Delta>;
};

/// The Delta of a domain that moves as one piece: changed or not.
struct ChangedDelta {
  bool changed = false;
  [[nodiscard]] bool is_none() const { return !changed; }
  void join(const ChangedDelta& other) { changed = changed || other.changed; }
};

}  // namespace hcsp
