// SPDX-License-Identifier: Apache-2.0
// Random relations c(x, a) over every operator, each built twice: as an expression for hcsp, and as a plain
// function of points that is evaluated in three-valued logic.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "examples/slam_worlds.h"
#include "solver/expression/expr.h"

namespace hcsp::soundness {

enum class Truth : std::uint8_t { no, yes, unsure };

/// Where a term or relation is evaluated.
struct Place {
  std::vector<Interval> x, a;  // points, or enclosures of points
};

/// A term's value at a place, and whether it is defined there.
struct TermValue {
  Interval value;
  Truth defined;
};

struct Term {
  Expr expression;
  std::function<TermValue(const Place&)> at;
};

struct Relation {
  Expr expression;
  std::function<Truth(const Place&)> at;
};

class RandomRelations {
 public:
  RandomRelations(std::uint64_t seed, VectorExpr x, VectorExpr a)
      : random_(seed), x_(std::move(x)), a_(std::move(a)) {}
  Term term(int depth);
  Relation relation(int depth);

 private:
  Term leaf();
  slam_simulator::Random random_;
  VectorExpr x_, a_;
};

Truth operator!(Truth a);
Truth operator&&(Truth a, Truth b);

/// The relations of two terms, and the conjunction and negation of relations, of both kinds at once.
Relation relate(int which, const Term& a, const Term& b);
Relation operator&&(const Relation& a, const Relation& b);
Relation operator!(const Relation& a);
/// At least so many of the relations hold.
Relation count(int least, const std::vector<Relation>& relations);

}  // namespace hcsp::soundness
