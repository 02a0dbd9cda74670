// SPDX-License-Identifier: Apache-2.0
#include "lang/minibex/words.h"

#include <algorithm>
#include <array>

namespace hcsp::lang::minibex {

namespace {

using Sense = Word::Sense;
constexpr std::uint8_t kAny = 255;

// By name.
constexpr std::array kWords{
    Word{"abs", Sense::scalar, 1, 1, BuiltIn::abs},
    Word{"acos", Sense::scalar, 1, 1, BuiltIn::acos},
    Word{"acosh", Sense::acosh, 1, 1},
    Word{"arccos", Sense::scalar, 1, 1, BuiltIn::acos},
    Word{"arccosh", Sense::acosh, 1, 1},
    Word{"arcsin", Sense::scalar, 1, 1, BuiltIn::asin},
    Word{"arcsinh", Sense::asinh, 1, 1},
    Word{"arctan", Sense::scalar, 1, 1, BuiltIn::atan},
    Word{"arctan2", Sense::two_scalars, 2, 2, BuiltIn::atan2},
    Word{"arctanh", Sense::atanh, 1, 1},
    Word{"asin", Sense::scalar, 1, 1, BuiltIn::asin},
    Word{"asinh", Sense::asinh, 1, 1},
    Word{"atan", Sense::scalar, 1, 1, BuiltIn::atan},
    Word{"atan2", Sense::two_scalars, 2, 2, BuiltIn::atan2},
    Word{"atanh", Sense::atanh, 1, 1},
    Word{"atanhc", Sense::not_supported, 1, 1},
    Word{"atanhccc", Sense::not_supported, 1, 1},
    Word{"ceil", Sense::scalar, 1, 1, BuiltIn::ceil},
    Word{"chi", Sense::chosen, 3, 3},
    Word{"cos", Sense::scalar, 1, 1, BuiltIn::cos},
    Word{"cosh", Sense::scalar, 1, 1, BuiltIn::cosh},
    Word{"cross", Sense::cross, 2, 2},
    Word{"diff", Sense::not_supported, 2, kAny},
    Word{"exp", Sense::scalar, 1, 1, BuiltIn::exp},
    Word{"floor", Sense::scalar, 1, 1, BuiltIn::floor},
    Word{"inf", Sense::end_of_interval, 1, 1},
    Word{"ln", Sense::scalar, 1, 1, BuiltIn::log},
    Word{"log", Sense::scalar, 1, 1, BuiltIn::log},
    Word{"max", Sense::extremum, 1, kAny, BuiltIn::max},
    Word{"mid", Sense::end_of_interval, 1, 1},
    Word{"min", Sense::extremum, 1, kAny, BuiltIn::min},
    Word{"pow", Sense::power, 2, 2},
    Word{"sign", Sense::scalar, 1, 1, BuiltIn::sign},
    Word{"sin", Sense::scalar, 1, 1, BuiltIn::sin},
    Word{"sinc", Sense::sinc, 1, 1},
    Word{"sinh", Sense::scalar, 1, 1, BuiltIn::sinh},
    Word{"sqr", Sense::scalar, 1, 1, BuiltIn::sqr},
    Word{"sqrt", Sense::scalar, 1, 1, BuiltIn::sqrt},
    Word{"sup", Sense::end_of_interval, 1, 1},
    Word{"tan", Sense::scalar, 1, 1, BuiltIn::tan},
    Word{"tanh", Sense::scalar, 1, 1, BuiltIn::tanh},
    Word{"trace", Sense::trace, 1, 1},
};
static_assert(std::is_sorted(kWords.begin(), kWords.end(),
                             [](const Word& a, const Word& b) { return a.name < b.name; }));

}  // namespace

std::span<const Word> words() { return kWords; }

const Word* find_word(std::string_view name) {
  const auto* found =
      std::lower_bound(kWords.begin(), kWords.end(), name,
                       [](const Word& word, std::string_view text) { return word.name < text; });
  return found != kWords.end() && found->name == name ? found : nullptr;
}

}  // namespace hcsp::lang::minibex
