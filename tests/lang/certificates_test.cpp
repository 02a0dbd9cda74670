// SPDX-License-Identifier: Apache-2.0
// A second opinion on the certificates of models/gallery: the systems written down once more, interval
// arithmetic of MPFR, derivatives by forward differentiation, and Krawczyk's test (1969); nothing of the
// solver takes part but its answers. Every unique box is proven to hold one solution, and no two hold the
// same.
#include <gtest/gtest.h>
#include <mpfr.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <memory>

#include "corpus.h"

namespace hcsp::lang {
namespace {

constexpr mpfr_prec_t kBits = 160;

/// An interval of MPFR numbers.
class Precise {
 public:
  Precise(double x = 0.0) : Precise(x, x) {}  // NOLINT(google-explicit-constructor): a double is a point
  Precise(double lower, double upper) {
    mpfr_init2(lo_, kBits);
    mpfr_init2(hi_, kBits);
    mpfr_set_d(lo_, lower, MPFR_RNDD);
    mpfr_set_d(hi_, upper, MPFR_RNDU);
  }
  Precise(const Precise& other) : Precise() { *this = other; }
  Precise& operator=(const Precise& other) {
    mpfr_set(lo_, other.lo_, MPFR_RNDD);
    mpfr_set(hi_, other.hi_, MPFR_RNDU);
    return *this;
  }
  ~Precise() {
    mpfr_clear(lo_);
    mpfr_clear(hi_);
  }

  friend Precise operator+(const Precise& a, const Precise& b) {
    Precise sum;
    mpfr_add(sum.lo_, a.lo_, b.lo_, MPFR_RNDD);
    mpfr_add(sum.hi_, a.hi_, b.hi_, MPFR_RNDU);
    return sum;
  }
  friend Precise operator-(const Precise& a, const Precise& b) {
    Precise difference;
    mpfr_sub(difference.lo_, a.lo_, b.hi_, MPFR_RNDD);
    mpfr_sub(difference.hi_, a.hi_, b.lo_, MPFR_RNDU);
    return difference;
  }
  friend Precise operator*(const Precise& a, const Precise& b) {
    Precise product, part;
    bool first = true;
    for (const auto* x : {&a.lo_, &a.hi_}) {
      for (const auto* y : {&b.lo_, &b.hi_}) {
        mpfr_mul(part.lo_, *x, *y, MPFR_RNDD);
        mpfr_mul(part.hi_, *x, *y, MPFR_RNDU);
        if (first || mpfr_less_p(part.lo_, product.lo_) != 0) mpfr_set(product.lo_, part.lo_, MPFR_RNDD);
        if (first || mpfr_greater_p(part.hi_, product.hi_) != 0) mpfr_set(product.hi_, part.hi_, MPFR_RNDU);
        first = false;
      }
    }
    return product;
  }
  [[nodiscard]] Precise over(long divisor) const {
    Precise quotient;
    mpfr_div_si(quotient.lo_, lo_, divisor, MPFR_RNDD);
    mpfr_div_si(quotient.hi_, hi_, divisor, MPFR_RNDU);
    return quotient;
  }
  friend Precise exp(const Precise& a) {
    Precise image;
    mpfr_exp(image.lo_, a.lo_, MPFR_RNDD);
    mpfr_exp(image.hi_, a.hi_, MPFR_RNDU);
    return image;
  }
  /// By the value in the middle and the slope, which is at most 1.
  friend Precise sin(const Precise& a) { return around_middle(a, mpfr_sin); }
  friend Precise cos(const Precise& a) { return around_middle(a, mpfr_cos); }

  [[nodiscard]] double middle() const {
    return 0.5 * mpfr_get_d(lo_, MPFR_RNDN) + 0.5 * mpfr_get_d(hi_, MPFR_RNDN);
  }
  [[nodiscard]] bool lies_inside(const Precise& other) const {
    return mpfr_greater_p(lo_, other.lo_) != 0 && mpfr_less_p(hi_, other.hi_) != 0;
  }
  [[nodiscard]] bool lies_in(const Interval& other) const {
    return mpfr_cmp_d(lo_, other.lo()) >= 0 && mpfr_cmp_d(hi_, other.hi()) <= 0;
  }
  /// The middle as a point.
  [[nodiscard]] Precise center() const {
    Precise middle;
    mpfr_add(middle.lo_, lo_, hi_, MPFR_RNDN);
    mpfr_div_2ui(middle.lo_, middle.lo_, 1, MPFR_RNDN);
    mpfr_set(middle.hi_, middle.lo_, MPFR_RNDN);
    return middle;
  }

 private:
  template <class Function>
  static Precise around_middle(const Precise& a, Function function) {
    const Precise middle = a.center();
    Precise value;
    function(value.lo_, middle.lo_, MPFR_RNDD);
    function(value.hi_, middle.hi_, MPFR_RNDU);
    return value + (a - middle) * Precise(-1.0, 1.0);
  }
  mpfr_t lo_, hi_;
};

/// A value with its gradient.
struct Dual {
  Precise value;
  std::vector<Precise> slopes;

  Dual(Precise of = 0.0, std::vector<Precise> with = {})  // NOLINT(google-explicit-constructor): a constant
      : value(std::move(of)), slopes(std::move(with)) {}
  Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] Dual chained(const Precise& image, const Precise& slope) const {
    Dual result(image, slopes);
    for (Precise& each : result.slopes) each = each * slope;
    return result;
  }
  [[nodiscard]] Dual over(long divisor) const {
    return chained(value.over(divisor), Precise(1.0).over(divisor));
  }
};

Dual combined(Precise value, const Dual& a, const Precise& by_a, const Dual& b, const Precise& by_b) {
  Dual result(std::move(value), std::vector<Precise>(std::max(a.slopes.size(), b.slopes.size())));
  for (std::size_t i = 0; i < a.slopes.size(); ++i) result.slopes[i] = a.slopes[i] * by_a;
  for (std::size_t i = 0; i < b.slopes.size(); ++i) result.slopes[i] = result.slopes[i] + b.slopes[i] * by_b;
  return result;
}
Dual operator+(const Dual& a, const Dual& b) { return combined(a.value + b.value, a, 1.0, b, 1.0); }
Dual operator-(const Dual& a, const Dual& b) { return combined(a.value - b.value, a, 1.0, b, -1.0); }
Dual operator*(const Dual& a, const Dual& b) { return combined(a.value * b.value, a, b.value, b, a.value); }
Dual exp(const Dual& a) { return a.chained(exp(a.value), exp(a.value)); }
Dual sin(const Dual& a) { return a.chained(sin(a.value), cos(a.value)); }
Dual power(const Dual& a, int n) {
  Dual result = 1.0;
  for (int i = 0; i < n; ++i) result = result * a;
  return result;
}
Dual sum(const std::vector<Dual>& x) {
  Dual total = 0.0;
  for (const Dual& each : x) total = total + each;
  return total;
}

using Equations = std::vector<Dual>;
using Unknowns = std::vector<Dual>;
using Writer = Equations (*)(const Unknowns& x);

Equations broyden_tridiagonal(const Unknowns& x) {
  Equations f;
  for (std::size_t i = 0; i < x.size(); ++i) {
    f.push_back((3.0 - 2.0 * x[i]) * x[i] + 1.0);
    if (i > 0) f.back() = f.back() - x[i - 1];
    if (i + 1 < x.size()) f.back() = f.back() - 2.0 * x[i + 1];
  }
  return f;
}

Equations broyden_banded(const Unknowns& x) {
  Equations f;
  for (std::size_t i = 0; i < x.size(); ++i) {
    f.push_back(x[i] * (2.0 + 5.0 * x[i] * x[i]) + 1.0);
    for (std::size_t j = i < 5 ? 0 : i - 5; j <= std::min(i + 1, x.size() - 1); ++j) {
      if (j != i) f.back() = f.back() - x[j] * (1.0 + x[j]);
    }
  }
  return f;
}

Equations brown(const Unknowns& x) {
  Equations f;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i + 1 < x.size(); ++i) f.push_back(x[i] + sum(x) - (n + 1));
  Dual product = 1.0;
  for (const Dual& each : x) product = product * each;
  f.push_back(product - 1.0);
  return f;
}

Equations more_cosnard(const Unknowns& x) {
  Equations f;
  const long n = static_cast<long>(x.size()), m = n + 1;
  const auto t = [m](long i) { return Dual(static_cast<double>(i)).over(m); };
  const auto cube = [&](long j) { return power(x[static_cast<std::size_t>(j - 1)] + t(j) + 1.0, 3); };
  for (long i = 1; i <= n; ++i) {
    Dual before = 0.0, after = 0.0;
    for (long j = 1; j <= i; ++j) before = before + t(j) * cube(j);
    for (long j = i + 1; j <= n; ++j) after = after + (1.0 - t(j)) * cube(j);
    f.push_back(x[static_cast<std::size_t>(i - 1)] + ((1.0 - t(i)) * before + t(i) * after).over(2 * m));
  }
  return f;
}

Equations caprasse(const Unknowns& u) {
  const Dual &x = u[0], &y = u[1], &z = u[2], &t = u[3];
  return {y * y * z + 2.0 * x * y * t - 2.0 * x - z,
          4.0 * x * y * y * z - x * x * x * z + 4.0 * x * x * y * t + 2.0 * y * y * y * t + 4.0 * x * x -
              10.0 * y * y + 4.0 * x * z - 10.0 * y * t + 2.0,
          2.0 * y * z * t + x * t * t - x - 2.0 * z,
          4.0 * y * z * z * t - x * z * z * z + 4.0 * x * z * t * t + 2.0 * y * t * t * t + 4.0 * x * z +
              4.0 * z * z - 10.0 * y * t - 10.0 * t * t + 2.0};
}

Equations bronstein(const Unknowns& u) {
  return {u[0] * u[0] + u[1] * u[1] + u[2] * u[2] - 36.0, u[0] + u[1] - u[2],
          u[0] * u[1] + u[2] * u[2] - 1.0};
}

Equations wright(const Unknowns& x) {
  Equations f;
  for (const Dual& each : x) f.push_back(each * each - each + sum(x) - 10.0);
  return f;
}

Equations freudenstein_roth(const Unknowns& u) {
  Equations f;
  const std::size_t n = u.size() / 2;
  for (std::size_t i = 0; i < n; ++i) {
    const Dual &x = u[i], &y = u[n + i];
    f.push_back(x - 13.0 + ((5.0 - y) * y - 2.0) * y);
    f.push_back(x - 29.0 + ((y + 1.0) * y - 14.0) * y);
  }
  return f;
}

Equations trigexp(const Unknowns& x) {
  Equations f;
  const std::size_t n = x.size();
  for (std::size_t i = 0; i < n; ++i) {
    Dual e = 0.0;
    if (i + 1 < n)
      e = 3.0 * power(x[i], 3) + 2.0 * x[i + 1] - 5.0 + sin(x[i] - x[i + 1]) * sin(x[i] + x[i + 1]);
    if (i > 0) e = e + 4.0 * x[i] - x[i - 1] * exp(x[i - 1] - x[i]) - 3.0;
    f.push_back(e);
  }
  return f;
}

Equations bratu(const Unknowns& u) {
  Equations f;
  const long m = static_cast<long>(u.size()) + 1;
  for (std::size_t i = 0; i < u.size(); ++i) {
    f.push_back(exp(u[i]).over(m * m) - 2.0 * u[i]);
    if (i > 0) f.back() = f.back() + u[i - 1];
    if (i + 1 < u.size()) f.back() = f.back() + u[i + 1];
  }
  return f;
}

Equations katsura(const Unknowns& u) {
  Equations f{2.0 * sum(u) - u[0] - 1.0};
  const long n = static_cast<long>(u.size()) - 1;
  for (long m = 0; m < n; ++m) {
    Dual total = 0.0;
    for (long i = m - n; i <= n; ++i)
      total = total + u[static_cast<std::size_t>(std::abs(i))] * u[static_cast<std::size_t>(std::abs(m - i))];
    f.push_back(total - u[static_cast<std::size_t>(m)]);
  }
  return f;
}

Equations cyclic(const Unknowns& x) {
  Equations f;
  const std::size_t n = x.size();
  for (std::size_t k = 1; k <= n; ++k) {
    Dual total = 0.0;
    for (std::size_t i = 0; i < (k == n ? 1 : n); ++i) {
      Dual product = 1.0;
      for (std::size_t j = 0; j < k; ++j) product = product * x[(i + j) % n];
      total = total + product;
    }
    f.push_back(k == n ? total - 1.0 : total);
  }
  return f;
}

Equations economics(const Unknowns& x) {
  Equations f;
  const std::size_t n = x.size();
  Dual total = 1.0;
  for (std::size_t k = 1; k < n; ++k) {
    Dual inner = x[k - 1];
    for (std::size_t i = 1; i + k < n; ++i) inner = inner + x[i - 1] * x[i + k - 1];
    f.push_back(inner * x[n - 1] - static_cast<double>(k));
    total = total + x[k - 1];
  }
  f.push_back(total);
  return f;
}

Equations reimer(const Unknowns& x) {
  Equations f;
  for (int k = 2; k <= static_cast<int>(x.size()) + 1; ++k) {
    Dual total = -1.0;
    for (std::size_t i = 0; i < x.size(); ++i) total = total + (i % 2 == 0 ? 2.0 : -2.0) * power(x[i], k);
    f.push_back(total);
  }
  return f;
}

Equations yamamura(const Unknowns& x) {
  Equations f;
  Dual cubes = 0.0;
  for (const Dual& each : x) cubes = cubes + power(each, 3);
  for (std::size_t i = 0; i < x.size(); ++i)
    f.push_back(2.0 * static_cast<double>(x.size()) * x[i] - cubes - static_cast<double>(i + 1));
  return f;
}

/// The box of a solution, unknown by unknown.
std::vector<Interval> box_of(const Solution& solution) {
  std::vector<Interval> box;
  for (const ResultVariable& variable : solution.variables) {
    if (const auto* real = std::get_if<Interval>(&variable.domain)) box.push_back(*real);
    if (const auto* vector = std::get_if<Box>(&variable.domain))
      box.insert(box.end(), vector->components().begin(), vector->components().end());
  }
  return box;
}

/// Whether a box holds exactly one zero: Krawczyk's operator maps a box a little larger into its interior,
/// and, again and again, to something that lies within.
bool holds_one(Writer write, const std::vector<Interval>& box) {
  const std::size_t n = box.size();
  const auto at = [](std::size_t i) { return static_cast<Eigen::Index>(i); };
  std::vector<Precise> x;
  for (const Interval& side : box) {
    const double margin = (side.hi() - side.lo()) + 1e-11 * std::max(1.0, std::abs(side.hi()));
    x.emplace_back(side.lo() - margin, side.hi() + margin);
  }
  const auto evaluate = [&](const std::vector<Precise>& place) {
    Unknowns unknowns;
    for (std::size_t v = 0; v < n; ++v) {
      unknowns.emplace_back(place[v], std::vector<Precise>(n));
      unknowns.back().slopes[v] = 1.0;
    }
    return write(unknowns);
  };
  constexpr int kMostRounds = 40;  // a side around 0 may be tiny
  for (int round = 0; round < kMostRounds; ++round) {
    std::vector<Precise> center;
    for (const Precise& side : x) center.push_back(side.center());
    const Equations over = evaluate(x), middle = evaluate(center);
    if (over.size() != n) return false;
    Eigen::MatrixXd jacobian(at(n), at(n));
    for (std::size_t e = 0; e < n; ++e) {
      for (std::size_t v = 0; v < n; ++v) jacobian(at(e), at(v)) = over[e].slopes[v].middle();
    }
    const Eigen::MatrixXd inverse = jacobian.inverse();
    std::vector<Precise> image;
    for (std::size_t v = 0; v < n; ++v) {
      Precise value = center[v];
      std::vector<Precise> rest(n);
      rest[v] = 1.0;
      for (std::size_t e = 0; e < n; ++e) {
        const Precise factor = inverse(at(v), at(e));
        value = value - factor * middle[e].value;
        for (std::size_t u = 0; u < n; ++u) rest[u] = rest[u] - factor * over[e].slopes[u];
      }
      for (std::size_t u = 0; u < n; ++u) value = value + rest[u] * (x[u] - center[u]);
      image.push_back(value);
    }
    bool within = true;
    for (std::size_t v = 0; v < n; ++v) {
      if (round == 0 && !image[v].lies_inside(x[v])) return false;
      within = within && image[v].lies_in(box[v]);
    }
    if (within) return true;
    x = image;
  }
  return false;
}

TEST(Certificates, AreConfirmedByASecondVerifier) {
  const std::map<std::string, Writer> systems = {
      {"broyden_tridiagonal", broyden_tridiagonal},
      {"broyden_banded", broyden_banded},
      {"brown", brown},
      {"more_cosnard", more_cosnard},
      {"caprasse", caprasse},
      {"bronstein", bronstein},
      {"wright", wright},
      {"freudenstein_roth", freudenstein_roth},
      {"trigexp", trigexp},
      {"bratu", bratu},
      {"katsura", katsura},
      {"cyclic", cyclic},
      {"economics", economics},
      {"reimer", reimer},
      {"yamamura", yamamura},
      {"powell_singular", nullptr},  // without certificates
  };
  for (const auto& path : models_in(std::filesystem::path(HCSP_SOURCE_DIR) / "models/gallery")) {
    SCOPED_TRACE(path.stem().string());
    const Compilation compilation = compile_file(path.string());
    ASSERT_TRUE(compilation.model.has_value());
    const Result result = compilation.model->problem->solve_all();
    std::vector<std::vector<Interval>> proven;
    for (const Solution& solution : result.search->solutions) {
      if (solution.certificate != Certificate::unique) continue;
      proven.push_back(box_of(solution));
      EXPECT_TRUE(holds_one(systems.at(path.stem().string()), proven.back()));
    }
    for (std::size_t i = 0; i < proven.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) {
        bool apart = false;
        for (std::size_t v = 0; v < proven[i].size(); ++v)
          apart = apart || meet(proven[i][v], proven[k][v]).is_empty();
        EXPECT_TRUE(apart) << "boxes " << k << " and " << i << " may hold the same solution";
      }
    }
  }
}

}  // namespace
}  // namespace hcsp::lang
