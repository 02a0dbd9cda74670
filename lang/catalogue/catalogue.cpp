// SPDX-License-Identifier: Apache-2.0
#include "lang/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "lang/catalogue/entries.h"
#include "lang/source.h"

namespace hcsp::lang {

std::span<const CatalogueEntry> catalogue() {
  static const std::vector<CatalogueEntry> all = [] {
    std::vector<CatalogueEntry> entries;
    for (const auto part :
         {syntax_entries(), name_entries(), data_entries(), time_entries(), relation_entries()}) {
      entries.insert(entries.end(), part.begin(), part.end());
    }
    std::sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.code < b.code; });
    return entries;
  }();
  return all;
}

const CatalogueEntry& entry(Code code) {
  const auto all = catalogue();
  return *std::lower_bound(all.begin(), all.end(), code,
                           [](const CatalogueEntry& e, Code wanted) { return e.code < wanted; });
}

std::string code_id(Code code) { return fmt::format("E{:03}", static_cast<unsigned>(code)); }

namespace {

// The message with dots for what depends on the model.
std::string with_gaps(std::string_view format) {
  std::string message(format);
  for (std::size_t at = message.find("{}"); at != std::string::npos; at = message.find("{}")) {
    message.replace(at, 2, "...");
  }
  return message;
}

// Examples may hold bytes that no terminal can show: that is what they are about.
std::string indented(std::string_view text) {
  std::string result = "    ";
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = code_point_length(text, at);
    result += length == 0 ? "\xEF\xBF\xBD" : text.substr(at, length);
    if (text[at] == '\n') result += "    ";
    at += std::max<std::size_t>(length, 1);
  }
  return result + "\n";
}

}  // namespace

std::string explanation_page(std::string_view id) {
  if (!id.empty() && (id.front() == 'E' || id.front() == 'e')) id.remove_prefix(1);
  unsigned number = 0;
  const auto [end, error] = std::from_chars(id.data(), id.data() + id.size(), number);
  if (error != std::errc() || end != id.data() + id.size()) return {};
  for (const CatalogueEntry& e : catalogue()) {
    if (static_cast<unsigned>(e.code) != number) continue;
    return fmt::format("{}: {}\n\n{}\n\nWrong:\n\n{}\nRight:\n\n{}", code_id(e.code), with_gaps(e.format),
                       e.explanation, indented(e.wrong), indented(e.right));
  }
  return {};
}

}  // namespace hcsp::lang
