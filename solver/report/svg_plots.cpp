// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "solver/report/svg_parts.h"

namespace hcsp::report {

namespace {

// Of a tube that is known at its gates only, the gates are drawn, otherwise the slices: the first such item.
std::size_t first_item(const Tube& tube) {
  for (std::size_t k = 0; k < tube.line().slices(); ++k) {
    for (std::size_t c = 0; c < tube.dim(); ++c) {
      if (!tube.slice(c, k).is_entire()) return 1;
    }
  }
  return 0;
}

double width_at(const Tube& tube, std::size_t item) {
  double widest = 0.0;
  for (std::size_t c = 0; c < tube.dim(); ++c) widest = std::max(widest, tube.hi(c)[item] - tube.lo(c)[item]);
  return widest;
}

// What is drawn of one item, or of several that share a column of pixels: then their hull.
struct Column {
  double x0, x1, lo, hi;
};

template <class Bounds>
std::vector<Column> columns_of(const Tube& tube, std::size_t first, const Plot& plot, Bounds bounds) {
  std::vector<Column> columns;
  for (std::size_t item = first; item < tube.items(); item += 2) {
    const double x0 = plot.x(tube.line().instants()[item / 2]);
    const double x1 = plot.x(tube.line().instants()[(item + 1) / 2]);
    const auto [lo, hi] = bounds(item);
    if (!columns.empty() && x1 - columns.back().x0 < 0.7) {
      Column& last = columns.back();
      last = {last.x0, x1, std::min(last.lo, lo), std::max(last.hi, hi)};
    } else {
      columns.push_back({x0, x1, lo, hi});
    }
  }
  return columns;
}

std::vector<Column> widths(const Tube& tube, const Plot& plot) {
  return columns_of(tube, first_item(tube), plot, [&](std::size_t item) {
    const double width = width_at(tube, item);
    return std::pair(width, width);
  });
}

// Steps, broken where a width is infinite.
void put_steps(TextBuffer& out, const Plot& plot, const std::vector<Column>& columns,
               std::string_view css_class) {
  fmt::format_to(fmt::appender(out), R"(<path class="{}" d=")", css_class);
  bool is_open = false;
  for (const Column& column : columns) {
    if (std::isfinite(column.hi)) {
      fmt::format_to(fmt::appender(out), "{}{:.1f} {:.1f}H{:.1f}", is_open ? "L" : "M", column.x0,
                     plot.y(column.hi), std::max(column.x1, column.x0 + 1));
    }
    is_open = std::isfinite(column.hi);
  }
  put(out, "\"/>\n");
}

void put_band(TextBuffer& out, const Plot& plot, const Tube& tube, std::size_t c) {
  const std::size_t first = first_item(tube);
  const std::vector<Column> columns = columns_of(
      tube, first, plot, [&](std::size_t item) { return std::pair(tube.lo(c)[item], tube.hi(c)[item]); });
  const auto to = fmt::appender(out);
  if (first == 0) {
    put(out, R"(<path class="now" d=")");
    for (const Column& column : columns) {
      if (std::isinf(column.lo) && std::isinf(column.hi)) continue;
      fmt::format_to(to, "M{:.1f} {:.1f}V{:.1f}", column.x0, plot.y(column.lo), plot.y(column.hi));
    }
    return put(out, "\"/>\n");
  }
  put(out, R"(<path class="band" d=")");
  char command = 'M';
  for (const Column& column : columns) {
    fmt::format_to(to, "{}{:.1f} {:.1f}H{:.1f}", command, column.x0, plot.y(column.hi), column.x1);
    command = 'L';
  }
  for (auto column = columns.rbegin(); column != columns.rend(); ++column) {
    fmt::format_to(to, "L{:.1f} {:.1f}H{:.1f}", column->x1, plot.y(column->lo), column->x0);
  }
  put(out, "Z\"/>\n");
}

// The tube's domains in earlier passes.
std::vector<const Tube*> past(const Result& result, const std::string& name) {
  std::vector<const Tube*> tubes;
  for (const PassSnapshot& snapshot : result.snapshots) {
    for (const ResultVariable& variable : snapshot.variables) {
      const auto* tube = std::get_if<Tube>(&variable.domain);
      if (variable.name == name && tube != nullptr && !tube->is_empty()) tubes.push_back(tube);
    }
  }
  return tubes;
}

void put_width_plot(TextBuffer& out, const ResultVariable& variable, Plot plot, int id,
                    const Result& result) {
  const Tube& tube = std::get<Tube>(variable.domain);
  const std::vector<const Tube*> before = past(result, variable.name);
  const auto top_of = [](const Tube& each) {
    double most = 0.0;
    for (std::size_t item = first_item(each); item < each.items(); item += 2) {
      const double width = width_at(each, item);
      if (std::isfinite(width)) most = std::max(most, width);
    }
    return most;
  };
  double most = top_of(tube);
  for (const Tube* each : before) most = std::max(most, top_of(*each));
  plot.y_range = {0.0, most > 0.0 ? 1.06 * most : 1.0};
  put_grid(out, plot);
  put_axes(out, plot, "t", "width of " + variable.name);
  open_clipped(out, plot, id);
  for (const Tube* each : before) put_steps(out, plot, widths(*each, plot), "past");
  put_steps(out, plot, widths(tube, plot), "now");
  put(out, "</g>\n");
}

// Of a tube, at most; as in plots.js.
constexpr std::size_t kMostComponents = 12;

// The last one that is drawn tells how many there are.
std::string title_of(const ResultVariable& variable, std::size_t dim, std::size_t component) {
  if (dim == 1) return variable.name;
  const bool is_last = component + 1 == kMostComponents && dim > kMostComponents;
  return fmt::format("{}[{}]{}", variable.name, component + 1, is_last ? fmt::format(" of {}", dim) : "");
}

}  // namespace

std::vector<TimePlot> time_plots(const std::vector<const ResultVariable*>& shown) {
  std::vector<TimePlot> plots;
  for (const ResultVariable* variable : shown) {
    const auto* tube = std::get_if<Tube>(&variable->domain);
    if (tube == nullptr || tube->is_empty()) continue;
    // Of a tube that is drawn so finely the slices' widths are how much it moves meanwhile.
    if (!variable->shape.is_drawn) plots.push_back({variable, tube->dim()});
    for (std::size_t c = 0; c < std::min(tube->dim(), kMostComponents); ++c) plots.push_back({variable, c});
  }
  return plots;
}

void put_time_plot(TextBuffer& out, const TimePlot& what, Plot plot, int id, const Result& result,
                   const Presentation& presentation) {
  const Tube& tube = std::get<Tube>(what.variable->domain);
  const std::size_t c = what.component;
  plot.x_range = {tube.line().start(), tube.line().end()};
  if (c == tube.dim()) return put_width_plot(out, *what.variable, plot, id, result);
  std::vector<double> truth;
  if (presentation.truth) {
    const auto found = presentation.truth->tubes.find(what.variable->name);
    if (found != presentation.truth->tubes.end()) {
      for (const std::vector<double>& row : found->second) truth.push_back(row[c]);
    }
  }
  Extent extent;
  for (std::size_t item = first_item(tube); item < tube.items(); item += 2) {
    extent.add(tube.lo(c)[item]);
    extent.add(tube.hi(c)[item]);
  }
  for (const double value : truth) extent.add(value);
  plot.y_range = extent.range(0.06);
  put_grid(out, plot);
  put_axes(out, plot, "t", title_of(*what.variable, tube.dim(), c));
  open_clipped(out, plot, id);
  put_band(out, plot, tube, c);
  if (!truth.empty()) put_truth_line(out, plot, presentation.truth->t, truth);
  put(out, "</g>\n");
}

}  // namespace hcsp::report
