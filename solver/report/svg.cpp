// SPDX-License-Identifier: Apache-2.0
#include "solver/report/svg.h"

#include <algorithm>

#include "solver/report/drawn.h"
#include "solver/report/page_data.h"
#include "solver/report/paving_map.h"
#include "solver/report/svg_parts.h"

namespace hcsp {

namespace {

using report::put;
using report::TextBuffer;

// Colours that people with any colour vision tell apart, after Okabe and Ito, on white.
constexpr std::string_view kStyle = R"(<style>
text { font: 12px system-ui, "Segoe UI", Roboto, "Helvetica Neue", "DejaVu Sans", sans-serif; fill: #3b4652; }
.title { font-size: 17px; font-weight: 650; fill: #16202c; }
.name { font-weight: 600; fill: #16202c; }
.axis path { stroke: #8d98a6; fill: none; }
.grid path { stroke: #e4e9ef; }
.tube { stroke: #14305c; stroke-width: 2; fill: none; }
.tube-fill { fill: #a9bdd6; }
.truth { stroke: #d5480b; stroke-width: 1.4; stroke-linejoin: round; fill: none; }
.band { stroke: #14305c; stroke-width: .9; stroke-linejoin: round; fill: #14305c; fill-opacity: .25; }
.now { stroke: #14305c; stroke-width: 1.6; stroke-linejoin: round; fill: none; }
.past { stroke: #b9c3cf; stroke-linejoin: round; fill: none; }
</style>
)";

constexpr double kMapEdge = 560;
constexpr double kPlotWidth = 520;
constexpr double kGap = 60;  // to the left of a plot, for its axis
constexpr double kTop = 70;
constexpr double kMostHeight = 4000;

// One line about the run, and one about why it has no solution.
std::string caption(const Result& result) {
  std::string text =
      fmt::format("{} in {} s, ", to_string(result.status), report::for_people(result.statistics.seconds, 3));
  if (result.paving) {
    const Paving& paving = *result.paving;
    text += fmt::format("{} cells; inside at least {}, boundary at most {}", paving.cells,
                        report::for_people(paving.inside_volume), report::for_people(paving.boundary_volume));
  } else if (result.search) {
    text += fmt::format("{} boxes, {} cells", result.search->solutions.size(), result.search->cells);
  } else {
    text += fmt::format("{} passes", result.statistics.passes);
  }
  if (result.objective && !result.objective->is_empty())
    text += fmt::format(", objective in {}", to_string(*result.objective));
  if (!result.explanation) return text;
  const Explanation& why = *result.explanation;
  text += why.variable.empty()
              ? fmt::format(": refuted by constraint {}", why.constraint)
              : fmt::format(": constraint {} leaves no value for {}", why.constraint, why.variable);
  if (why.time) {
    text += fmt::format(" at t in [{}, {}]", report::for_people((*why.time)[0]),
                        report::for_people((*why.time)[1]));
  }
  return text;
}

}  // namespace

std::string to_svg(const Result& result, const Presentation& presentation) {
  if (const auto drawn = report::drawn(result)) return to_svg(*drawn, presentation);
  const std::vector<const ResultVariable*> shown = report::shown_variables(result.variables, presentation);
  const std::vector<report::TimePlot> plots = report::time_plots(shown);
  const bool with_map = result.paving || report::has_map(shown);
  const auto count = static_cast<double>(plots.size());
  const double plots_height = std::clamp(with_map ? kMapEdge : 200 * count, 150 * count, kMostHeight);
  const std::string said = caption(result);
  constexpr double kLetter = 6.5;  // wide, about
  const double width =
      std::max((with_map ? kGap + kMapEdge : 0) + (plots.empty() ? 0 : kGap + kPlotWidth) + 30,
               40 + kLetter * static_cast<double>(said.size()));
  const double height = kTop + std::max(with_map ? kMapEdge + 80 : 40, plots.empty() ? 0 : plots_height + 40);
  TextBuffer out;
  fmt::format_to(
      fmt::appender(out),
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n",
      std::max(width, 420.0), height);
  fmt::format_to(fmt::appender(out), "<title>{}</title>\n", report::xml_escape(result.model));
  put(out, kStyle);
  put(out, "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n");
  fmt::format_to(fmt::appender(out),
                 "<text class=\"title\" x=\"20\" y=\"28\">{}</text>\n<text x=\"20\" y=\"46\">{}</text>\n",
                 report::xml_escape(result.model), report::xml_escape(said));
  if (result.paving) {
    report::put_paving(out, kGap, kTop, kMapEdge, *result.paving);
  } else if (with_map) {
    report::put_map(out, kGap, kTop, kMapEdge, shown, presentation);
  }
  const double left = (with_map ? kGap + kMapEdge : 0) + kGap;
  const double step = plots_height / std::max(count, 1.0);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    const double top = kTop + step * static_cast<double>(i);
    report::put_time_plot(out, plots[i], {left, top, kPlotWidth, std::max(step - 48, 10.0), {}, {}},
                          static_cast<int>(i) + 1, result, presentation);
  }
  put(out, "</svg>\n");
  return report::to_text(out);
}

}  // namespace hcsp
