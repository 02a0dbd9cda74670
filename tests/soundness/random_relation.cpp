// SPDX-License-Identifier: Apache-2.0
#include "tests/soundness/random_relation.h"

#include "domains/interval/functions.h"
#include "domains/interval/numeric.h"

namespace hcsp::soundness {

Truth operator!(Truth a) { return a == Truth::unsure ? a : (a == Truth::yes ? Truth::no : Truth::yes); }
Truth operator&&(Truth a, Truth b) {
  if (a == Truth::no || b == Truth::no) return Truth::no;
  return a == Truth::yes && b == Truth::yes ? Truth::yes : Truth::unsure;
}

namespace {

Truth operator||(Truth a, Truth b) { return !(!a && !b); }
Truth truth(bool certain, bool impossible) {
  return certain ? Truth::yes : (impossible ? Truth::no : Truth::unsure);
}

Truth holds(int which, const Interval& a, const Interval& b) {
  switch (which) {
    case 0:
      return truth(a.hi() < b.lo(), a.lo() >= b.hi());
    case 1:
      return truth(a.hi() <= b.lo(), a.lo() > b.hi());
    case 2:
      return truth(a.lo() > b.hi(), a.hi() <= b.lo());
    case 3:
      return truth(a.lo() >= b.hi(), a.hi() < b.lo());
    case 4:
      return truth(a.is_point() && a == b, meet(a, b).is_empty());
    default:
      return truth(meet(a, b).is_empty(), a.is_point() && a == b);
  }
}

Term unary(int which, const Term& a) {
  const auto expression = [&] {
    switch (which) {
      case 0:
        return -a.expression;
      case 1:
        return sqr(a.expression);
      case 2:
        return sqrt(a.expression);
      case 3:
        return abs(a.expression);
      case 4:
        return sin(a.expression);
      default:
        return cos(a.expression);
    }
  };
  return {expression(), [which, f = a.at](const Place& place) -> TermValue {
            const auto [value, defined] = f(place);
            if (value.is_empty()) return {value, Truth::no};
            switch (which) {
              case 0:
                return {-value, defined};
              case 1:
                return {sqr(value), defined};
              case 2:
                return {sqrt(value), defined && truth(value.lo() >= 0, value.hi() < 0)};
              case 3:
                return {abs(value), defined};
              case 4:
                return {sin(value), defined};
              default:
                return {cos(value), defined};
            }
          }};
}

Term elementary(int which, const Term& a) {
  using Unary = TermValue (*)(const Interval&);
  struct Function {
    Expr (*of_expression)(Expr);
    Unary of_value;
  };
  static const Function kFunctions[] = {
      {[](Expr e) { return exp(e); },
       [](const Interval& v) {
         return TermValue{exp(v), Truth::yes};
       }},
      {[](Expr e) { return log(e); },
       [](const Interval& v) {
         return TermValue{log(v), truth(v.lo() > 0, v.hi() <= 0)};
       }},
      {[](Expr e) { return atan(e); },
       [](const Interval& v) {
         return TermValue{atan(v), Truth::yes};
       }},
      {[](Expr e) { return tanh(e); },
       [](const Interval& v) {
         return TermValue{tanh(v), Truth::yes};
       }},
      {[](Expr e) { return asin(e); },
       [](const Interval& v) {
         return TermValue{asin(v), truth(v.mag() <= 1, mig(v) > 1)};
       }},
      {[](Expr e) { return pown(e, 3); },
       [](const Interval& v) {
         return TermValue{pown(v, 3), Truth::yes};
       }},
      {[](Expr e) { return pown(e, -1); },
       [](const Interval& v) {
         return TermValue{pown(v, -1), truth(!v.contains(0), v == Interval(0))};
       }},
      {[](Expr e) { return root(e, 3); },
       [](const Interval& v) {
         return TermValue{rootn(v, 3), Truth::yes};
       }},
      {[](Expr e) { return floor(e); },
       [](const Interval& v) {
         return TermValue{floor(v), Truth::yes};
       }},
  };
  const Function& function = kFunctions[which];
  return {function.of_expression(a.expression), [function, f = a.at](const Place& place) -> TermValue {
            const auto [value, defined] = f(place);
            if (value.is_empty()) return {Interval::empty(), Truth::no};
            const TermValue image = function.of_value(value);
            return {image.value, defined && image.defined};
          }};
}

Term binary(int which, const Term& a, const Term& b) {
  const auto expression = [&] {
    switch (which) {
      case 0:
        return a.expression + b.expression;
      case 1:
        return a.expression - b.expression;
      case 2:
        return a.expression * b.expression;
      case 3:
        return a.expression / b.expression;
      case 4:
        return min(a.expression, b.expression);
      case 5:
        return max(a.expression, b.expression);
      default:
        return atan2(a.expression, b.expression);
    }
  };
  return {
      expression(), [which, f = a.at, g = b.at](const Place& place) -> TermValue {
        const auto [v, v_defined] = f(place);
        const auto [w, w_defined] = g(place);
        const Truth both = v_defined && w_defined;
        if (v.is_empty() || w.is_empty()) return {Interval::empty(), Truth::no};
        const Interval zero(0.0);
        switch (which) {
          case 0:
            return {v + w, both};
          case 1:
            return {v - w, both};
          case 2:
            return {v * w, both};
          case 3:
            return {v / w, both && !truth(w == zero, !w.contains(0))};
          case 4:
            return {min(v, w), both};
          case 5:
            return {max(v, w), both};
          default:
            return {atan2(v, w), both && !truth(v == zero && w == zero, !v.contains(0) || !w.contains(0))};
        }
      }};
}

Term choice(const Relation& condition, const Term& a, const Term& b) {
  return {if_then_else(condition.expression, a.expression, b.expression),
          [c = condition.at, f = a.at, g = b.at](const Place& place) -> TermValue {
            const Truth taken = c(place);
            const TermValue v = f(place), w = g(place);
            if (taken == Truth::yes) return v;
            if (taken == Truth::no) return w;
            return {join(v.value, w.value), v.defined == w.defined ? v.defined : Truth::unsure};
          }};
}

}  // namespace

Relation relate(int which, const Term& a, const Term& b) {
  const auto expression = [&] {
    switch (which) {
      case 0:
        return a.expression < b.expression;
      case 1:
        return a.expression <= b.expression;
      case 2:
        return a.expression > b.expression;
      case 3:
        return a.expression >= b.expression;
      case 4:
        return a.expression == b.expression;
      default:
        return a.expression != b.expression;
    }
  };
  return {expression(), [which, f = a.at, g = b.at](const Place& place) {
            const TermValue v = f(place), w = g(place);
            const Truth defined = v.defined && w.defined;
            return defined == Truth::no ? Truth::no : defined && holds(which, v.value, w.value);
          }};
}

Relation operator&&(const Relation& a, const Relation& b) {
  return {a.expression && b.expression,
          [f = a.at, g = b.at](const Place& place) { return f(place) && g(place); }};
}

Relation count(int least, const std::vector<Relation>& relations) {
  std::vector<Expr> expressions;
  for (const Relation& relation : relations) expressions.push_back(relation.expression);
  return {at_least(static_cast<std::size_t>(least), expressions), [=](const Place& place) {
            int surely = 0, possibly = 0;
            for (const Relation& relation : relations) {
              const Truth holds = relation.at(place);
              surely += holds == Truth::yes ? 1 : 0;
              possibly += holds != Truth::no ? 1 : 0;
            }
            return surely >= least ? Truth::yes : (possibly < least ? Truth::no : Truth::unsure);
          }};
}

Relation operator!(const Relation& a) {
  return {!a.expression, [f = a.at](const Place& place) { return !f(place); }};
}

Term RandomRelations::leaf() {
  const int kind = random_.integer(0, 4);
  const std::size_t i = random_.chance(0.5) ? 1 : 0;
  if (kind <= 1 && !x_.empty())
    return {x_[i], [i](const Place& place) { return TermValue{place.x[i], Truth::yes}; }};
  if (kind <= 3 && !a_.empty())
    return {a_[i], [i](const Place& place) { return TermValue{place.a[i], Truth::yes}; }};
  const double number = random_.chance(0.3) ? random_.integer(-2, 2) : random_.in(-3, 3);
  Dag& dag = (x_.empty() ? a_ : x_)[0].dag();
  return {Expr(dag, dag.constant(number)), [number](const Place&) { return TermValue{number, Truth::yes}; }};
}

Term RandomRelations::term(int depth) {
  if (depth == 0 || random_.chance(0.15)) return leaf();
  const int kind = random_.integer(0, 16);
  if (kind <= 5) return unary(kind, term(depth - 1));
  if (kind >= 15) return elementary(random_.integer(0, 8), term(depth - 1));
  if (kind <= 12) {
    const Term first = term(depth - 1);
    return binary(kind - 6, first, random_.chance(0.15) ? first : term(depth - 1));
  }
  if (kind == 13) return choice(relation(depth - 1), term(depth - 1), term(depth - 1));
  return binary(random_.integer(0, 2), term(depth - 1), term(depth - 1));
}

Relation RandomRelations::relation(int depth) {
  const int kind = depth == 0 ? 10 : random_.integer(0, 10);
  if (kind == 0) return !relation(depth - 1);
  if (kind <= 2) return relation(depth - 1) && relation(depth - 1);
  if (kind == 3) {
    const Relation a = relation(depth - 1), b = relation(depth - 1);
    return {a.expression || b.expression,
            [f = a.at, g = b.at](const Place& place) { return f(place) || g(place); }};
  }
  if (kind == 4) return count(random_.integer(1, 3), {relation(depth - 1), relation(depth - 1), relation(0)});
  const Term a = term(depth), b = term(depth > 0 ? depth - 1 : 0);
  return relate(random_.chance(0.15) ? random_.integer(4, 5) : random_.integer(0, 3), a, b);
}

}  // namespace hcsp::soundness
