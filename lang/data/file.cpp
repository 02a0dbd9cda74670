// SPDX-License-Identifier: Apache-2.0
#include "lang/data/file.h"

#include <filesystem>
#include <fstream>
#include <system_error>

#include "lang/source.h"

namespace hcsp::lang {

std::optional<std::string> read_file(const std::string& path, std::string& error) {
  if (path.find('\0') != std::string::npos) {
    error = "a file name has no NUL byte";
    return {};
  }
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) {
    error = "it is a folder";
    return {};
  }
  if (std::filesystem::is_character_file(path, status) || std::filesystem::is_block_file(path, status)) {
    error = "it is a device";
    return {};
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    error = std::filesystem::exists(path, status) ? "it may not be read" : "no such file";
    return {};
  }
  std::string text;
  char buffer[1 << 16];
  while (stream.read(buffer, sizeof buffer) || stream.gcount() > 0) {
    text.append(buffer, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kLargestSource) {
      error = "it is too large";
      return {};
    }
  }
  if (stream.bad()) {
    error = "reading it failed";
    return {};
  }
  return text;
}

std::string beside(const std::string& file, const std::string& path) {
  return (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

}  // namespace hcsp::lang
