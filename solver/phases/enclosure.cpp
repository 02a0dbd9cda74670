// SPDX-License-Identifier: Apache-2.0
#include "solver/phases/enclosure.h"

#include "domains/rounding.h"

namespace hcsp {

std::vector<NodeId> expressions_of(const PhaseTubes& tubes, VariableId tube) {
  std::vector<NodeId> roots;
  for (const Expr& duration : tubes.durations()) roots.push_back(duration.node());
  for (std::size_t k = 0; k <= tubes.phases(); ++k) roots.push_back(tubes.gate(k).node());
  for (std::size_t c = 0; c < tubes.dim(tube); ++c) {
    const PhaseFunction& function = tubes.function(tube, c);
    for (const Piece& piece : function.pieces()) {
      for (const Expr& coefficient : piece.polynomial.coefficients) roots.push_back(coefficient.node());
    }
    for (std::size_t k = 0; k <= tubes.phases(); ++k) roots.push_back(function.at_gate(k).node());
  }
  return roots;
}

PolynomialTube unknown_tube(const PhaseTubes& tubes, VariableId tube) {
  const auto unknown = [](std::size_t count) { return std::vector<Interval>(count, Interval::entire()); };
  std::vector<PolynomialTube::Component> components(tubes.dim(tube));
  for (std::size_t c = 0; c < tubes.dim(tube); ++c) {
    for (const Piece& piece : tubes.function(tube, c).pieces())
      components[c].coefficients.push_back(unknown(piece.polynomial.coefficients.size()));
    components[c].gates = unknown(tubes.phases() + 1);
  }
  return {unknown(tubes.phases()), unknown(tubes.phases() + 1), std::move(components)};
}

PolynomialTube TubeEnclosure::on(const std::function<Interval(VariableId)>& value_of) const {
  Evaluation evaluation(program_);
  const RoundUpward guard;
  for (std::uint32_t i = 0; i < program_.inputs().size(); ++i)
    evaluation.set(i, value_of(program_.inputs()[i].variable));
  evaluation.forward();
  PolynomialTube enclosure = unknown_;
  enclosure.assign([&](std::size_t i) { return evaluation.get(program_.root(i)); });
  return enclosure;
}

}  // namespace hcsp
