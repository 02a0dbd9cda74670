// SPDX-License-Identifier: Apache-2.0
// The functions that Minibex brings along. A declaration of the same name comes before them.
#pragma once

#include <span>
#include <string_view>

#include "lang/model/built_in.h"

namespace hcsp::lang::minibex {

struct Word {
  enum class Sense : std::uint8_t {
    scalar,       ///< a built-in function of one real
    two_scalars,  ///< of two
    extremum,     ///< of one and more
    power,
    chosen,  ///< chi(a, b, c): b where a <= 0, else c
    asinh,
    acosh,
    atanh,
    sinc,
    cross,
    trace,
    end_of_interval,
    not_supported,
  };
  std::string_view name;
  Sense sense;
  std::uint8_t fewest_arguments;
  std::uint8_t most_arguments;
  BuiltIn function = BuiltIn::none;
};

/// Every one, by name.
std::span<const Word> words();
/// Null when there is none of that name.
const Word* find_word(std::string_view name);

}  // namespace hcsp::lang::minibex
