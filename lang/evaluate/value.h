// SPDX-License-Identifier: Apache-2.0
// What expressions evaluate to: numbers for as long as everything is known, expressions of a Problem from
// then on.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "lang/data/decimal.h"
#include "solver/expression/expr.h"

namespace hcsp::lang {

/// A scalar, or a relation.
using Term = std::variant<Number, hcsp::Expr>;

/// The components of a vector, or one term; none after an error, which has been reported.
using Value = std::vector<Term>;

/// A component of a domain; a bound that is none is infinite.
struct Bounds {
  std::optional<Term> lo;
  std::optional<Term> hi;
};

/// The components of a domain; none after an error.
using DomainValue = std::vector<Bounds>;

}  // namespace hcsp::lang
