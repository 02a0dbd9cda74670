// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "solver/report/svg_parts.h"

namespace hcsp::report {

namespace {

constexpr std::array<const char*, 4> kSetColors = {"#4fa9dc", "#e3a01b", "#2a9d7c", "#c878a6"};
constexpr double kInsideOpacity = 0.55;
constexpr double kUnknownOpacity = 0.17;

const SetInterval* plane_set(const ResultVariable& variable) {
  const auto* set = std::get_if<SetInterval>(&variable.domain);
  return set != nullptr && set->dim() == 2 && !set->is_empty() ? set : nullptr;
}

// The state that fills the space beyond what boxes() reaches.
bool is_bounded(const SetInterval& set) { return set.background() == CellState::outside; }

// The cells of one state of one set, as the map shows them.
struct Layer {
  const SetInterval* set;
  CellState state;
  std::string color;
  std::vector<std::vector<double>> boxes;
};

// All that is known of every set; what is open of the bounded ones, or of all if none is bounded.
std::vector<Layer> layers_of(const std::vector<const ResultVariable*>& shown, std::vector<Key>& keys) {
  std::vector<Layer> layers;
  const bool some_bounded = std::any_of(shown.begin(), shown.end(), [](const ResultVariable* variable) {
    const SetInterval* set = plane_set(*variable);
    return set != nullptr && is_bounded(*set);
  });
  std::size_t count = 0;
  for (const ResultVariable* variable : shown) {
    const SetInterval* set = plane_set(*variable);
    if (set == nullptr) continue;
    const char* color = kSetColors[count++ % kSetColors.size()];
    auto inside = set->boxes(CellState::inside);
    if (!inside.empty()) {
      layers.push_back({set, CellState::inside, color, std::move(inside)});
      keys.push_back({variable->name + " inside", color, kInsideOpacity + 0.2});
    }
    if (!is_bounded(*set) && some_bounded) continue;
    layers.push_back({set, CellState::unknown, color, set->boxes(CellState::unknown)});
    keys.push_back({variable->name + " unknown", color, kUnknownOpacity + 0.15});
  }
  return layers;
}

const ResultVariable* leading_tube(const std::vector<const ResultVariable*>& shown,
                                   const Presentation& presentation) {
  const ResultVariable* leading = nullptr;
  for (const ResultVariable* variable : shown) {
    const auto* tube = std::get_if<Tube>(&variable->domain);
    if (tube == nullptr || tube->dim() < 2 || tube->is_empty()) continue;
    const bool has_truth = presentation.truth && presentation.truth->tubes.contains(variable->name);
    if (has_truth) return variable;
    if (leading == nullptr) leading = variable;
  }
  return leading;
}

// The end, where one may be over before the picture is: the last item at which something is known of both.
std::size_t last_known(const Tube& a, const Tube& b) {
  std::size_t item = a.items() - 1;
  const auto is_known = [&](std::size_t c) {
    return a.at(c, item).is_bounded() && b.at(c, item).is_bounded();
  };
  while (item > 0 && !(is_known(0) && is_known(1))) --item;
  return item;
}

// The others that lead from where it starts to where it ends, on phases: ways to compare.
std::vector<const ResultVariable*> other_paths(const std::vector<const ResultVariable*>& shown,
                                               const ResultVariable* leading) {
  std::vector<const ResultVariable*> others;
  if (leading == nullptr || !leading->shape.is_drawn) return others;
  const Tube& way = std::get<Tube>(leading->domain);
  for (const ResultVariable* variable : shown) {
    const auto* tube = std::get_if<Tube>(&variable->domain);
    if (variable == leading || tube == nullptr || !variable->shape.is_drawn || tube->dim() < 2) continue;
    if (variable->shape.degree != leading->shape.degree) continue;  // a derivative is no way
    const bool is_same_way = [&] {
      for (const std::size_t end : {std::size_t{0}, last_known(way, *tube)}) {
        for (const std::size_t c : {0U, 1U}) {
          if (meet(way.at(c, end), tube->at(c, end)).is_empty()) return false;
        }
      }
      return true;
    }();
    if (is_same_way) others.push_back(variable);
  }
  return others;
}

const std::vector<std::vector<double>>* truth_of(const ResultVariable* tube,
                                                 const Presentation& presentation) {
  if (tube == nullptr || !presentation.truth) return nullptr;
  const auto found = presentation.truth->tubes.find(tube->name);
  return found == presentation.truth->tubes.end() ? nullptr : &found->second;
}

// A plot of equal scale on both axes around everything that is bounded.
Plot frame_of(double left, double top, double edge, const std::vector<Layer>& layers,
              const std::vector<const ResultVariable*>& paths,
              const std::vector<std::vector<double>>* truth) {
  Extent xs, ys;
  for (const Layer& layer : layers) {
    if (layer.state == CellState::unknown && !is_bounded(*layer.set)) continue;
    for (const std::vector<double>& box : layer.boxes) {
      for (const std::size_t i : {0U, 1U}) {
        xs.add(box[i]);
        ys.add(box[2 + i]);
      }
    }
  }
  for (const ResultVariable* path : paths) {
    const Tube& tube = std::get<Tube>(path->domain);
    for (std::size_t item = 0; item < tube.items(); ++item) {
      xs.add(tube.lo(0)[item]);
      xs.add(tube.hi(0)[item]);
      ys.add(tube.lo(1)[item]);
      ys.add(tube.hi(1)[item]);
    }
  }
  if (truth != nullptr) {
    for (const std::vector<double>& row : *truth) {
      xs.add(row[0]);
      ys.add(row[1]);
    }
  }
  std::array<double, 2> x = xs.range(0.03);
  std::array<double, 2> y = ys.range(0.03);
  const double grow = ((x[1] - x[0]) - (y[1] - y[0])) / 2;
  std::array<double, 2>& narrow = grow > 0 ? y : x;
  narrow = {narrow[0] - std::abs(grow), narrow[1] + std::abs(grow)};
  return {left, top, edge, edge, x, y};
}

void put_rectangle(TextBuffer& out, const Plot& plot, double x0, double x1, double y0, double y1,
                   double least = 0.0) {
  const double left = plot.x(x0);
  const double top = plot.y(y1);
  const double width = std::max(plot.x(x1) - left, least);
  const double height = std::max(plot.y(y0) - top, least);
  if (width > 0 && height > 0) {
    fmt::format_to(fmt::appender(out), "M{:.2f} {:.2f}h{:.2f}v{:.2f}h-{:.2f}z", left, top, width, height,
                   width);
  }
}

// The boxes; and if the state fills the space beyond, the plot without the hull of what the tree reaches.
void put_layer(TextBuffer& out, const Plot& plot, const Layer& layer) {
  const double opacity = layer.state == CellState::inside ? kInsideOpacity : kUnknownOpacity;
  fmt::format_to(fmt::appender(out),
                 R"(<path shape-rendering="crispEdges" fill-rule="evenodd" fill="{}" fill-opacity="{}" d=")",
                 layer.color, opacity);
  for (const std::vector<double>& box : layer.boxes) put_rectangle(out, plot, box[0], box[1], box[2], box[3]);
  if (layer.set->background() == layer.state) {
    const Region reach = layer.set->reach();
    const double h = layer.set->precision();
    const auto bound = [&](std::int64_t cell) { return static_cast<double>(cell) * h; };
    put_rectangle(out, plot, -kInfinity, kInfinity, -kInfinity, kInfinity);
    put_rectangle(out, plot, bound(reach.lo[0]), bound(reach.hi[0]), bound(reach.lo[1]), bound(reach.hi[1]));
  }
  put(out, "\"/>\n");
}

// The outlines of all slices under their union: what remains is the outline of the union.
void put_tube(TextBuffer& out, const Plot& plot, const Tube& tube, std::size_t number,
              std::string_view color) {
  fmt::format_to(fmt::appender(out), R"(<defs><path id="slices{}" d=")", number);
  for (std::size_t k = 0; k < tube.line().slices(); ++k) {
    const Interval x = tube.slice(0, k);
    const Interval y = tube.slice(1, k);
    if (x.is_entire() || y.is_entire()) continue;
    put_rectangle(out, plot, x.lo(), x.hi(), y.lo(), y.hi(), 0.5);
  }
  const std::string style = color.empty() ? "" : fmt::format(R"( style="stroke:{0};fill:{0}")", color);
  fmt::format_to(fmt::appender(out),
                 "\"/></defs><use href=\"#slices{0}\" class=\"tube\"{1}/><use href=\"#slices{0}\" "
                 "class=\"tube-fill\"{1}/>\n",
                 number, style);
}

}  // namespace

bool has_map(const std::vector<const ResultVariable*>& shown) {
  return leading_tube(shown, {}) != nullptr ||
         std::any_of(shown.begin(), shown.end(),
                     [](const ResultVariable* v) { return plane_set(*v) != nullptr; });
}

void put_map(TextBuffer& out, double left, double top, double edge,
             const std::vector<const ResultVariable*>& shown, const Presentation& presentation) {
  std::vector<Key> keys;
  const std::vector<Layer> layers = layers_of(shown, keys);
  const ResultVariable* leading = leading_tube(shown, presentation);
  const std::vector<std::vector<double>>* truth = truth_of(leading, presentation);
  std::vector<const ResultVariable*> paths = other_paths(shown, leading);
  if (leading != nullptr) paths.push_back(leading);
  const Plot plot = frame_of(left, top, edge, layers, paths, truth);
  open_clipped(out, plot, 0);
  for (const CellState state : {CellState::unknown, CellState::inside}) {
    for (const Layer& layer : layers) {
      if (layer.state == state) put_layer(out, plot, layer);
    }
  }
  const auto first_key = static_cast<std::ptrdiff_t>(keys.size());
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const bool leads = paths[i] == leading;
    const std::string color = leads ? "" : kSetColors[(i + 1) % kSetColors.size()];
    put_tube(out, plot, std::get<Tube>(paths[i]->domain), i, color);
    keys.insert(leads ? keys.begin() + first_key : keys.end(),
                Key{paths[i]->name, leads ? "#a9bdd6" : color});
  }
  if (truth != nullptr) {
    std::vector<double> xs, ys;
    for (const std::vector<double>& row : *truth) {
      xs.push_back(row[0]);
      ys.push_back(row[1]);
    }
    put_truth_line(out, plot, xs, ys);
    keys.push_back({"true " + leading->name, "#d5480b", 1.0, true});
  }
  put(out, "</g>\n");
  std::string name = leading != nullptr ? leading->name : "";
  for (const ResultVariable* variable : shown) {
    if (name.empty() && plane_set(*variable) != nullptr) name = variable->name;
  }
  put_axes(out, plot, name + "[1]", name + "[2]");
  put_legend(out, left, top + edge + 50, edge, keys);
}

}  // namespace hcsp::report
