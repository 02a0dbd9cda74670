// SPDX-License-Identifier: Apache-2.0
#include "lang/tool/summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "solver/report/text.h"

namespace hcsp::tool {

namespace {

using report::for_people;

// The widths of a tube's items of one sort, a vector's widest component each.
struct Widths {
  std::size_t count = 0;
  std::size_t unbounded = 0;
  double sum = 0.0;
  double largest = 0.0;

  void add(double width) {
    ++count;
    if (!std::isfinite(width)) {
      ++unbounded;
      return;
    }
    sum += width;
    largest = std::max(largest, width);
  }
  [[nodiscard]] std::string text(std::string_view sort) const {
    if (unbounded == count) return fmt::format("{} unbounded", sort);
    const double mean = sum / static_cast<double>(count - unbounded);
    std::string text = fmt::format("{} mean width {}, max {}", sort, for_people(mean), for_people(largest));
    if (unbounded > 0) text += fmt::format(" ({} of {} unbounded)", unbounded, count);
    return text;
  }
};

std::string line(const Tube& tube) {
  Widths slices;
  Widths gates;
  for (std::size_t item = 0; item < tube.items(); ++item) {
    double width = 0.0;
    for (std::size_t c = 0; c < tube.dim(); ++c) width = std::max(width, tube.at(c, item).width());
    (item % 2 == 0 ? gates : slices).add(width);
  }
  return fmt::format("{}; {}", slices.text("slices"), gates.text("gates"));
}

std::string line(const PolynomialTube& tube) {
  Widths gates;
  for (std::size_t gate = 0; gate <= tube.phases(); ++gate) {
    double width = 0.0;
    for (std::size_t c = 0; c < tube.dim(); ++c) width = std::max(width, tube.gate(c, gate).width());
    gates.add(width);
  }
  return fmt::format("degree {} on {} phases; {}", tube.degree(), tube.phases(), gates.text("gates"));
}

std::string bound(double value) {
  if (std::isinf(value)) return value > 0 ? "oo" : "-oo";
  return fmt::format("{}", value + 0.0);  // no -0
}
std::string line(const Interval& interval) {
  return fmt::format("[{}, {}]", bound(interval.lo()), bound(interval.hi()));
}
std::string line(const Box& box) {
  constexpr Eigen::Index kShown = 12;
  std::string text;
  for (Eigen::Index i = 0; i < std::min(box.dim(), kShown); ++i) text += (i == 0 ? "(" : ", ") + line(box[i]);
  if (box.dim() > kShown) text += fmt::format(", ... {} components", box.dim());
  return text + ")";
}
std::string truth(const Interval& value) {
  if (value.is_point()) return value.lo() == 0 ? "false" : "true";
  return "true or false";
}
std::string matrix(const Box& box, std::size_t columns) {
  std::string text;
  for (Eigen::Index first = 0; first < box.dim(); first += static_cast<Eigen::Index>(columns)) {
    Box row(static_cast<Eigen::Index>(columns));
    for (Eigen::Index i = 0; i < row.dim(); ++i) row[i] = box[first + i];
    text += (first == 0 ? "(" : ", ") + line(row);
  }
  return text + ")";
}
std::string line(const SetInterval& set) {
  const double upper = set.upper_volume();
  return fmt::format("volume in [{}, {}]", for_people(set.lower_volume()),
                     std::isinf(upper) ? "oo" : for_people(upper));
}

void explain(const Explanation& why, std::string& text) {
  text += why.variable.empty()
              ? fmt::format("no solution: refuted by `{}`", why.constraint)
              : fmt::format("no solution: `{}` leaves nothing of `{}`", why.constraint, why.variable);
  if (why.time) {
    const auto [from, to] = *why.time;
    text += from == to ? fmt::format(" at t = {}", from) : fmt::format(" for t in [{}, {}]", from, to);
  }
  text += '\n';
  if (why.support.empty()) return;
  constexpr std::size_t kShown = 5;
  text += fmt::format("jointly inconsistent{}: {} reading{}\n",
                      why.support_is_complete ? "" : " (stopped before the smallest was found)",
                      why.support.size(), why.support.size() == 1 ? "" : "s");
  for (std::size_t i = 0; i < std::min(why.support.size(), kShown); ++i) {
    const SupportingReading& reading = why.support[i];
    text += fmt::format("  {}({}){}{}\n", reading.variable, reading.time, reading.source.empty() ? "" : "  ",
                        reading.source);
  }
  if (why.support.size() > kShown) text += fmt::format("  and {} more\n", why.support.size() - kShown);
}

std::string line(const ResultVariable& variable) {
  if (variable.is_empty()) return "empty";
  const auto* real = std::get_if<Interval>(&variable.domain);
  if (real != nullptr && variable.shape.scalar == Shape::Scalar::boolean) return truth(*real);
  const auto* box = std::get_if<Box>(&variable.domain);
  if (box != nullptr && variable.shape.columns != 0) return matrix(*box, variable.shape.columns);
  return std::visit([](const auto& domain) { return line(domain); }, variable.domain);
}

void list(const std::vector<ResultVariable>& variables, const std::vector<std::string>& shown,
          std::string& text) {
  const std::vector<const ResultVariable*> listed = select(variables, shown);
  std::size_t longest = 0;
  for (const ResultVariable* variable : listed) longest = std::max(longest, variable->name.size());
  for (const ResultVariable* variable : listed)
    text += fmt::format("  {:<{}}  {}\n", variable->name, longest, line(*variable));
}

// Each certificate with how many boxes have it.
std::string certificates(const SolutionSet& search) {
  std::string text;
  for (const Certificate certificate :
       {Certificate::unique, Certificate::exists, Certificate::inner, Certificate::none}) {
    const auto count =
        std::count_if(search.solutions.begin(), search.solutions.end(),
                      [&](const Solution& solution) { return solution.certificate == certificate; });
    if (count == 0) continue;
    const bool is_none = certificate == Certificate::none;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count,
                        is_none ? "not proven" : to_string(certificate));
  }
  return text;
}

std::string summary_of_search(const Result& result, const std::vector<std::string>& shown) {
  constexpr std::size_t kShown = 20;
  const SolutionSet& search = *result.search;
  const std::size_t boxes = search.solutions.size();
  std::string text = fmt::format("{}: {} in {:.4g} s, {} cell{}\n", result.model, to_string(result.status),
                                 result.statistics.seconds, search.cells, search.cells == 1 ? "" : "s");
  if (result.objective && !result.objective->is_empty())
    text += fmt::format("objective in {}\n", line(*result.objective));
  if (boxes == 0) {
    if (result.explanation)
      explain(*result.explanation, text);
    else if (result.status == Status::infeasible)
      text += "no solution: proven\n";
    return text;
  }
  text += fmt::format("{} box{}: {}\n", boxes, boxes == 1 ? "" : "es", certificates(search));
  for (std::size_t i = 0; i < std::min(boxes, kShown); ++i) {
    const Solution& solution = search.solutions[i];
    text += fmt::format("{} ({}{}{})\n", i + 1, to_string(solution.certificate),
                        solution.reason == Reason::proven ? "" : ": ", to_string(solution.reason));
    list(solution.variables, shown, text);
  }
  if (boxes > kShown) text += fmt::format("and {} more\n", boxes - kShown);
  return text;
}

std::string summary_of_paving(const Result& result, const std::vector<std::string>& shown) {
  const Paving& paving = *result.paving;
  const auto count = [&](const std::vector<Interval>& boxes) { return boxes.size() / paving.names.size(); };
  std::string text = fmt::format("{}: {} in {:.4g} s, {} cell{}\n", result.model, to_string(result.status),
                                 result.statistics.seconds, paving.cells, paving.cells == 1 ? "" : "s");
  text += fmt::format("boxes of ({}): {} inside, {} boundary, {} outside\n", fmt::join(paving.names, ", "),
                      count(paving.inside), count(paving.boundary), count(paving.outside));
  text += fmt::format("volume: at least {:.6g} inside, at most {:.6g} boundary\n", paving.inside_volume,
                      paving.boundary_volume);
  if (!paving.unexplored.empty()) text += fmt::format("unexplored: {} boxes\n", count(paving.unexplored));
  if (result.status == Status::infeasible) return text + "no solution: proven\n";
  list(result.variables, shown, text);
  return text;
}

}  // namespace

std::string summary(const Result& result, const std::vector<std::string>& shown) {
  if (result.search) {
    const std::size_t left = result.search->unexplored.size();
    return summary_of_search(result, shown) + (left == 0 ? "" : fmt::format("unexplored: {} boxes\n", left));
  }
  if (result.paving) return summary_of_paving(result, shown);
  std::string text = fmt::format("{}: {} in {:.4g} s, {} pass{}\n", result.model, to_string(result.status),
                                 result.statistics.seconds, result.statistics.passes,
                                 result.statistics.passes == 1 ? "" : "es");
  if (result.explanation) explain(*result.explanation, text);
  if (result.status == Status::infeasible) return text;
  list(result.variables, shown, text);
  return text;
}

}  // namespace hcsp::tool
