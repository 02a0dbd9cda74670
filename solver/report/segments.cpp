// SPDX-License-Identifier: Apache-2.0
#include "solver/report/segments.h"

#include <algorithm>

namespace hcsp::report {

namespace {

struct Motion {
  std::string name;
  const PolynomialTube* tube;
};

// The tubes that have the most components: a component is a joint.
std::vector<Motion> motions_of(const Result& result) {
  std::vector<Motion> all;
  std::size_t joints = 0;
  for (const ResultVariable& variable : told_variables(result)) {
    const auto* tube = std::get_if<PolynomialTube>(&variable.domain);
    if (tube == nullptr || tube->is_empty()) continue;
    all.push_back({variable.name, tube});
    joints = std::max(joints, tube->dim());
  }
  std::erase_if(all, [&](const Motion& motion) { return motion.tube->dim() < joints; });
  return all;
}

// Those of powers of s; the tube has those of s^k/k!.
std::vector<Interval> powers(std::span<const Interval> coefficients) {
  std::vector<Interval> all;
  double factorial = 1.0;
  for (std::size_t k = 0; k < coefficients.size(); ++k) {
    if (k > 0) factorial *= static_cast<double>(k);
    all.push_back(coefficients[k] / Interval(factorial));
  }
  return all;
}

void put_bounds(TextBuffer& out, const std::vector<Interval>& all) {
  for (const bool is_lower : {true, false}) {
    put(out, is_lower ? R"({ "lo": [)" : R"(], "hi": [)");
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i != 0) put(out, ',');
      put_json_number(out, is_lower ? all[i].lo() : all[i].hi());
    }
  }
  put(out, "] }");
}

void put_segment(TextBuffer& out, const std::vector<Motion>& motions, std::size_t segment,
                 std::size_t joint) {
  const PolynomialTube& first = *motions.front().tube;
  const Interval &start = first.instant(segment), &end = first.instant(segment + 1);
  fmt::format_to(fmt::appender(out), "\n  {{ \"segment\": {}, \"joint\": {}, \"interval\": [", segment + 1,
                 joint + 1);
  put_json_number(out, start.mid());
  put(out, ',');
  put_json_number(out, end.mid());
  put(out, "], \"enclosure\": ");
  put_bounds(out, {start, end});
  put(out, ",\n    \"coefficients\": {");
  for (const Motion& motion : motions) {
    put(out, &motion == &motions.front() ? "\n      " : ",\n      ");
    put_json_string(out, motion.name);
    put(out, ": ");
    put_bounds(out, powers(motion.tube->coefficients(joint, segment)));
  }
  put(out, " } }");
}

// Which columns of the table a tube has.
std::size_t columns_of(const Motion& motion) { return motion.tube->degree() + 1; }

// The numbers of a row, each known within an interval.
std::vector<Interval> row_of(const std::vector<Motion>& motions, std::size_t segment, std::size_t joint) {
  const PolynomialTube& first = *motions.front().tube;
  std::vector<Interval> row{first.instant(segment), first.instant(segment + 1)};
  for (const Motion& motion : motions) {
    std::vector<Interval> coefficients = powers(motion.tube->coefficients(joint, segment));
    coefficients.resize(columns_of(motion), Interval(0.0));
    row.insert(row.end(), coefficients.begin(), coefficients.end());
  }
  return row;
}

}  // namespace

bool has_segments(const Result& result) {
  return std::any_of(result.variables.begin(), result.variables.end(), [](const ResultVariable& variable) {
    return std::holds_alternative<PolynomialTube>(variable.domain);
  });
}

void put_segments(TextBuffer& out, const Result& result) {
  const std::vector<Motion> motions = motions_of(result);
  put(out, '[');
  if (!motions.empty()) {
    const PolynomialTube& first = *motions.front().tube;
    for (std::size_t segment = 0; segment < first.phases(); ++segment) {
      for (std::size_t joint = 0; joint < first.dim(); ++joint) {
        if (segment + joint != 0) put(out, ',');
        put_segment(out, motions, segment, joint);
      }
    }
  }
  put(out, ']');
}

std::string segments_csv(const Result& result) {
  const std::vector<Motion> motions = motions_of(result);
  std::vector<std::string> names{"start", "end"};
  for (const Motion& motion : motions) {
    for (std::size_t k = 0; k < columns_of(motion); ++k) names.push_back(fmt::format("{}{}", motion.name, k));
  }
  TextBuffer out;
  put(out, "segment,joint");
  for (const std::string& name : names) fmt::format_to(fmt::appender(out), ",{}", name);
  for (const std::string& name : names) fmt::format_to(fmt::appender(out), ",{}.lo,{}.hi", name, name);
  put(out, '\n');
  if (motions.empty()) return to_text(out);
  NumberTexts texts;
  const auto put_cell = [&](double value) {
    put(out, ',');
    put(out, texts.of(value + 0.0));  // -0 is 0
  };
  const PolynomialTube& first = *motions.front().tube;
  for (std::size_t segment = 0; segment < first.phases(); ++segment) {
    for (std::size_t joint = 0; joint < first.dim(); ++joint) {
      const std::vector<Interval> row = row_of(motions, segment, joint);
      fmt::format_to(fmt::appender(out), "{},{}", segment + 1, joint + 1);
      for (const Interval& x : row) put_cell(x.mid());
      for (const Interval& x : row) {
        put_cell(x.lo());
        put_cell(x.hi());
      }
      put(out, '\n');
    }
  }
  return to_text(out);
}

}  // namespace hcsp::report
