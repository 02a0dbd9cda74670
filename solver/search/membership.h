// SPDX-License-Identifier: Apache-2.0
// Whether all points of a box belong to a set, or none. Quantifiers over reals are decided by parts of the
// domains that they bind: "for some" by one part where the relation holds throughout, by a point, or by an
// equation's solution that interval Newton proves; "for every" by all parts.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/search/point_set.h"

namespace hcsp {

/// yes: every point belongs, for all values that the literals of the model enclose; no: none does.
enum class Verdict : std::uint8_t { no, open, yes };
inline Verdict opposite(Verdict verdict) {
  return static_cast<Verdict>(static_cast<int>(Verdict::yes) - static_cast<int>(verdict));
}

class Membership {
 public:
  /// Which boxes of a set's unknowns, one after another, a relation holds for.
  class Part {
   public:
    Part() = default;
    Part(const Part&) = delete;
    Part& operator=(const Part&) = delete;
    virtual ~Part() = default;
    virtual void decide(std::span<const Interval> boxes, std::span<Verdict> verdicts) = 0;
  };

  explicit Membership(const PointSet& set);

  /// Of boxes of the coordinates, one after another. PRECONDITION: the thread rounds upward.
  void decide(std::span<const Interval> boxes, std::vector<Verdict>& verdicts);

 private:
  const PointSet& set_;
  std::unique_ptr<Part> whole_;
  std::vector<Interval> extended_;  // the boxes with what is bound
};

/// The parts of a relation, which quantifiers around it bind some unknowns of: `outer` are the others.
std::unique_ptr<Membership::Part> make_part(const PointSet& set, NodeId relation,
                                            const std::vector<std::uint32_t>& outer);

/// A quantifier and those of its kind directly below it.
std::unique_ptr<Membership::Part> make_quantified(const PointSet& set, NodeId quantifier,
                                                  const std::vector<std::uint32_t>& outer);

}  // namespace hcsp
