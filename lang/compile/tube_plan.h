// SPDX-License-Identifier: Apache-2.0
// What a model gives for a tube: rows of data that hold or are sampled, and constant domains, component by
// component. A plan is made before the time line, which its stamps become part of; the tube is built on the
// line after.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "domains/tube.h"
#include "lang/evaluate/evaluator.h"

namespace hcsp::lang {

/// Neighbouring components of a tube that come from one source.
struct TubePart {
  enum class Kind : std::uint8_t { constant, hold, sampled };
  Kind kind = Kind::constant;
  std::vector<Interval> domain;  ///< of a constant: a component each
  SourceRange range;             ///< the call of hold or sampled
  std::vector<double> stamps;
  std::vector<Column> columns;                       ///< a component each
  std::vector<std::variant<Number, Column>> errors;  ///< none, or a component each: `+-`
  std::optional<Number> max_range;

  [[nodiscard]] std::size_t dim() const { return kind == Kind::constant ? domain.size() : columns.size(); }
};

using TubePlan = std::vector<TubePart>;

/// None after a report.
std::optional<TubePlan> plan_tube(Model& model, Evaluator& evaluator, const Expr& expr);

struct GivenTube {
  Tube domain;
  std::vector<Reading> readings;  ///< in the order of time
};

/// The tube of a plan on the time line. None after a report.
std::optional<GivenTube> build_tube(Model& model, const TubePlan& plan,
                                    const std::shared_ptr<const TimeLine>& line);

}  // namespace hcsp::lang
