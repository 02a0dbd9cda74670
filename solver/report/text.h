// SPDX-License-Identifier: Apache-2.0
// How the writers of results put numbers and strings into text.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hcsp::report {

using TextBuffer = fmt::memory_buffer;

inline void put(TextBuffer& out, std::string_view text) {
  out.append(text.data(), text.data() + text.size());
}
inline void put(TextBuffer& out, char c) { out.push_back(c); }
/// A value of JSON: the shortest decimal that reads back as the same double, or the strings "oo" and "-oo".
void put_json_number(TextBuffer& out, double value);
/// A string of JSON with its quotes. `<` is escaped, so that the text can stand in a script element; bytes
/// that are not UTF-8 become U+FFFD.
void put_json_string(TextBuffer& out, std::string_view text);
/// Text for the content or a quoted attribute of XML and HTML.
std::string xml_escape(std::string_view text);
/// A number for people: at most `digits` significant digits, infinity as the sign for it.
std::string for_people(double value, int digits = 6);

/// The shortest decimals of doubles, or oo and -oo. It remembers what it wrote: the bounds of a set's boxes,
/// instants and constants come again and again, and to look one up costs a twentieth of writing it.
class NumberTexts {
 public:
  NumberTexts() : entries_(kEntries) {}
  /// Valid until the next call.
  std::string_view of(double value);

 private:
  static constexpr std::size_t kEntries = 1024;  // 32 kB, what a processor's nearest cache holds
  struct Entry {
    std::uint64_t bits = 0;
    std::uint8_t length = 0;    // 0: unused
    std::array<char, 24> text;  // the longest is -2.2250738585072014e-308
  };
  std::vector<Entry> entries_;
};

inline std::string to_text(const TextBuffer& out) { return {out.data(), out.size()}; }

}  // namespace hcsp::report
