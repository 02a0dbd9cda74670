// SPDX-License-Identifier: Apache-2.0
#include "solver/report/text.h"

#include <fmt/compile.h>

#include <bit>
#include <cmath>

namespace hcsp::report {

namespace {

// The length of the UTF-8 sequence (RFC 3629) that starts at text[at], 0 if there is none.
std::size_t sequence_length(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
  };
  const unsigned lead = byte(at);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(at + i) & 0xc0U) != 0x80U) return 0;
  }
  const unsigned second = byte(at + 1);
  const bool overlong = (lead == 0xe0 && second < 0xa0) || (lead == 0xf0 && second < 0x90);
  const bool surrogate = lead == 0xed && second > 0x9f;
  const bool beyond = lead == 0xf4 && second > 0x8f;
  return overlong || surrogate || beyond ? 0 : length;
}

void put_escaped(TextBuffer& out, char c) {
  switch (c) {
    case '"':
      return put(out, "\\\"");
    case '\\':
      return put(out, "\\\\");
    case '\n':
      return put(out, "\\n");
    case '\t':
      return put(out, "\\t");
    case '\r':
      return put(out, "\\r");
    default:
      fmt::format_to(fmt::appender(out), "\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  }
}

bool needs_escape(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\' || c == '<' || c == 0x7f;
}

}  // namespace

void put_json_number(TextBuffer& out, double value) {
  if (std::isinf(value)) return put(out, value > 0 ? R"("oo")" : R"("-oo")");
  fmt::format_to(fmt::appender(out), FMT_COMPILE("{}"), value);
}

std::string_view NumberTexts::of(double value) {
  if (std::isinf(value)) return value > 0 ? "oo" : "-oo";
  const auto bits = std::bit_cast<std::uint64_t>(value);
  Entry& entry =
      entries_[(bits * 0x9e3779b97f4a7c15U) >> 54U];  // the golden ratio spreads the bits (Knuth, 6.4)
  static_assert(kEntries == std::size_t{1} << (64U - 54U));
  if (entry.length == 0 || entry.bits != bits) {
    const char* end = fmt::format_to(entry.text.data(), FMT_COMPILE("{}"), value);
    entry.bits = bits;
    entry.length = static_cast<std::uint8_t>(end - entry.text.data());
  }
  return {entry.text.data(), entry.length};
}

void put_json_string(TextBuffer& out, std::string_view text) {
  put(out, '"');
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text, i);
    if (length == 0) {
      put(out, "\\ufffd");
    } else if (length == 1 && needs_escape(text[i])) {
      put_escaped(out, text[i]);
    } else {
      put(out, text.substr(i, length));
    }
    i += length == 0 ? 1 : length;
  }
  put(out, '"');
}

std::string xml_escape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = sequence_length(text, i);
    const char c = text[i];
    if (length == 0 || (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')) {
      out += "\xef\xbf\xbd";  // U+FFFD: XML 1.0 has no control characters, not even escaped
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\'') {
      out += "&#39;";
    } else {
      out += text.substr(i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return out;
}

std::string for_people(double value, int digits) {
  if (std::isinf(value)) return value > 0 ? "\xe2\x88\x9e" : "-\xe2\x88\x9e";
  return fmt::format("{:.{}g}", value, digits);
}

}  // namespace hcsp::report
