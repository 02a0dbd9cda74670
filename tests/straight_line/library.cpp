// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/library.h"

#include <algorithm>

namespace hcsp::straight_line {

namespace {

CompiledProblem compiled_model(int type, std::size_t joints) {
  lang::CompileOptions options;
  options.parameters = {{"K", std::to_string(joints)}, {"p1", "zeros(K)"}};
  for (const std::string& name : limits_of(type))
    options.parameters[name] = name.ends_with("max") ? "(1 | k in 1..K)" : "(-1 | k in 1..K)";
  return compile(HCSP_SOURCE_DIR "/models/straight_line/type" + std::to_string(type) + ".hcsp", options);
}

Span span_of(const Interval& x) { return {x.lo(), x.hi()}; }

}  // namespace

Library::Library(int type, std::size_t joints)
    : type_(type), joints_(joints), problem_(compiled_model(type, joints)) {}

Answer Library::solve(const Move& move) {
  std::vector<std::string> names = vectors_of(type_);
  const std::vector<std::string> limits = limits_of(type_);
  names.insert(names.end(), limits.begin(), limits.end());
  for (const std::string& name : names) problem_.set(problem_.parameter(name), *move.parameter(name));
  problem_.set(problem_.parameter("line"), move.line.empty() ? Vector(joints_, 0) : move.line);
  problem_.set(problem_.parameter("tol"), move.tol);
  problem_.solve();
  Answer answer;
  answer.status = to_string(problem_.status());
  answer.reason = problem_.reason();
  answer.bracket = span_of(problem_.objective());
  if (!problem_.has_solution()) return answer;
  read(answer);
  reference_ = reference_of(answer);
  return answer;
}

Span Library::span(const char* name) const { return span_of(problem_.value(problem_.variable(name))[0]); }

void Library::read(Answer& answer) const {
  answer.T = span("T");
  for (const Interval& rho : problem_.value(problem_.variable("rho"))) answer.rho.push_back(span_of(rho));
  std::vector<const PolynomialTube*> tubes;
  for (const char* name : {"p", "v", "a", "j"}) {
    if (type_ >= 3 || *name != 'j') tubes.push_back(&problem_.value(problem_.tube(name)));
  }
  for (std::size_t i = 0; i < tubes[0]->phases(); ++i) {
    Segment& segment = answer.segments.emplace_back(Segment{span_of(tubes[0]->duration(i)), {}});
    for (std::size_t k = 0; k < joints_; ++k) {
      auto& spans = segment.joints.emplace_back();
      for (std::size_t order = 0; order < tubes.size(); ++order)
        spans[order] = span_of(tubes[order]->coefficients(k, i)[0]);
      const std::span<const Interval> last = tubes.back()->coefficients(k, i);
      if (last.size() > 1) spans[tubes.size()] = span_of(last[1]);
    }
  }
  answer.braking = type_ <= 2 ? 1 : type_ <= 5 ? 3 : 6;
}

double Library::value_at(const char* name, std::size_t joint, double time) const {
  const PolynomialTube& tube = problem_.value(problem_.tube(name));
  return tube.at(joint, Interval(std::min(time, tube.instant(tube.phases()).lo()))).mid();
}

State Library::state_at(double time) const {
  const double start = problem_.value(problem_.tube("p")).gate(reference_, 0).mid();
  return {Number(value_at("p", reference_, time)) - start, value_at("v", reference_, time),
          type_ >= 3 ? value_at("a", reference_, time) : 0};
}

double Library::jerk_at(double time) const { return value_at("j", reference_, time); }

Vector Library::positions_at(double time) const {
  Vector positions;
  for (std::size_t k = 0; k < joints_; ++k) positions.push_back(value_at("p", k, time));
  return positions;
}

}  // namespace hcsp::straight_line
