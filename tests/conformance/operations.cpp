// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/operations.h"

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>

#include "domains/interval/numeric.h"
#include "domains/interval/reverse.h"

namespace hcsp::itl {

namespace {

using D = DecoratedInterval;
using Operands = std::vector<Value>;
using Table = std::map<std::string, Operation>;

const D& interval(const Operands& operands, std::size_t i) { return std::get<Literal>(operands.at(i)).value; }
double number(const Operands& operands, std::size_t i) { return std::get<double>(operands.at(i)); }
int integer(const Operands& operands, std::size_t i) { return static_cast<int>(number(operands, i)); }

Outcome decorated(const D& result) { return {{Literal{result, true}}}; }

Value truth(bool holds) { return Word{holds ? "true" : "false"}; }

void add_forward(Table& table) {
  const auto unary = [&](const char* name, D (*f)(const D&)) {
    table[name] = {[f](const Operands& x) { return decorated(f(interval(x, 0))); }};
  };
  const auto binary = [&](const char* name, D (*f)(const D&, const D&)) {
    table[name] = {[f](const Operands& x) { return decorated(f(interval(x, 0), interval(x, 1))); }};
  };
  const auto with_integer = [&](const char* name, D (*f)(const D&, int)) {
    table[name] = {[f](const Operands& x) { return decorated(f(interval(x, 0), integer(x, 1))); }};
  };
  unary("pos", [](const D& a) { return a; });
  unary("neg", [](const D& a) { return -a; });
  binary("add", [](const D& a, const D& b) { return a + b; });
  binary("sub", [](const D& a, const D& b) { return a - b; });
  binary("mul", [](const D& a, const D& b) { return a * b; });
  binary("div", [](const D& a, const D& b) { return a / b; });
  unary("recip", recip);
  unary("sqr", sqr);
  unary("sqrt", sqrt);
  table["fma"] = {
      [](const Operands& x) { return decorated(fma(interval(x, 0), interval(x, 1), interval(x, 2))); }};
  with_integer("pown", pown);
  with_integer("rootn", rootn);
  binary("pow", pow);
  unary("exp", exp);
  unary("exp2", exp2);
  unary("exp10", exp10);
  unary("expm1", expm1);
  unary("log", log);
  unary("log2", log2);
  unary("log10", log10);
  unary("log1p", log1p);
  unary("logp1", log1p);
  unary("sin", sin);
  unary("cos", cos);
  unary("tan", tan);
  unary("asin", asin);
  unary("acos", acos);
  unary("atan", atan);
  binary("atan2", atan2);
  unary("sinh", sinh);
  unary("cosh", cosh);
  unary("tanh", tanh);
  unary("asinh", asinh);
  unary("acosh", acosh);
  unary("atanh", atanh);
  unary("sign", sign);
  unary("ceil", ceil);
  unary("floor", floor);
  unary("trunc", trunc);
  unary("roundTiesToEven", round_ties_to_even);
  unary("roundTiesToAway", round_ties_to_away);
  unary("abs", abs);
  binary("min", min);
  binary("max", max);
}

/// Operations that are no point functions: their decoration is trv.
void add_sets_and_reverses(Table& table) {
  using I = Interval;
  const auto of_two = [&](const char* name, I (*f)(const I&, const I&), bool is_reverse) {
    table[name] = {[f](const Operands& x) { return decorated(trivially(f, interval(x, 0), interval(x, 1))); },
                   is_reverse};
  };
  of_two("intersection", intersection, false);
  of_two("convexHull", convex_hull, false);
  of_two("cancelPlus", cancel_plus, false);
  of_two("cancelMinus", cancel_minus, false);
  const auto reverse = [&](const std::string& name, I (*f)(const I&, const I&)) {
    table[name] = {[f](const Operands& x) {
                     return decorated(trivially([f](const I& c) { return f(c, {}); }, interval(x, 0)));
                   },
                   true};
    of_two((name + "Bin").c_str(), f, true);
  };
  reverse("sqrRev", sqr_rev);
  reverse("absRev", abs_rev);
  reverse("sinRev", sin_rev);
  reverse("cosRev", cos_rev);
  reverse("tanRev", tan_rev);
  reverse("coshRev", cosh_rev);
  // Of two operands and, with or without Ten or Bin in the name, of three.
  const auto reverse_of_two = [&](const std::string& name, I (*f)(const I&, const I&, const I&)) {
    for (const char* suffix : {"", "Ten", "Bin"})
      table[name + suffix] = {[f](const Operands& x) {
                                const D all(Interval::entire());
                                return decorated(trivially(f, interval(x, 0), interval(x, 1),
                                                           x.size() == 2 ? all : interval(x, 2)));
                              },
                              true};
  };
  reverse_of_two("mulRev", mul_rev);
  reverse_of_two("powRev1", pow_rev1);
  reverse_of_two("powRev2", pow_rev2);
  reverse_of_two("atan2Rev1", atan2_rev1);
  reverse_of_two("atan2Rev2", atan2_rev2);
  const auto power = [](const D& c, const D& x, int n) {
    return decorated(
        trivially([n](const I& image, const I& base) { return pown_rev(image, base, n); }, c, x));
  };
  table["pownRev"] = {
      [power](const Operands& x) { return power(interval(x, 0), D(I::entire()), integer(x, 1)); }, true};
  table["pownRevBin"] = {
      [power](const Operands& x) { return power(interval(x, 0), interval(x, 1), integer(x, 2)); }, true};
  table["mulRevToPair"] = {[](const Operands& x) {
                             const auto [first, second] = mul_rev_to_pair(interval(x, 0), interval(x, 1));
                             return Outcome{{Literal{first, true}, Literal{second, true}}};
                           },
                           true};
}

void add_numbers(Table& table) {
  const auto of_interval = [&](const char* name, double (*f)(const Interval&)) {
    table[name] = {[f](const Operands& x) {
      const D& a = interval(x, 0);
      return Outcome{{a.is_nai() ? std::numeric_limits<double>::quiet_NaN() : f(a.interval())}};
    }};
  };
  of_interval("inf", inf);
  of_interval("sup", sup);
  of_interval("mid", mid);
  of_interval("rad", rad);
  of_interval("wid", wid);
  of_interval("mag", mag);
  of_interval("mig", mig);
  table["midRad"] = {[](const Operands& x) {
    const D& a = interval(x, 0);
    return Outcome{{mid(a.interval()), rad(a.interval())}};
  }};
  const auto reduction = [&](const char* name, double (*f)(std::span<const double>)) {
    table[name] = {[f](const Operands& x) { return Outcome{{f(std::get<std::vector<double>>(x.at(0)))}}; }};
  };
  reduction("sum_nearest", sum_nearest);
  reduction("sum_abs_nearest", sum_abs_nearest);
  reduction("sum_sqr_nearest", sum_sqr_nearest);
  table["dot_nearest"] = {[](const Operands& x) {
    return Outcome{
        {dot_nearest(std::get<std::vector<double>>(x.at(0)), std::get<std::vector<double>>(x.at(1)))}};
  }};
}

const char* name_of(Overlap overlap) {
  static constexpr const char* kNames[] = {"bothEmpty", "firstEmpty",   "secondEmpty", "before",
                                           "meets",     "overlaps",     "starts",      "containedBy",
                                           "finishes",  "equals",       "finishedBy",  "contains",
                                           "startedBy", "overlappedBy", "metBy",       "after"};
  return kNames[static_cast<std::size_t>(overlap)];
}

void add_relations(Table& table) {
  const auto of_one = [&](const char* name, bool (*f)(const Interval&)) {
    table[name] = {[f](const Operands& x) {
      const D& a = interval(x, 0);
      return Outcome{{truth(!a.is_nai() && f(a.interval()))}};
    }};
  };
  const auto of_two = [&](const char* name, bool (*f)(const Interval&, const Interval&)) {
    table[name] = {[f](const Operands& x) {
      const D &a = interval(x, 0), &b = interval(x, 1);
      return Outcome{{truth(!a.is_nai() && !b.is_nai() && f(a.interval(), b.interval()))}};
    }};
  };
  of_one("isEmpty", [](const Interval& a) { return a.is_empty(); });
  of_one("isEntire", [](const Interval& a) { return a.is_entire(); });
  of_one("isSingleton", [](const Interval& a) { return a.is_point(); });
  of_one("isCommonInterval", is_common);
  table["isNaI"] = {[](const Operands& x) { return Outcome{{truth(interval(x, 0).is_nai())}}; }};
  table["isMember"] = {[](const Operands& x) {
    return Outcome{{truth(!interval(x, 1).is_nai() && is_member(number(x, 0), interval(x, 1).interval()))}};
  }};
  of_two("equal", equal);
  of_two("subset", subset);
  of_two("interior", interior);
  of_two("less", less);
  of_two("strictLess", strict_less);
  of_two("precedes", precedes);
  of_two("strictPrecedes", strict_precedes);
  of_two("disjoint", disjoint);
  table["overlap"] = {[](const Operands& x) {
    return Outcome{{Word{name_of(overlap(interval(x, 0).interval(), interval(x, 1).interval()))}}};
  }};
}

/// What a constructor gives, or `otherwise` where it throws.
template <class Construct>
Outcome constructed(Construct construct, const D& otherwise, bool is_decorated) {
  try {
    return {{Literal{D(construct()), is_decorated}}};
  } catch (const std::invalid_argument&) {
    return {{Literal{otherwise, is_decorated}}, true};
  }
}

Decoration decoration_of(const std::string& name) {
  static const std::map<std::string, Decoration> kDecorations{{"com", Decoration::com},
                                                              {"dac", Decoration::dac},
                                                              {"def", Decoration::def},
                                                              {"trv", Decoration::trv},
                                                              {"ill", Decoration::ill}};
  return kDecorations.at(name);
}

const char* name_of(Decoration d) {
  return d == Decoration::com   ? "com"
         : d == Decoration::dac ? "dac"
         : d == Decoration::def ? "def"
         : d == Decoration::trv ? "trv"
                                : "ill";
}

void add_constructors(Table& table) {
  const D none(Interval::empty());
  table["b-textToInterval"] = {[none](const Operands& x) {
    return constructed([&] { return Interval::of_text(std::get<Text>(x.at(0)).characters); }, none, false);
  }};
  table["d-textToInterval"] = {[](const Operands& x) {
    return constructed([&] { return D::of_text(std::get<Text>(x.at(0)).characters); }, D::nai(), true);
  }};
  table["b-numsToInterval"] = {[none](const Operands& x) {
    return constructed([&] { return Interval(number(x, 0), number(x, 1)); }, none, false);
  }};
  table["d-numsToInterval"] = {[](const Operands& x) {
    return constructed([&] { return Interval(number(x, 0), number(x, 1)); }, D::nai(), true);
  }};
  table["newDec"] = {[](const Operands& x) { return decorated(D(interval(x, 0).interval())); }};
  table["setDec"] = {[](const Operands& x) {
    const D result(interval(x, 0).interval(), decoration_of(std::get<Word>(x.at(1)).name));
    return Outcome{{Literal{result, true}}, result.is_nai()};
  }};
  table["intervalPart"] = {[](const Operands& x) {
    return Outcome{{Literal{D(interval(x, 0).interval()), false}}};
  }};
  table["decorationPart"] = {
      [](const Operands& x) { return Outcome{{Word{name_of(interval(x, 0).decoration())}}}; }};
}

}  // namespace

const std::map<std::string, Operation>& operations() {
  static const Table kOperations = [] {
    Table table;
    add_forward(table);
    add_sets_and_reverses(table);
    add_numbers(table);
    add_relations(table);
    add_constructors(table);
    return table;
  }();
  return kOperations;
}

}  // namespace hcsp::itl
