// SPDX-License-Identifier: Apache-2.0
// The three ways to be wrong: a caller's mistake throws with the argument's name, a broken invariant asserts,
// and an empty domain is neither: it is a value.
#pragma once

#include <fmt/format.h>

#include <cassert>
#include <stdexcept>

namespace hcsp {

/// Throws std::invalid_argument with a formatted message when the caller broke the contract.
template <class... Args>
void require(bool holds, fmt::format_string<Args...> message, Args&&... args) {
  if (!holds) throw std::invalid_argument(fmt::format(message, std::forward<Args>(args)...));
}

}  // namespace hcsp

#define HCSP_ASSERT(condition) assert(condition)
