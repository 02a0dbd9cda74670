// SPDX-License-Identifier: Apache-2.0
#include "solver/report/drawn.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "solver/report/segments.h"

namespace hcsp::report {

namespace {

// Evenly over the time that the tubes may last, and at the gates.
std::shared_ptr<const TimeLine> line_of(const std::vector<ResultVariable>& variables) {
  constexpr int kSlices = 1000;
  double end = 0.0;
  std::set<double> gates;
  for (const ResultVariable& variable : variables) {
    const auto* tube = std::get_if<PolynomialTube>(&variable.domain);
    if (tube == nullptr || tube->is_empty()) continue;
    const Interval last = tube->instant(tube->phases());
    end = std::max(end, std::isfinite(last.hi()) ? last.hi() : last.lo());
    for (std::size_t k = 0; k <= tube->phases(); ++k) gates.insert(tube->instant(k).mid());
  }
  if (!(end > 0.0)) end = 1.0;
  std::set<double> instants{0.0, end};
  for (int k = 1; k < kSlices; ++k) instants.insert(end * k / kSlices);
  for (const double gate : gates) {
    if (gate > 0.0 && gate < end) instants.insert(gate);
  }
  return std::make_shared<const TimeLine>(std::vector<double>(instants.begin(), instants.end()));
}

Tube tube_on(const std::shared_ptr<const TimeLine>& line, const PolynomialTube& tube) {
  Tube drawn(line, tube.dim());
  if (tube.is_empty()) return bottom(drawn);
  for (std::size_t item = 0; item < drawn.items(); ++item) {
    for (std::size_t c = 0; c < tube.dim(); ++c) {
      const Interval values = tube.at(c, line->span(item));
      if (!values.is_empty()) drawn.set(c, item, values);  // after the end: nothing is known
    }
  }
  return drawn;
}

void draw(std::vector<ResultVariable>& variables) {
  const std::shared_ptr<const TimeLine> line = line_of(variables);
  for (ResultVariable& variable : variables) {
    const auto* tube = std::get_if<PolynomialTube>(&variable.domain);
    if (tube == nullptr) continue;
    variable.shape.is_drawn = true;
    variable.shape.degree = tube->degree();
    variable.domain = tube_on(line, *tube);
  }
}

}  // namespace

std::optional<Result> drawn(const Result& result) {
  if (!has_segments(result)) return {};
  Result pictured = result;
  pictured.variables = told_variables(result);
  draw(pictured.variables);
  for (PassSnapshot& snapshot : pictured.snapshots) draw(snapshot.variables);
  return pictured;
}

}  // namespace hcsp::report
