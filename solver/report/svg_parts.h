// SPDX-License-Identifier: Apache-2.0
// The parts of a static picture: plots with axes, the map, and tubes against time.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/report/presentation.h"
#include "solver/report/text.h"
#include "solver/result.h"

namespace hcsp::report {

/// Round values in [lo, hi], about `count` of them: multiples of 1, 2 or 5 times a power of ten.
std::vector<double> ticks(double lo, double hi, int count);

/// A plot: a rectangle of the picture, in pixels with y downward, that shows a finite range of each axis.
struct Plot {
  double left, top, width, height;
  std::array<double, 2> x_range, y_range;

  /// Pixels; a value beyond the range (an infinite one too) is put a little beyond the plot, where it is
  /// clipped.
  [[nodiscard]] double x(double value) const;
  [[nodiscard]] double y(double value) const;
};

/// The range of the finite values that were added, with a margin; [-1, 1] without any.
class Extent {
 public:
  void add(double value);
  [[nodiscard]] bool is_empty() const { return !(lo_ <= hi_); }
  [[nodiscard]] std::array<double, 2> range(double margin) const;

 private:
  double lo_ = kInfinity, hi_ = -kInfinity;
};

void put_axes(TextBuffer& out, const Plot& plot, std::string_view x_name, std::string_view y_name);
/// Faint lines at the ticks of the y axis; they belong under what is drawn.
void put_grid(TextBuffer& out, const Plot& plot);
/// Opens a group whose content is cut at the plot's border; `id` is unique in the picture. Close it with
/// "</g>".
void open_clipped(TextBuffer& out, const Plot& plot, int id);
/// A polyline through the rows of the truth.
void put_truth_line(TextBuffer& out, const Plot& plot, const std::vector<double>& xs,
                    const std::vector<double>& ys);

/// An entry of a legend.
struct Key {
  std::string label;
  std::string color;
  double opacity = 1.0;
  bool is_line = false;
};
void put_legend(TextBuffer& out, double left, double baseline, double width, const std::vector<Key>& keys);

/// Whether there is anything to draw in the plane.
bool has_map(const std::vector<const ResultVariable*>& shown);
/// The sets of the plane, and over them one tube with its truth, in a square of edge `edge`.
void put_map(TextBuffer& out, double left, double top, double edge,
             const std::vector<const ResultVariable*>& shown, const Presentation& presentation);

/// The plots of the shown tubes against time: for each its width, pass upon pass, and its components.
struct TimePlot {
  const ResultVariable* variable;
  std::size_t component;  ///< from 0; the dimension for the width
};
std::vector<TimePlot> time_plots(const std::vector<const ResultVariable*>& shown);
void put_time_plot(TextBuffer& out, const TimePlot& what, Plot place, int id, const Result& result,
                   const Presentation& presentation);

}  // namespace hcsp::report
