// SPDX-License-Identifier: Apache-2.0
// Boxes: vectors of intervals, the domain of a vector unknown. Contiguous, so that a copy is one flat copy.
#pragma once

#include <Eigen/Core>
#include <initializer_list>

#include "domains/interval/interval.h"

namespace Eigen {
template <>
struct NumTraits<hcsp::Interval> : GenericNumTraits<hcsp::Interval> {
  using Real = hcsp::Interval;
  using NonInteger = hcsp::Interval;
  using Nested = hcsp::Interval;
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = 2,
    AddCost = 2,
    MulCost = 8
  };
};
}  // namespace Eigen

namespace hcsp {

/// A matrix of intervals, rows by columns; arithmetic is Eigen's over interval operations, each sound.
using IntervalMatrix = Eigen::Matrix<Interval, Eigen::Dynamic, Eigen::Dynamic>;
using IntervalVector = Eigen::Matrix<Interval, Eigen::Dynamic, 1>;

/// A product of intervals. One empty component makes the whole box the one empty box of its dimension.
class Box {
 public:
  using Delta = ChangedDelta;

  /// R^dim.
  explicit Box(Eigen::Index dim = 0) : components_(IntervalVector::Constant(dim, Interval::entire())) {}
  Box(std::initializer_list<Interval> components);
  explicit Box(IntervalVector components) : components_(std::move(components)) {}

  [[nodiscard]] Eigen::Index dim() const { return components_.size(); }
  [[nodiscard]] const Interval& operator[](Eigen::Index i) const { return components_[i]; }
  [[nodiscard]] Interval& operator[](Eigen::Index i) { return components_[i]; }
  [[nodiscard]] const IntervalVector& components() const { return components_; }
  [[nodiscard]] bool is_empty() const;

 private:
  IntervalVector components_;
};

// Shapes must agree: std::invalid_argument otherwise.
Box meet(const Box& a, const Box& b);
Box join(const Box& a, const Box& b);
bool leq(const Box& a, const Box& b);
bool operator==(const Box& a, const Box& b);
Box top(const Box& a);
Box bottom(const Box& a);
Box::Delta contract(Box& a, const Box& b);
inline Box::Delta everything(const Box&) { return {true}; }
/// The largest width of a component.
double measure(const Box& a);
std::string to_string(const Box& a);

static_assert(Lattice<Box>);

}  // namespace hcsp
