// SPDX-License-Identifier: Apache-2.0
// The functions that the language brings along.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace hcsp::lang {

enum class BuiltIn : std::uint8_t {
  none,
  // On reals, and pointwise on tubes.
  sqr,
  sqrt,
  abs,
  exp,
  log,
  sin,
  cos,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  floor,
  ceil,
  sign,
  root,
  min,
  max,
  atan2,
  norm,
  dot,
  cross,
  // On matrices.
  det,
  inverse,
  transpose,
  zeros,
  rot,
  sum,
  prod,
  // On data.
  first,
  last,
  rows,
  hold,
  sampled,
  // On a time line with phases; hold is there, too.
  gate,
  // In constraints.
  der,
  integral,
  distance,
  disjoint,
  meets,
  subset,
  complement,
  at_least,
  // Words of the language that are not solved yet.
  unsupported,
};

struct BuiltInFunction {
  std::string_view name;
  BuiltIn id;
  std::uint8_t fewest_arguments;
  std::uint8_t most_arguments;
};

/// Every one, by name.
std::span<const BuiltInFunction> built_in_functions();
/// Null when there is none of that name.
const BuiltInFunction* find_built_in(std::string_view name);

}  // namespace hcsp::lang
