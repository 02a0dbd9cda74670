// SPDX-License-Identifier: Apache-2.0
// A paving as pictures show it: rectangles of the plane of its first two coordinates; of one coordinate
// alone, a strip.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "solver/report/text.h"
#include "solver/result.h"

namespace hcsp::report {

/// Rectangles x1, x2, y1, y2, one after another.
using Rectangles = std::vector<double>;

struct PavingMap {
  std::array<std::string, 2> names;  ///< the second is empty for a strip
  Rectangles inside, boundary, unexplored;
  std::array<double, 4> frame;  ///< of what is bounded: x1, x2, y1, y2
  double stretch = 1.0;         ///< of y, so that the frame is about as high as it is wide
  bool is_projected = false;    ///< there are more coordinates: rectangles overlap
};

/// Rectangles that touch along a whole side are drawn as one.
PavingMap paving_map(const Paving& paving);

/// In a square of edge `edge`.
void put_paving(TextBuffer& out, double left, double top, double edge, const Paving& paving);

}  // namespace hcsp::report
