// SPDX-License-Identifier: Apache-2.0
#include "tests/soundness/exact_truth.h"

namespace hcsp::soundness {

ExactReal ExactReal::moved(double speed, double heading, bool sine, double from, double to) const {
  ExactReal way, length;
  mpfr_set_d(way.value_, heading, MPFR_RNDN);
  (sine ? mpfr_sin : mpfr_cos)(way.value_, way.value_, MPFR_RNDN);
  mpfr_mul_d(way.value_, way.value_, speed, MPFR_RNDN);
  mpfr_set_d(length.value_, to, MPFR_RNDN);
  mpfr_sub_d(length.value_, length.value_, from, MPFR_RNDN);
  mpfr_mul(way.value_, way.value_, length.value_, MPFR_RNDN);
  mpfr_add(way.value_, way.value_, value_, MPFR_RNDN);
  return way;
}

bool ExactReal::in(const Interval& bound) const {
  if (bound.is_empty()) return false;
  ExactReal slack, below, above;
  mpfr_set_ui_2exp(slack.value_, 1, -250, MPFR_RNDN);
  mpfr_sub(below.value_, value_, slack.value_, MPFR_RNDD);
  mpfr_add(above.value_, value_, slack.value_, MPFR_RNDU);
  return mpfr_cmp_d(above.value_, bound.lo()) >= 0 && mpfr_cmp_d(below.value_, bound.hi()) <= 0;
}

Interval ExactReal::enclosure() const {
  const double nearest = mpfr_get_d(value_, MPFR_RNDN);
  return Interval(nearest) + Interval(-0x1p-250, 0x1p-250) + Interval(nearest) * Interval(-0x1p-52, 0x1p-52);
}

ExactTruth::ExactTruth(const slam_simulator::Trajectory& path) : path_(path) {
  for (int c = 0; c < 2; ++c) {
    x_[c].emplace_back();
    for (std::size_t k = 0; k + 1 < path.t.size(); ++k) x_[c].push_back(at(c, k, path.t[k + 1]));
  }
}

ExactReal ExactTruth::at(int c, std::size_t k, double time) const {
  return at_stamp(c, k).moved(path_.speed[k], path_.heading[k], c == 1, path_.t[k], time);
}

Interval distance_to(const slam_simulator::Map& map, const Interval& x1, const Interval& x2) {
  Interval nearest = Interval::entire();
  for (const auto& wall : map) {
    const Interval d1 = Interval(wall.b.x1) - wall.a.x1, d2 = Interval(wall.b.x2) - wall.a.x2;
    const Interval r1 = x1 - wall.a.x1, r2 = x2 - wall.a.x2;
    const Interval along = (r1 * d1 + r2 * d2) / (sqr(d1) + sqr(d2));
    const Interval part = min(max(along, 0.0), 1.0);  // the nearest point of the wall is a + part (b - a)
    const Interval length = sqrt(sqr(r1 - part * d1) + sqr(r2 - part * d2));
    nearest = nearest.is_entire() ? length : min(nearest, length);
  }
  return nearest;
}

}  // namespace hcsp::soundness
