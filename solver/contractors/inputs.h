// SPDX-License-Identifier: Apache-2.0
// Joins the inputs of a program to the domains of a run: loads them for an item of the time line, stores back
// what the program contracted, and keeps the Deltas that this caused.
#pragma once

#include <memory>
#include <set>
#include <vector>

#include "domains/tube.h"
#include "solver/contractors/motion.h"
#include "solver/engine/propagation.h"
#include "solver/expression/program.h"

namespace hcsp {

class Inputs {
 public:
  /// What a program's inputs need to know of the problem that they stand in.
  struct Context {
    std::shared_ptr<const TimeLine> line;                 ///< null when the problem has no time
    std::shared_ptr<const std::set<VariableId>> sampled;  ///< the tubes that are known at their readings only
    std::shared_ptr<Motions> motions;                     ///< of the tubes; may still grow
    std::shared_ptr<const ItemSet> window = {};           ///< the items that are at hand; null for all
  };
  Inputs(const Program& program, Context context);

  /// The distinct variables among the inputs.
  [[nodiscard]] const std::vector<VariableId>& variables() const { return variables_; }
  /// Whether the program's value depends on the time at hand. An untimed program has the one item 0.
  [[nodiscard]] bool timed() const { return timed_; }
  [[nodiscard]] std::size_t items() const { return timed_ ? context_.line->items() : 1; }
  /// The inputs that can be contracted: all but the time and the bound point.
  [[nodiscard]] const std::vector<std::uint32_t>& contractible() const { return contractible_; }
  /// The inputs of the bound point, by axis; kNone for an axis that the program does not use.
  [[nodiscard]] const std::vector<std::uint32_t>& point() const { return point_; }
  static constexpr std::uint32_t kNone = 0xffffffffU;

  /// Looks the domains up; to be called first in every run of the contractor.
  void open(Access& access);
  /// The items at hand: those of the window, or all. An untimed program has no time to be outside.
  [[nodiscard]] ItemSet in_window() const;
  /// Those of them at which an input may have changed since the last run.
  [[nodiscard]] ItemSet changed(const Access& access) const;
  [[nodiscard]] Interval value(std::uint32_t input, std::size_t item) const;
  /// Whether a sampled tube has no reading, and no other bound, at an item: there set contractors learn
  /// nothing.
  [[nodiscard]] bool no_reading_at(std::size_t item) const;
  void load(Evaluation& evaluation, std::size_t item, std::size_t lane = 0) const;
  /// Meets the domain of one input at an item with a bound; false when that empties it.
  bool narrow(std::uint32_t input, std::size_t item, const Interval& bound);
  enum class Direction : std::uint8_t { forward, backward };
  /// Narrows the tubes at a gate by what their motions make of them at the gate before, in a sweep forward,
  /// or after. Tells whether that changed any.
  bool carry(std::size_t item, Direction sweep);
  /// narrow() for every contractible input of a lane.
  bool store(const Evaluation& evaluation, std::size_t item, std::size_t lane = 0);
  /// Reports what narrow() changed since open(); a failure names the item where a domain became empty.
  void report(Access& access);
  /// The time that a failure at an item has, for reports; none when the program speaks of no one time.
  [[nodiscard]] std::optional<std::array<double, 2>> when(std::size_t item) const;
  /// The variable to blame when the constraint has no solution at an item.
  [[nodiscard]] VariableId blamed() const { return variables_.front(); }

 private:
  [[nodiscard]] std::array<double, 2> span_of(std::size_t item) const;

  struct Place {  // of one variable
    Input::Kind kind = Input::Kind::real;
    Interval* real = nullptr;
    Tube* tube = nullptr;
    bool changed = false;  // a real
    ItemSet items;         // of a tube
    std::optional<std::size_t> emptied_at;
  };
  [[nodiscard]] std::size_t item_of(const Input& input, std::size_t item) const {
    return input.kind == Input::Kind::gate ? 2 * static_cast<std::size_t>(input.gate) : item;
  }

  std::vector<Input> inputs_;
  Context context_;
  std::vector<VariableId> variables_;
  std::vector<std::size_t> place_of_;  // by input: its variable's place
  std::vector<Place> places_;          // by variable
  std::vector<std::uint32_t> contractible_, point_;
  bool timed_ = false;
};

}  // namespace hcsp
