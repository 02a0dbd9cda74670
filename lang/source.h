// SPDX-License-Identifier: Apache-2.0
// A text that people wrote: a model, a data file, a value on the command line; and places in it. Everything
// that a diagnostic points at is a range of a Source.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hcsp::lang {

class Source {
 public:
  /// `name` is what messages call it: a path as the person wrote it, or "--set eps".
  Source(std::string name, std::string text);
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] std::string_view text() const { return text_; }

  /// Both count from 1; columns count code points, so that they agree with what an editor shows.
  struct Position {
    std::size_t line;
    std::size_t column;
  };
  [[nodiscard]] Position position(std::size_t offset) const;
  /// A line without its end; `number` counts from 1.
  [[nodiscard]] std::string_view line(std::size_t number) const;
  /// The offset of a line's first byte.
  [[nodiscard]] std::size_t line_start(std::size_t number) const { return line_starts_[number - 1]; }

 private:
  std::string name_;
  std::string text_;
  std::vector<std::size_t> line_starts_;
};

/// The bytes [begin, end) of a source. The source outlives whatever points at it.
struct SourceRange {
  const Source* source = nullptr;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  [[nodiscard]] std::string_view text() const { return source->text().substr(begin, end - begin); }
  /// From the start of this range to the end of `last`; both in one source.
  [[nodiscard]] SourceRange to(const SourceRange& last) const { return {source, begin, last.end}; }
};

/// The largest text that is read: offsets have 32 bits.
inline constexpr std::size_t kLargestSource = 4'000'000'000;

/// The length of the UTF-8 code point at text[at], or 0 where the bytes are not valid UTF-8.
std::size_t code_point_length(std::string_view text, std::size_t at);

}  // namespace hcsp::lang
