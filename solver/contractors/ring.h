// SPDX-License-Identifier: Apache-2.0
// The Euclidean special case of a zone: norm(a - e) related to r, where e and r do not depend on a. The same
// interval operations as the general path, in the same order, without the bytecode: the results are equal bit
// for bit, which tests check.
#pragma once

#include <array>
#include <optional>

#include "solver/contractors/zone.h"

namespace hcsp {

/// norm(a - e) < r, <= r or == r, recognised in a relation's graph.
struct Ring {
  Op relation;                      ///< less, less_equal or equal
  std::size_t dim;                  ///< axes in the norm
  std::array<std::size_t, 3> axis;  ///< of the bound point, in the order of the sum
  std::array<bool, 3> point_first;  ///< a - e, or e - a
  std::array<NodeId, 3> center;
  NodeId radius;
};

/// The ring that a relation is, if it is one.
std::optional<Ring> match_ring(const Dag& dag, NodeId relation);

/// The discs norm(a - e) < r and norm(a - e) <= r of a box of centers and an interval of radii, as a zone to
/// paint.
class DiscZone {
 public:
  /// center[k] and radius as the program's registers have them at the item; all defined.
  DiscZone(const Grid& grid, const Ring& ring, const std::array<Interval, 3>& center, const Interval& radius,
           Brush brush);

  /// The cells that can be painted with the inner brush: those that a box around the discs' intersection
  /// touches.
  [[nodiscard]] Region inner_bounds() const;
  [[nodiscard]] ChildDecisions decide_children(const CellIndex& origin, std::int64_t child_edge,
                                               std::uint64_t open) const;

 private:
  struct Distances;
  void measure_children(std::size_t k, const CellIndex& origin, std::int64_t child_edge,
                        Distances& distances) const;
  [[nodiscard]] ChildDecisions decide_plane(const std::array<Distances, 3>& distances, bool asks_some) const;
  [[nodiscard]] ChildDecisions decide_space(const std::array<Distances, 3>& distances, bool asks_some) const;

  const Grid& grid_;
  const Ring& ring_;
  std::array<Interval, 3> center_;
  Interval radius_;
  Brush brush_;
  double all_up_to_;  // a block lies in the disc when its greatest squared distance is at most this
  double none_from_;  // and outside when its least squared distance is at least this
};

}  // namespace hcsp
