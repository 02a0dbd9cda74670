// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/refinement.h"

#include <algorithm>

#include "domains/set_descent.h"
#include "domains/set_interval.h"
#include "solver/engine/propagation.h"

namespace hcsp {

namespace {

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a / b - (a % b < 0 ? 1 : 0); }

// From the cells of one grid to those of the other that they touch.
struct Scale {
  std::int64_t up;    // cells of the other grid along an edge of a cell of this one,
  std::int64_t down;  // or cells of this one along an edge of a cell of the other

  [[nodiscard]] Region operator()(const Region& cells, std::size_t dim) const {
    Region touched;
    for (std::size_t k = 0; k < dim; ++k) {
      touched.lo[k] = floor_div(cells.lo[k] * up, down);
      touched.hi[k] = floor_div(cells.hi[k] * up - 1, down) + 1;
    }
    return touched;
  }
};

// Excludes the cells that touch no cell of A+, the upper bound of a set on another grid.
class Untouched {
 public:
  Untouched(const SetInterval& other, Scale to_other) : other_(other), to_other_(to_other) {}

  [[nodiscard]] Decision decide(const Region& cells) const {
    const std::size_t dim = other_.dim();
    const Region touched = to_other_(cells, dim);
    const SetInterval::Block root = other_.root();
    bool any = false, all = true;
    if (!Region::block(root.lo, root.edge, dim).holds(touched, dim)) {
      any = other_.background() != CellState::outside;
      all = any;
    }
    look(root, touched, any, all);
    if (!any) return Decision::all;
    return all ? Decision::none : Decision::split;
  }

 private:
  void look(const SetInterval::Block& block, const Region& cells, bool& any, bool& all) const {
    const Region extent = Region::block(block.lo, block.edge, other_.dim());
    if (!cells.meets(extent, other_.dim()) || (any && !all)) return;
    if (block.all_upper) {
      any = true;
    } else if (!block.any_upper) {
      all = false;
    } else if (block.edge > 1) {
      for (int corner = 0; corner < (1 << other_.dim()); ++corner)
        look(other_.part(block, corner), cells, any, all);
    }
  }

  const SetInterval& other_;
  Scale to_other_;
};

// The upper bound of a set on the grid of another.
SetInterval upper_bound_on(const SetInterval& set, Scale from_set, const SetInterval& grid, Scale to_set) {
  SetInterval bound(grid.dim(), grid.precision());
  bound.cover(from_set(set.reach(), set.dim()));
  Untouched zone(set, to_set);
  bound.exclude(bound.reach(), zone);
  if (set.background() == CellState::outside) bound.exclude_background();
  return bound;
}

class RefinementContractor final : public Contractor {
 public:
  RefinementContractor(const std::string& name, VariableId fine, VariableId coarse, int ratio)
      : Contractor(name, name, Cost::linear, {fine, coarse}, {fine, coarse}),
        fine_(fine),
        coarse_(coarse),
        refine_{ratio, 1},
        coarsen_{1, ratio} {}

  void contract(Access& access) override {
    if (narrow(access, fine_, coarsen_, coarse_, refine_)) narrow(access, coarse_, refine_, fine_, coarsen_);
  }

 private:
  // The upper bound of the source bounds the target; and the same of the complements, for the lower bounds.
  static bool narrow(Access& access, VariableId target, Scale to_source, VariableId source, Scale to_target) {
    auto& set = access.edit<SetInterval>(target);
    const auto& from = access.domain<SetInterval>(source);
    access.report<SetInterval>(target, hcsp::contract(set, upper_bound_on(from, to_target, set, to_source)));
    if (set.is_empty()) return false;
    const SetInterval outer = upper_bound_on(set_complement(from), to_target, set, to_source);
    access.report<SetInterval>(target, hcsp::contract(set, set_complement(outer)));
    return !set.is_empty();
  }

  VariableId fine_, coarse_;
  Scale refine_, coarsen_;
};

}  // namespace

std::unique_ptr<Contractor> make_refinement_contractor(std::string name, VariableId fine, VariableId coarse,
                                                       int ratio) {
  return std::make_unique<RefinementContractor>(name, fine, coarse, ratio);
}

}  // namespace hcsp
