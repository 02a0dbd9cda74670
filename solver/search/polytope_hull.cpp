// SPDX-License-Identifier: Apache-2.0
#include "solver/search/polytope_hull.h"

#include <algorithm>
#include <cmath>

#include "solver/search/mean_value.h"

namespace hcsp {

bool PolytopeHull::contract(std::vector<Interval>& box) {
  if (!relaxation_.state(box, program_)) return false;
  stated_ = box;
  reached_.assign(2 * box.size(), 0);
  return contract_sides(box);
}

bool PolytopeHull::contract_below(std::vector<Interval>& box, std::uint32_t v) {
  least_at_.clear();
  if (!relaxation_.state(box, program_)) return false;
  stated_ = box;
  reached_.assign(2 * box.size(), 0);
  if (!program_.contract(v, true)) return false;
  note_reached(box.size());
  reached_[2 * v] = 1;
  const auto solution = program_.solution();
  if (solution.size() >= box.size())
    least_at_.assign(solution.begin(), solution.begin() + static_cast<std::ptrdiff_t>(box.size()));
  return take(box);
}

bool PolytopeHull::contract_sides(std::vector<Interval>& box) {
  if (program_.rows() == 0) return true;
  for (std::uint32_t v = 0; v < box.size(); ++v) {
    for (const bool from_below : {true, false}) {
      if (reached_[2 * v + (from_below ? 0 : 1)] != 0 || box[v].is_point()) continue;
      if (!program_.contract(v, from_below)) return false;
      note_reached(box.size());
    }
  }
  return take(box);
}

// Sides at which a solution of the relaxation lies (Baharev, Achterberg and Rev 2009).
void PolytopeHull::note_reached(std::size_t unknowns) {
  constexpr double kNear = 1e-3;
  const auto solution = program_.solution();
  if (solution.size() < unknowns) return;
  for (std::size_t v = 0; v < unknowns; ++v) {
    const double near = kNear * width_of(stated_[v]);
    if (solution[v] <= stated_[v].lo() + near) reached_[2 * v] = 1;
    if (solution[v] >= stated_[v].hi() - near) reached_[2 * v + 1] = 1;
  }
}

bool PolytopeHull::take(std::vector<Interval>& box) {
  for (std::size_t v = 0; v < box.size(); ++v) {
    box[v] = meet(box[v], program_.columns()[v]);
    if (box[v].is_empty()) return false;
  }
  return true;
}

}  // namespace hcsp
