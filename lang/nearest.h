// SPDX-License-Identifier: Apache-2.0
// The name that a misspelt one was probably meant to be.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hcsp::lang {

/// The candidate nearest to `name` by edit distance (insert, delete, replace, swap neighbours; a change of
/// case costs nothing extra), the first of equals; none when every one differs in more than a third of its
/// letters.
std::optional<std::string> nearest_name(std::string_view name, const std::vector<std::string>& candidates);

}  // namespace hcsp::lang
