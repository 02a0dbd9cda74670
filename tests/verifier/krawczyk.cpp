// SPDX-License-Identifier: Apache-2.0
#include "tests/verifier/krawczyk.h"

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace hcsp::verifier {

namespace {

using Index = Eigen::Index;

Eigen::MatrixXd middle_of(const std::vector<Evaluation::Gradient>& jacobian, std::size_t unknowns) {
  Eigen::MatrixXd middle =
      Eigen::MatrixXd::Zero(static_cast<Index>(jacobian.size()), static_cast<Index>(unknowns));
  for (std::size_t e = 0; e < jacobian.size(); ++e) {
    for (const auto& [u, slope] : jacobian[e])
      middle(static_cast<Index>(e), static_cast<Index>(u)) = slope.middle();
  }
  return middle;
}

/// The operator for the unknowns `sought`, the others being parameters with all of their values.
class Operator {
 public:
  Operator(const System& system, std::vector<std::size_t> sought)
      : system_(system), equations_(system.equations()), sought_(std::move(sought)) {}

  /// The images of the sought unknowns, by f at the centre and the derivatives over the place.
  [[nodiscard]] std::vector<Precise> image(const Place& place, const Place& center) const {
    const Evaluation at_center(system_.expressions, center), over(system_.expressions, place);
    std::vector<Evaluation::Gradient> jacobian;
    for (const std::size_t e : equations_) jacobian.push_back(over.gradient(e));
    const Eigen::MatrixXd middle = middle_of(jacobian, place.size());
    Eigen::MatrixXd square(middle.rows(), middle.rows());
    for (std::size_t s = 0; s < sought_.size(); ++s)
      square.col(static_cast<Index>(s)) = middle.col(static_cast<Index>(sought_[s]));
    const Eigen::MatrixXd inverse = square.inverse();
    if (!inverse.allFinite()) throw Undefined("a singular Jacobian");

    std::vector<Precise> images;
    for (std::size_t s = 0; s < sought_.size(); ++s) {
      Precise value = center[sought_[s]];
      std::vector<Precise> rest(place.size());
      rest[sought_[s]] = 1.0;
      for (std::size_t e = 0; e < equations_.size(); ++e) {
        const double factor = inverse(static_cast<Index>(s), static_cast<Index>(e));
        value = value - at_center.value(equations_[e]).scaled(factor);
        for (const auto& [u, slope] : jacobian[e]) rest[u] = rest[u] - slope.scaled(factor);
      }
      for (std::size_t u = 0; u < place.size(); ++u) {
        if (!rest[u].is_zero()) value = value + rest[u] * (place[u] - center[u]);
      }
      images.push_back(value);
    }
    return images;
  }

  [[nodiscard]] bool is_exact_zero(const Place& point) const {
    const Evaluation there(system_.expressions, point);
    return std::all_of(equations_.begin(), equations_.end(),
                       [&](std::size_t e) { return there.value(e).is_zero(); });
  }

 private:
  const System& system_;
  std::vector<std::size_t> equations_;
  std::vector<std::size_t> sought_;
};

Place center_of(const Place& place) {
  Place center;
  for (const Precise& side : place) center.emplace_back(side.middle());
  return center;
}

bool lies_in(const Place& place, const Place& box) {
  return std::equal(place.begin(), place.end(), box.begin(),
                    [](const Precise& a, const Precise& b) { return a.lies_in(b); });
}

/// A place around the box whose image is inside of it has one zero, which all images of images enclose: until
/// one lies in the box. A zero that is a double in the middle of the box may be narrower than any image.
std::optional<Place> refined(const Operator& of, Place place, const Place& box) {
  const Place middle = center_of(box);
  const std::vector<Precise> image = of.image(place, middle);
  for (std::size_t u = 0; u < place.size(); ++u) {
    if (!image[u].lies_inside(place[u])) return std::nullopt;
  }
  if (lies_in(middle, box) && of.is_exact_zero(middle)) return middle;
  place = image;
  constexpr int kMostRounds = 40;  // a side around 0 may be tiny
  for (int round = 0; round < kMostRounds && !lies_in(place, box); ++round) {
    const std::vector<Precise> next = of.image(place, center_of(place));
    for (std::size_t u = 0; u < place.size(); ++u) place[u] = Precise::common(place[u], next[u]);
  }
  return lies_in(place, box) ? std::optional<Place>(place) : std::nullopt;
}

/// A box and a margin around it: a zero at its edge is inside.
Place widened(const Place& box, double least) {
  Place wider;
  for (const Precise& side : box) {
    const double margin = side.width() + 1e-11 * std::abs(side.middle()) + least;
    wider.push_back(side + Precise(-margin, margin));
  }
  return wider;
}

/// The unknowns by which the derivatives are the largest and the least alike.
std::vector<std::size_t> pivots(const System& system, const Place& box) {
  const Evaluation at(system.expressions, center_of(box));
  std::vector<Evaluation::Gradient> jacobian;
  for (const std::size_t e : system.equations()) jacobian.push_back(at.gradient(e));
  Eigen::MatrixXd middle = middle_of(jacobian, box.size());
  const auto order = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(middle).colsPermutation().indices();
  std::vector<std::size_t> chosen;
  for (Index i = 0; i < middle.rows(); ++i) chosen.push_back(static_cast<std::size_t>(order(i)));
  return chosen;
}

}  // namespace

std::optional<Place> only_zero(const System& system, const Place& box) {
  std::vector<std::size_t> all(box.size());
  for (std::size_t u = 0; u < all.size(); ++u) all[u] = u;
  const Operator krawczyk(system, all);
  for (const double least : {1e-11, 1e-14, 1e-18, 1e-24}) {
    try {
      if (auto zero = refined(krawczyk, widened(box, least), box)) return zero;
    } catch (const Undefined&) {
      continue;
    }
  }
  return std::nullopt;
}

bool has_zero_for_every(const System& system, const Place& box) {
  const std::vector<std::size_t> sought = pivots(system, box);
  try {
    const std::vector<Precise> image = Operator(system, sought).image(box, center_of(box));
    for (std::size_t s = 0; s < sought.size(); ++s) {
      if (!image[s].lies_inside(box[sought[s]])) return false;
    }
    return true;
  } catch (const Undefined&) {
    return false;
  }
}

}  // namespace hcsp::verifier
