// SPDX-License-Identifier: Apache-2.0
#include "lang/model/built_in.h"

#include <algorithm>
#include <array>

namespace hcsp::lang {

namespace {

constexpr std::uint8_t kAny = 255;

constexpr std::array kFunctions{
    BuiltInFunction{"abs", BuiltIn::abs, 1, 1},
    BuiltInFunction{"acos", BuiltIn::acos, 1, 1},
    BuiltInFunction{"asin", BuiltIn::asin, 1, 1},
    BuiltInFunction{"atan", BuiltIn::atan, 1, 1},
    BuiltInFunction{"atan2", BuiltIn::atan2, 2, 2},
    BuiltInFunction{"atleast", BuiltIn::at_least, 2, 2},
    BuiltInFunction{"ceil", BuiltIn::ceil, 1, 1},
    BuiltInFunction{"complement", BuiltIn::complement, 1, 1},
    BuiltInFunction{"cos", BuiltIn::cos, 1, 1},
    BuiltInFunction{"cosh", BuiltIn::cosh, 1, 1},
    BuiltInFunction{"cross", BuiltIn::cross, 2, 2},
    BuiltInFunction{"der", BuiltIn::der, 1, 1},
    BuiltInFunction{"det", BuiltIn::det, 1, 1},
    BuiltInFunction{"disjoint", BuiltIn::disjoint, 2, 2},
    BuiltInFunction{"distance", BuiltIn::distance, 2, 2},
    BuiltInFunction{"dot", BuiltIn::dot, 2, 2},
    BuiltInFunction{"exp", BuiltIn::exp, 1, 1},
    BuiltInFunction{"first", BuiltIn::first, 1, 1},
    BuiltInFunction{"floor", BuiltIn::floor, 1, 1},
    BuiltInFunction{"gate", BuiltIn::gate, 1, 1},
    BuiltInFunction{"hold", BuiltIn::hold, 1, 2},
    BuiltInFunction{"image", BuiltIn::unsupported, 1, kAny},
    BuiltInFunction{"integral", BuiltIn::integral, 3, 3},
    BuiltInFunction{"inverse", BuiltIn::inverse, 1, 1},
    BuiltInFunction{"last", BuiltIn::last, 1, 1},
    BuiltInFunction{"log", BuiltIn::log, 1, 1},
    BuiltInFunction{"max", BuiltIn::max, 1, kAny},
    BuiltInFunction{"meets", BuiltIn::meets, 2, 2},
    BuiltInFunction{"min", BuiltIn::min, 1, kAny},
    BuiltInFunction{"norm", BuiltIn::norm, 1, 1},
    BuiltInFunction{"prod", BuiltIn::prod, 1, 1},
    BuiltInFunction{"root", BuiltIn::root, 2, 2},
    BuiltInFunction{"rot", BuiltIn::rot, 1, 2},
    BuiltInFunction{"rows", BuiltIn::rows, 1, 1},
    BuiltInFunction{"sampled", BuiltIn::sampled, 2, 3},
    BuiltInFunction{"sign", BuiltIn::sign, 1, 1},
    BuiltInFunction{"sin", BuiltIn::sin, 1, 1},
    BuiltInFunction{"sinh", BuiltIn::sinh, 1, 1},
    BuiltInFunction{"sqr", BuiltIn::sqr, 1, 1},
    BuiltInFunction{"sqrt", BuiltIn::sqrt, 1, 1},
    BuiltInFunction{"subset", BuiltIn::subset, 2, 2},
    BuiltInFunction{"sum", BuiltIn::sum, 1, 1},
    BuiltInFunction{"tan", BuiltIn::tan, 1, 1},
    BuiltInFunction{"tanh", BuiltIn::tanh, 1, 1},
    BuiltInFunction{"transpose", BuiltIn::transpose, 1, 1},
    BuiltInFunction{"volume", BuiltIn::unsupported, 1, 1},
    BuiltInFunction{"zeros", BuiltIn::zeros, 1, 2},
};

}  // namespace

std::span<const BuiltInFunction> built_in_functions() { return kFunctions; }

const BuiltInFunction* find_built_in(std::string_view name) {
  const auto found =
      std::find_if(kFunctions.begin(), kFunctions.end(), [&](const auto& f) { return f.name == name; });
  return found == kFunctions.end() ? nullptr : &*found;
}

}  // namespace hcsp::lang
