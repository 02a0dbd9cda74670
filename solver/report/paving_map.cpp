// SPDX-License-Identifier: Apache-2.0
#include "solver/report/paving_map.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "solver/report/svg_parts.h"

namespace hcsp::report {

namespace {

// A strip is a twelfth as high as it is wide.
constexpr double kStrip = 1.0 / 12;

using Rectangle = std::array<double, 4>;

// Joins runs along one axis: of rectangles with equal sides on the other, where one ends as the next begins.
void join_runs(std::vector<Rectangle>& all, std::size_t axis) {
  const std::size_t along = 2 * axis, across = 2 - along;
  std::sort(all.begin(), all.end(), [&](const Rectangle& a, const Rectangle& b) {
    return std::tie(a[across], a[across + 1], a[along], a[along + 1]) <
           std::tie(b[across], b[across + 1], b[along], b[along + 1]);
  });
  std::size_t last = 0;
  for (std::size_t k = 1; k < all.size(); ++k) {
    Rectangle& open = all[last];
    const bool is_run = all[k][across] == open[across] && all[k][across + 1] == open[across + 1] &&
                        all[k][along] <= open[along + 1];
    if (is_run) {
      open[along + 1] = std::max(open[along + 1], all[k][along + 1]);
    } else {
      all[++last] = all[k];
    }
  }
  if (!all.empty()) all.resize(last + 1);
}

Rectangles drawn(const std::vector<Interval>& boxes, std::size_t dim, const Interval& strip) {
  std::vector<Rectangle> all;
  for (std::size_t first = 0; first < boxes.size(); first += dim) {
    const Interval &x = boxes[first], &y = dim == 1 ? strip : boxes[first + 1];
    all.push_back({x.lo(), x.hi(), y.lo(), y.hi()});
  }
  join_runs(all, 0);
  join_runs(all, 1);
  Rectangles flat;
  for (const Rectangle& one : all) flat.insert(flat.end(), one.begin(), one.end());
  return flat;
}

// The finite bounds of a coordinate.
std::array<double, 2> extent_of(const Paving& paving, std::size_t coordinate) {
  Extent extent;
  for (const auto* boxes : {&paving.inside, &paving.boundary, &paving.unexplored, &paving.outside}) {
    for (std::size_t i = coordinate; i < boxes->size(); i += paving.names.size()) {
      extent.add((*boxes)[i].lo());
      extent.add((*boxes)[i].hi());
    }
  }
  return extent.range(0.0);
}

void put_layer(TextBuffer& out, const Plot& plot, const Rectangles& all, std::string_view color,
               double opacity) {
  // What is thinner than this is drawn as wide: a boundary would vanish.
  constexpr double kLeast = 0.25;
  if (all.empty()) return;
  fmt::format_to(fmt::appender(out), R"(<path fill="{}" fill-opacity="{}" d=")", color, opacity);
  for (std::size_t k = 0; k < all.size(); k += 4) {
    const double x = plot.x(all[k]), y = plot.y(all[k + 3]);
    const double width = std::max(plot.x(all[k + 1]) - x, kLeast),
                 height = std::max(plot.y(all[k + 2]) - y, kLeast);
    fmt::format_to(fmt::appender(out), "M{:.2f} {:.2f}h{:.2f}v{:.2f}h-{:.2f}z", x, y, width, height, width);
  }
  put(out, "\"/>\n");
}

}  // namespace

PavingMap paving_map(const Paving& paving) {
  const std::size_t dim = paving.names.size();
  PavingMap map;
  map.is_projected = dim > 2;
  map.names = {paving.names[0], dim == 1 ? std::string() : paving.names[1]};
  const auto x = extent_of(paving, 0);
  const auto y = dim == 1 ? std::array{0.0, kStrip * (x[1] - x[0])} : extent_of(paving, 1);
  map.frame = {x[0], x[1], y[0], y[1]};
  const double ratio = (x[1] - x[0]) / (y[1] - y[0]);
  constexpr double kAlike = 2.5;
  if (dim > 1 && (ratio > kAlike || ratio < 1 / kAlike)) map.stretch = ratio;
  const Interval strip = Interval::raw(y[0], y[1]);
  map.inside = drawn(paving.inside, dim, strip);
  map.boundary = drawn(paving.boundary, dim, strip);
  map.unexplored = drawn(paving.unexplored, dim, strip);
  return map;
}

void put_paving(TextBuffer& out, double left, double top, double edge, const Paving& paving) {
  const PavingMap map = paving_map(paving);
  const double width = map.frame[1] - map.frame[0], height = (map.frame[3] - map.frame[2]) * map.stretch;
  const double scale = edge / std::max(width, height);
  const Plot plot{
      left, top, scale * width, scale * height, {map.frame[0], map.frame[1]}, {map.frame[2], map.frame[3]}};
  constexpr std::string_view kInside = "#4fa9dc", kBoundary = "#e3a01b", kOutside = "#eef1f5",
                             kOpen = "#c878a6";
  fmt::format_to(fmt::appender(out),
                 "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
                 plot.left, plot.top, plot.width, plot.height, kOutside);
  open_clipped(out, plot, 0);
  put_layer(out, plot, map.unexplored, kOpen, 0.4);
  put_layer(out, plot, map.boundary, kBoundary, map.is_projected ? 0.4 : 1.0);
  put_layer(out, plot, map.inside, kInside, 0.75);
  put(out, "</g>\n");
  if (map.names[1].empty()) {
    put_axes(out, {plot.left, plot.top, plot.width, plot.height, plot.x_range, {0.0, 0.0}}, map.names[0], "");
  } else {
    put_axes(out, plot, map.names[0], map.names[1]);
  }
  std::vector<Key> keys{{"inside", std::string(kInside), 0.75},
                        {"boundary", std::string(kBoundary)},
                        {map.is_projected ? "outside, or below others" : "outside", std::string(kOutside)}};
  if (!map.unexplored.empty()) keys.push_back({"unexplored", std::string(kOpen), 0.4});
  put_legend(out, left, plot.top + plot.height + 50, edge, keys);
}

}  // namespace hcsp::report
