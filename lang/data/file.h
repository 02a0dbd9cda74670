// SPDX-License-Identifier: Apache-2.0
// Files as whole texts.
#pragma once

#include <optional>
#include <string>

namespace hcsp::lang {

/// The text of a file; none, with the reason in `error`, when it cannot be read.
std::optional<std::string> read_file(const std::string& path, std::string& error);

/// `path` as seen from the folder of `file`, unless it is absolute.
std::string beside(const std::string& file, const std::string& path);

}  // namespace hcsp::lang
