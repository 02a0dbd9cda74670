// SPDX-License-Identifier: Apache-2.0
// Files that hcsp-solve writes; what cannot be written is told.
#pragma once

#include <string>

namespace hcsp::tool {

bool write(const std::string& path, const std::string& text);

/// Whatever happens meanwhile, the file is what it was before or what it is after.
bool write_at_once(const std::string& path, const std::string& bytes);

/// Whether the file can be written, or no path is given: better to learn it before the run than after. Makes
/// the file where there is none.
bool can_write(const std::string& path);

}  // namespace hcsp::tool
