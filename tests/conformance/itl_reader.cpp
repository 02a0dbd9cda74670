// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/itl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>

namespace hcsp::itl {

namespace {

std::string lower_case(std::string word) {
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word;
}

std::optional<double> number_of(const std::string& word) {
  if (word.empty()) return {};
  char* end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (*end != '\0') return {};
  return value;
}

class Reader {
 public:
  Reader(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {}

  std::vector<Statement> statements() {
    std::vector<Statement> found;
    for (skip_space(); at_ < text_.size(); skip_space()) {
      if (word() != "testcase") fail("expected `testcase`");
      while (at_ < text_.size() && text_[at_] != '{') ++at_;
      expect('{');
      while (!next_is('}')) found.push_back(statement());
      expect('}');
    }
    return found;
  }

 private:
  Statement statement() {
    const std::size_t begin = at_;
    Statement result{line_of(begin), {}, word(), {}, {}, {}};
    if (result.operation.empty()) fail("expected an operation");
    while (!next_is('=')) result.operands.push_back(value());
    expect('=');
    while (!next_is(';') && !starts_with("signal ")) result.results.push_back(value());
    if (starts_with("signal ")) {
      word();
      skip_space();
      result.signal = word();
    }
    if (result.results.empty()) fail("expected a result");
    result.text = text_.substr(begin, at_ - begin);
    expect(';');
    return result;
  }

  Value value() {
    skip_space();
    const char next = at_ < text_.size() ? text_[at_] : '\0';
    if (next == '"') return text();
    if (next == '[') return literal();
    if (next == '{') return numbers();
    const std::size_t begin = at_;
    const std::string name = word();
    if (name.empty()) fail("expected a value");
    if (const auto number = number_of(name)) return *number;
    if (std::isalpha(static_cast<unsigned char>(name[0])) == 0) fail("expected a number", begin);
    return Word{name};
  }

  Text text() {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n') ++at_;
    if (at_ == text_.size() || text_[at_] != '"') fail("this text does not end", begin);
    return {text_.substr(begin + 1, at_++ - begin - 1)};
  }

  Literal literal() {
    const std::size_t begin = at_++;
    while (at_ < text_.size() && text_[at_] != ']' && text_[at_] != ';') ++at_;
    if (at_ == text_.size() || text_[at_] != ']') fail("this interval does not end", begin);
    const std::string inside = text_.substr(begin + 1, at_++ - begin - 1);
    const std::string name = lower_case(inside);
    if (name == "nai") return {DecoratedInterval::nai(), true};
    const Interval bare = name == "empty"    ? Interval::empty()
                          : name == "entire" ? Interval::entire()
                                             : bounds(inside, begin);
    if (at_ == text_.size() || text_[at_] != '_') return {DecoratedInterval(bare), false};
    const std::size_t suffix = at_++;
    const std::string decoration = word();
    for (const auto& [text, d] : {std::pair{"com", Decoration::com},
                                  {"dac", Decoration::dac},
                                  {"def", Decoration::def},
                                  {"trv", Decoration::trv}})
      if (decoration == text) return {DecoratedInterval(bare, d), true};
    fail("expected com, dac, def or trv", suffix);
  }

  Interval bounds(const std::string& inside, std::size_t begin) {
    const auto trimmed = [](std::string s) {
      std::erase_if(s, [](unsigned char c) { return std::isspace(c) != 0; });
      return s;
    };
    const std::size_t comma = inside.find(',');
    const auto lo = number_of(trimmed(inside.substr(0, comma)));
    const auto hi = comma == std::string::npos ? lo : number_of(trimmed(inside.substr(comma + 1)));
    if (!lo || !hi || !(*lo <= *hi)) fail("expected two bounds in order", begin);
    return Interval::raw(*lo, *hi);
  }

  std::vector<double> numbers() {
    std::vector<double> found;
    expect('{');
    while (!next_is('}')) {
      const std::size_t begin = at_;
      const auto number = number_of(word());
      if (!number) fail("expected a number", begin);
      found.push_back(*number);
      if (!next_is('}')) expect(',');
    }
    expect('}');
    return found;
  }

  std::string word() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) == 0 &&
           std::string_view("=;,{}[]\"").find(text_[at_]) == std::string_view::npos)
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  [[nodiscard]] bool starts_with(std::string_view prefix) const {
    return std::string_view(text_).substr(at_).starts_with(prefix);
  }

  void skip_space() {
    while (at_ < text_.size()) {
      if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        ++at_;
      } else if (starts_with("//") || starts_with("#")) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (starts_with("/*")) {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string::npos) fail("this comment does not end");
        at_ = end + 2;
      } else {
        return;
      }
    }
  }

  bool next_is(char c) {
    skip_space();
    if (at_ == text_.size()) fail(fmt::format("expected `{}` before the end of the file", c));
    return text_[at_] == c;
  }

  void expect(char c) {
    skip_space();
    if (at_ == text_.size() || text_[at_] != c) fail(fmt::format("expected `{}`", c));
    ++at_;
  }

  [[nodiscard]] int line_of(std::size_t place) const {
    return 1 + static_cast<int>(
                   std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(place), '\n'));
  }

  [[noreturn]] void fail(const std::string& what) const { fail(what, at_); }
  [[noreturn]] void fail(const std::string& what, std::size_t place) const {
    const std::size_t before = place == 0 ? std::string::npos : text_.rfind('\n', place - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::string line = text_.substr(begin, text_.find('\n', begin) - begin);
    const std::size_t column = place - begin;
    throw Malformed(fmt::format("{}:{}:{}: {}\n{}\n{:>{}}", file_, line_of(place), column + 1, what, line,
                                '^', column + 1));
  }

  std::string file_, text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<Statement> read(const std::string& file) {
  const std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream || !text) throw std::runtime_error(file + ": cannot be read");
  return Reader(file, text.str()).statements();
}

}  // namespace hcsp::itl
