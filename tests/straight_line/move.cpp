// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/move.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "tests/straight_line/enumerator.h"

namespace hcsp::straight_line {

namespace {

std::string digits(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

void tighten(Number& low, Number& high, const Number& rho, double least, double greatest) {
  const Number a = least / rho, b = greatest / rho;
  low = std::max(low, std::min(a, b));
  high = std::min(high, std::max(a, b));
}

Vector negative(Vector values) {
  for (double& x : values) x = -x;
  return values;
}

}  // namespace

Move from_rest(int type, const Vector& p1, const Vector& vmax, const Vector& amax, const Vector& jmax) {
  const Vector zero(p1.size(), 0);
  Move move;
  move.type = type;
  for (Vector* values : {&move.p0, &move.v0, &move.a0, &move.j0, &move.v1, &move.a1, &move.j1})
    *values = zero;
  move.p1 = p1;
  move.vmax = vmax;
  move.amax = amax;
  move.jmax = jmax;
  move.vmin = negative(vmax);
  move.amin = negative(amax);
  move.jmin = negative(jmax);
  move.dmax = Vector(p1.size(), 1e3);
  return move;
}

std::vector<std::string> vectors_of(int type) {
  std::vector<std::string> names{"p0", "v0", "p1"};
  if (type >= 3) names.emplace_back("a0");
  if (type >= 6) names.emplace_back("j0");
  if (type != 1 && type != 3 && type != 6) names.emplace_back("v1");
  if (type == 5 || type >= 8) names.emplace_back("a1");
  if (type == 9) names.emplace_back("j1");
  return names;
}

std::vector<std::string> limits_of(int type) {
  std::vector<std::string> names{"vmin", "vmax", "amin", "amax"};
  if (type >= 3) names.insert(names.end(), {"jmin", "jmax"});
  if (type >= 6) names.emplace_back("dmax");
  return names;
}

const Vector* Move::parameter(const std::string& name) const {
  const std::map<std::string, const Vector*> all{
      {"p0", &p0},     {"v0", &v0},     {"a0", &a0},     {"j0", &j0},     {"p1", &p1},     {"v1", &v1},
      {"a1", &a1},     {"j1", &j1},     {"vmin", &vmin}, {"vmax", &vmax}, {"amin", &amin}, {"amax", &amax},
      {"jmin", &jmin}, {"jmax", &jmax}, {"dmax", &dmax}, {"line", &line}};
  std::vector<std::string> names = vectors_of(type);
  const std::vector<std::string> limits = limits_of(type);
  names.insert(names.end(), limits.begin(), limits.end());
  names.emplace_back("line");
  const bool has = std::find(names.begin(), names.end(), name) != names.end();
  return has ? all.at(name) : nullptr;
}

std::string Move::text() const {
  std::string all =
      "type" + std::to_string(type) + " K = " + std::to_string(joints()) + "; tol = " + digits(tol) + ";";
  for (const char* name : {"p0", "v0", "a0", "j0", "p1", "v1", "a1", "j1", "vmin", "vmax", "amin", "amax",
                           "jmin", "jmax", "dmax", "line"}) {
    const Vector* values = parameter(name);
    if (values == nullptr || values->empty()) continue;
    all += std::string(" ") + name + " = (";
    for (std::size_t k = 0; k < values->size(); ++k) all += (k > 0 ? ", " : "") + digits((*values)[k]);
    all += ");";
  }
  return all;
}

Limits limits_on(const std::vector<Number>& rho, const Move& move) {
  const Number far = std::numeric_limits<double>::max();
  Limits l{-far, far, -far, far, -far, far};
  for (std::size_t k = 0; k < rho.size(); ++k) {
    if (rho[k] == 0) continue;
    tighten(l.wl, l.wh, rho[k], move.vmin[k], move.vmax[k]);
    tighten(l.bl, l.bh, rho[k], move.amin[k], move.amax[k]);
    if (move.type >= 3) tighten(l.ul, l.uh, rho[k], move.jmin[k], move.jmax[k]);
  }
  return l;
}

std::optional<Profile> fastest_along(const Line& line, const Move& move) {
  const Limits l = limits_on(line.rho, move);
  return move.type <= 2 ? fastest_without_jerk(line.from, line.to, l)
                        : fastest_from_anywhere(line.from, line.to, l);
}

}  // namespace hcsp::straight_line
