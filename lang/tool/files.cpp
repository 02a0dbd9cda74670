// SPDX-License-Identifier: Apache-2.0
#include "lang/tool/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>

namespace hcsp::tool {

namespace {

bool cannot_write(const std::string& path) {
  fmt::print(stderr, "hcsp-solve: cannot write {}\n", path);
  return false;
}

bool put(const std::string& path, const std::string& bytes) {
  std::ofstream stream(path, std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  return !stream.fail();
}

// Until the disk has it, a new name may come to stand for an empty file.
bool reaches_disk(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool synced = fsync(file) == 0;
  close(file);
  return synced;
}

}  // namespace

bool write(const std::string& path, const std::string& text) { return put(path, text) || cannot_write(path); }

bool write_at_once(const std::string& path, const std::string& bytes) {
  const std::string unfinished = path + ".unfinished";
  const bool written = put(unfinished, bytes) && reaches_disk(unfinished) &&
                       std::rename(unfinished.c_str(), path.c_str()) == 0;
  return written || cannot_write(path);
}

bool can_write(const std::string& path) {
  return path.empty() || std::ofstream(path, std::ios::app) || cannot_write(path);
}

}  // namespace hcsp::tool
