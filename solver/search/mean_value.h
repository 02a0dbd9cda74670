// SPDX-License-Identifier: Apache-2.0
// The equations of a system in mean value form over a box (Moore 1966): for every x of the box, f(x) lies in
// f(c) + F'(box) (x - c), c the box's centre. Elimination and Newton combine the rows, each in its way.
#pragma once

#include <span>
#include <vector>

#include "solver/search/system.h"

namespace hcsp {

inline double middle_of(const Interval& x) { return 0.5 * x.lo() + 0.5 * x.hi(); }
inline double width_of(const Interval& x) { return x.hi() - x.lo(); }
/// Whether doubles hold the widths of all sides.
inline bool is_bounded(const std::vector<Interval>& box) {
  for (const Interval& x : box) {
    if (!(width_of(x) < kInfinity)) return false;
  }
  return true;
}

/// PRECONDITION of all that compute: the thread rounds upward. Equations count from 0; their number among the
/// relations is nobody else's business.
class MeanValueForms {
 public:
  explicit MeanValueForms(const System& system);

  [[nodiscard]] std::size_t size() const { return equations_.size(); }
  /// The unknowns of an equation.
  [[nodiscard]] std::span<const std::uint32_t> unknowns(std::size_t e) const {
    return system_.tape->variables(equations_[e]);
  }

  /// Expands the gradients over a box; told of the same one again, they are there.
  void expand_over(const std::vector<Interval>& box);
  /// Expands slopes over a bounded box from its centre, where the equations are evaluated too. They are
  /// narrower than gradients, and tell as much of where solutions can be, but not that one is alone.
  void expand_from_center(const std::vector<Interval>& box);
  /// Whether the form holds of an equation over the box of the last expansion.
  [[nodiscard]] bool has_form(std::size_t e) const { return has_form_[e] != 0; }
  /// By unknown; 0 for those that the equation does not depend on. What is nowhere defined, like the slope of
  /// a root at 0, is empty.
  [[nodiscard]] const std::vector<Interval>& slopes(std::size_t e) const { return slopes_[e]; }

  /// Evaluates the equations at the centre of the box of the last expansion.
  void evaluate_at_center();
  [[nodiscard]] const Interval& center(std::size_t v) const { return center_[v]; }

  /// The sum of equations that have a form, each times a factor.
  struct Form {
    Interval value;                ///< at the centre
    std::vector<Interval> slopes;  ///< by unknown
  };
  const Form& combine(std::span<const std::uint32_t> equations, std::span<const double> factors);

  /// How much the equations vary over a box with each unknown: of what each equation varies, the unknown's
  /// share, summed over the equations (Trombettoni et al. 2011, smearSumRel).
  const std::vector<double>& smear(const std::vector<Interval>& box);
  /// The most that one equation varies with each unknown (Kearfott 1996, maximal smear).
  const std::vector<double>& smear_max(const std::vector<Interval>& box);

 private:
  void find_center(const std::vector<Interval>& box);
  void see_whether_form_holds(std::size_t e);
  [[nodiscard]] double variation(std::size_t e, std::uint32_t v) const;

  const System& system_;
  std::vector<std::uint32_t> equations_;  // among the relations
  TapeRun run_;
  std::vector<Interval> box_;  // of the gradients that are there, if any
  std::vector<Interval> center_, values_;
  std::vector<std::vector<Interval>> slopes_;
  std::vector<std::uint8_t> has_form_;
  Form combined_;
  std::vector<double> smear_;
};

}  // namespace hcsp
