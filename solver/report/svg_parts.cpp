// SPDX-License-Identifier: Apache-2.0
#include "solver/report/svg_parts.h"

#include <algorithm>
#include <cmath>

namespace hcsp::report {

std::vector<double> ticks(double lo, double hi, int count) {
  const double rough = (hi - lo) / count;
  if (!(rough > 0.0) || !std::isfinite(rough)) return {};
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double lead = rough / power;
  const double step = power * (lead < 1.5 ? 1.0 : lead < 3.5 ? 2.0 : lead < 7.5 ? 5.0 : 10.0);
  std::vector<double> values;
  const double slack = 1e-9;  // of a step: 3 * 0.2 is a tick of a range that ends at 0.6
  for (double k = std::ceil(lo / step - slack); k <= hi / step + slack; ++k)
    values.push_back(k * step + 0.0);  // no -0
  return values;
}

namespace {

double place(double value, const std::array<double, 2>& range, double from, double length) {
  const double part = (value - range[0]) / (range[1] - range[0]);
  return from + length * std::clamp(part, -0.25, 1.25);
}

std::vector<double> ticks_of_y(const Plot& plot) {
  return ticks(plot.y_range[0], plot.y_range[1], std::max(2, static_cast<int>(plot.height / 40)));
}

}  // namespace

double Plot::x(double value) const { return place(value, x_range, left, width); }
double Plot::y(double value) const { return place(value, y_range, top + height, -height); }

void Extent::add(double value) {
  if (!std::isfinite(value)) return;
  lo_ = std::min(lo_, value);
  hi_ = std::max(hi_, value);
}

std::array<double, 2> Extent::range(double margin) const {
  if (is_empty()) return {-1.0, 1.0};
  double pad = margin * (hi_ - lo_);
  if (!(pad > 1e-12 * std::max(std::abs(lo_), std::abs(hi_)))) pad = 1e-3 * std::max(std::abs(hi_), 1e-3);
  return {lo_ - pad, hi_ + pad};
}

void put_axes(TextBuffer& out, const Plot& plot, std::string_view x_name, std::string_view y_name) {
  const auto to = fmt::appender(out);
  const double bottom = plot.top + plot.height;
  const auto x_ticks =
      ticks(plot.x_range[0], plot.x_range[1], std::max(2, static_cast<int>(plot.width / 80)));
  const auto y_ticks = ticks_of_y(plot);
  fmt::format_to(to, R"(<g class="axis"><path d="M{0:.1f} {1:.1f}v{2:.1f}h{3:.1f}"/>)", plot.left, plot.top,
                 plot.height, plot.width);
  put(out, R"(<g text-anchor="middle">)");
  for (const double t : x_ticks) {
    fmt::format_to(to, R"(<path d="M{0:.1f} {1:.1f}v4"/><text x="{0:.1f}" y="{2:.1f}">{3}</text>)", plot.x(t),
                   bottom, bottom + 15, for_people(t));
  }
  put(out, R"(</g><g text-anchor="end">)");
  for (const double t : y_ticks) {
    fmt::format_to(to, R"(<path d="M{0:.1f} {1:.1f}h-4"/><text x="{2:.1f}" y="{3:.1f}">{4}</text>)",
                   plot.left, plot.y(t), plot.left - 7, plot.y(t) + 4, for_people(t));
  }
  fmt::format_to(to, R"(</g><text class="name" x="{:.1f}" y="{:.1f}" text-anchor="end">{}</text>)",
                 plot.left + plot.width, bottom + 29, xml_escape(x_name));
  fmt::format_to(to, "<text class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text></g>\n", plot.left,
                 plot.top - 7, xml_escape(y_name));
}

void put_grid(TextBuffer& out, const Plot& plot) {
  put(out, R"(<g class="grid">)");
  for (const double t : ticks_of_y(plot)) {
    fmt::format_to(fmt::appender(out), R"(<path d="M{:.1f} {:.1f}h{:.1f}"/>)", plot.left, plot.y(t),
                   plot.width);
  }
  put(out, "</g>\n");
}

void open_clipped(TextBuffer& out, const Plot& plot, int id) {
  fmt::format_to(
      fmt::appender(out),
      "<clipPath id=\"clip{0}\"><rect x=\"{1:.1f}\" y=\"{2:.1f}\" width=\"{3:.1f}\" height=\"{4:.1f}\"/>"
      "</clipPath>\n<g clip-path=\"url(#clip{0})\">\n",
      id, plot.left, plot.top, plot.width, plot.height);
}

void put_truth_line(TextBuffer& out, const Plot& plot, const std::vector<double>& xs,
                    const std::vector<double>& ys) {
  if (xs.empty()) return;
  put(out, R"(<path class="truth" d="M)");
  for (std::size_t i = 0; i < xs.size(); ++i) {
    fmt::format_to(fmt::appender(out), "{}{:.1f} {:.1f}", i == 0 ? "" : "L", plot.x(xs[i]), plot.y(ys[i]));
  }
  put(out, "\"/>\n");
}

void put_legend(TextBuffer& out, double left, double baseline, double width, const std::vector<Key>& keys) {
  double x = left;
  for (const Key& key : keys) {
    const double needed =
        34.0 + 7.2 * static_cast<double>(key.label.size());  // of a label in 12 px letters, about
    if (x > left && x + needed > left + width) {
      x = left;
      baseline += 18;
    }
    const double height = key.is_line ? 2.5 : 11;
    fmt::format_to(
        fmt::appender(out),
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"16\" height=\"{}\" fill=\"{}\" fill-opacity=\"{}\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        x, baseline - 4 - height / 2, height, key.color, key.opacity, x + 22, baseline,
        xml_escape(key.label));
    x += needed;
  }
}

}  // namespace hcsp::report
