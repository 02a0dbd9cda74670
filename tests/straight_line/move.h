// SPDX-License-Identifier: Apache-2.0
// A move of K joints, as the models are asked for it, and the one coordinate that it comes to on a line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/straight_line/profile.h"

namespace hcsp::straight_line {

using Vector = std::vector<double>;

/// What the models call K p0 v0 a0 j0 p1 v1 a1 j1 vmin vmax ... tol line, as far as the type has them.
struct Move {
  int type = 3;
  Vector p0, v0, a0, j0, p1, v1, a1, j1;
  Vector vmin, vmax, amin, amax, jmin, jmax,
      dmax;  ///< the limit of jerk's derivative is one of its magnitude
  double tol = 1e-9;
  Vector line;  ///< empty or zero: to be found

  [[nodiscard]] std::size_t joints() const { return p0.size(); }
  /// By the name of the parameter; null where the type has none of that name. Limits have the same sign at
  /// both ends.
  [[nodiscard]] const Vector* parameter(const std::string& name) const;
  /// All of it, in digits that give the same doubles again, as parameters of a model.
  [[nodiscard]] std::string text() const;
};

/// From rest at the origin to rest, with these limits both ways.
Move from_rest(int type, const Vector& p1, const Vector& vmax, const Vector& amax, const Vector& jmax);

/// The names of the vectors that a type has, position first: those that have to be collinear, and the limits.
std::vector<std::string> vectors_of(int type);
std::vector<std::string> limits_of(int type);

/// A motion along rho: q from 0 with the velocity w0 to q1 and w1, and so on.
struct Line {
  std::vector<Number> rho;
  State from, to;
  Number from_jerk = 0, to_jerk = 0;  ///< of types VI to IX
};

/// The limits of the coordinate q: the intersection of those of the joints.
Limits limits_on(const std::vector<Number>& rho, const Move& move);

/// The optimum of a move along a known line, types I to V; none where the target cannot be reached.
std::optional<Profile> fastest_along(const Line& line, const Move& move);

}  // namespace hcsp::straight_line
