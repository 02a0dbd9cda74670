// SPDX-License-Identifier: Apache-2.0
#include "lang/diagnostics.h"

#include <algorithm>

#include "lang/nearest.h"

namespace hcsp::lang {

namespace {

// A line may be megabytes long: only this many code points around the place are shown.
constexpr std::size_t kShownBefore = 80;
constexpr std::size_t kShownAfter = 100;

// What a terminal can show: tabs stay, control and broken bytes become the replacement character.
std::string printable(std::string_view text, std::size_t at, std::size_t length) {
  if (length == 0) return "\xEF\xBF\xBD";
  const auto byte = static_cast<unsigned char>(text[at]);
  if (length == 1 && (byte < 0x20 || byte == 0x7F) && byte != '\t') return "\xEF\xBF\xBD";
  return std::string(text.substr(at, length));
}

struct Excerpt {
  std::string line;
  std::string carets;
};

// The part of the line around [begin, end) (offsets in the line) and the carets under it.
Excerpt excerpt(std::string_view line, std::size_t begin, std::size_t end) {
  Excerpt result;
  std::size_t first = begin;
  std::size_t kept = 0;
  while (first > 0 && kept < kShownBefore) {
    do --first;
    while (first > 0 && begin - first < 4 * kShownBefore &&
           (static_cast<unsigned char>(line[first]) & 0xC0U) == 0x80);
    ++kept;
  }
  if (first > 0) {
    result.line = "...";
    result.carets = "   ";
  }
  std::size_t after = 0;
  std::size_t at = first;
  for (; at < line.size() && after < kShownAfter;) {
    const std::size_t length = code_point_length(line, at);
    result.line += printable(line, at, length);
    if (at < begin) {
      result.carets += line[at] == '\t' ? '\t' : ' ';
    } else {
      if (at < end) result.carets += at == begin ? '^' : '~';
      ++after;
    }
    at += std::max<std::size_t>(length, 1);
  }
  if (at < line.size()) result.line += "...";
  if (begin >= line.size() || begin == end) result.carets += '^';
  return result;
}

}  // namespace

Diagnostic& Diagnostic::did_you_mean(std::string_view name, const std::vector<std::string>& candidates) {
  if (const auto nearest = nearest_name(name, candidates)) note(fmt::format("did you mean `{}`?", *nearest));
  return *this;
}

std::string render(const Diagnostic& diagnostic) {
  const SourceRange& range = diagnostic.range;
  const std::string id = code_id(diagnostic.code);
  if (range.source == nullptr) {
    std::string text = fmt::format("error[{}]: {}\n", id, diagnostic.message);
    for (const std::string& note : diagnostic.notes) text += fmt::format("  {}\n", note);
    return text;
  }
  const auto place = range.source->position(range.begin);
  const std::string_view line = range.source->line(place.line);
  const std::size_t start = range.source->line_start(place.line);
  const std::size_t begin = std::min<std::size_t>(range.begin - start, line.size());
  const std::size_t end = std::min<std::size_t>(std::max(range.end, range.begin) - start, line.size());
  std::string text = fmt::format("{}:{}:{}: error[{}]: {}\n", range.source->name(), place.line, place.column,
                                 id, diagnostic.message);
  if (!line.empty()) {
    const Excerpt shown = excerpt(line, begin, end);
    text += fmt::format("  {}\n  {}\n", shown.line, shown.carets);
  }
  for (const std::string& note : diagnostic.notes) text += fmt::format("  {}\n", note);
  return text;
}

std::string Diagnostics::text() const {
  std::vector<const Source*> order;
  const auto rank = [&](const Source* source) {
    const auto found = std::find(order.begin(), order.end(), source);
    if (found != order.end()) return found - order.begin();
    order.push_back(source);
    return static_cast<std::ptrdiff_t>(order.size()) - 1;
  };
  std::vector<std::pair<std::ptrdiff_t, const Diagnostic*>> sorted;
  for (const Diagnostic& diagnostic : all_) sorted.emplace_back(rank(diagnostic.range.source), &diagnostic);
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
    return std::pair(a.first, a.second->range.begin) < std::pair(b.first, b.second->range.begin);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), kMostShown); ++i) text += render(*sorted[i].second);
  if (sorted.size() > kMostShown) text += fmt::format("{} more errors\n", sorted.size() - kMostShown);
  return text;
}

}  // namespace hcsp::lang
