// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <unordered_map>

#include "lang/data/table.h"

namespace hcsp::lang {

namespace {

// Characters of a text that tell how far they were read: the parser says what it found, not where.
class Reading {
 public:
  using difference_type = std::ptrdiff_t;
  using value_type = char;
  using pointer = const char*;
  using reference = const char&;
  using iterator_category = std::input_iterator_tag;

  Reading(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
  const char& operator*() const { return *at_; }
  Reading& operator++() {
    *furthest_ = std::max(*furthest_, ++at_);
    return *this;
  }
  Reading operator++(int) {
    Reading before = *this;
    ++*this;
    return before;
  }
  friend bool operator==(const Reading& a, const Reading& b) { return a.at_ == b.at_; }
  friend bool operator!=(const Reading& a, const Reading& b) { return a.at_ != b.at_; }

 private:
  const char* at_;
  const char** furthest_;
};

bool is_of_number(char c) {
  return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.' || c == 'e' || c == 'E';
}

}  // namespace

// Takes what the parser finds. An object of columns, each an array of cells, or an array of rows, each an
// object of cells.
class JsonTableReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  JsonTableReader(const Source& source, Diagnostics& diagnostics)
      : source_(source), text_(source.text()), diagnostics_(diagnostics), table_(source) {}

  std::optional<Table> run() {
    const char* const begin = text_.data();
    furthest_ = begin;
    const bool good = nlohmann::json::sax_parse(Reading(begin, &furthest_),
                                                Reading(begin + text_.size(), &furthest_), this);
    if (!good || failed_) return {};
    const std::size_t rows = by_row_ ? row_ : longest_column();
    if (table_.columns_.empty() || rows == 0) {
      report(Code::no_rows, 0, 0, table_.columns_.empty() ? "no columns" : "columns, but no rows");
      return {};
    }
    if (!by_row_ && !columns_agree(rows)) return {};
    fill(rows);
    return std::move(table_);
  }

  bool null() override { return cell(end(), end()); }
  bool boolean(bool truth) override { return cell(end() - (truth ? 4 : 5), end()); }
  bool number_integer(number_integer_t) override { return number(); }
  bool number_unsigned(number_unsigned_t) override { return number(); }
  bool number_float(number_float_t, const string_t&) override { return number(); }
  bool string(string_t& value) override {
    const std::size_t quote = end() - 1;
    // Of one with escapes the closing quote stands for the rest: text is no number anyhow.
    const bool plain = value.size() < quote && text_.substr(quote - value.size(), value.size()) == value;
    return cell(plain ? quote - value.size() : quote, plain ? quote : end());
  }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override {
    if (depth_ == 2 || (depth_ == 1 && !by_row_)) return misshapen();
    if (++depth_ == 2) ++row_;
    return true;
  }
  bool end_object() override {
    --depth_;
    return true;
  }
  bool start_array(std::size_t) override {
    if (depth_ == 2 || (depth_ == 1 && by_row_)) return misshapen();
    if (depth_++ == 0) {
      by_row_ = true;
    } else {
      row_ = 0;
    }
    return true;
  }
  bool end_array() override {
    --depth_;
    return true;
  }
  bool key(string_t& name) override {
    const auto [known, is_new] = places_.emplace(name, table_.columns_.size());
    if (is_new) {
      table_.columns_.push_back(name);
      cells_.emplace_back();
    } else if (!by_row_ || cells_[known->second].size() >= row_) {
      report(Code::column_twice, end() - 1, end(), name);
      return false;
    }
    column_ = known->second;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    const std::size_t at = std::min(end() == 0 ? 0 : end() - 1, text_.size());
    return fail(at, std::min(at + 1, text_.size()), "it is not well formed here");
  }

 private:
  // The first byte that was not read yet. Behind a number the parser has looked at one byte more.
  [[nodiscard]] std::size_t end() const { return static_cast<std::size_t>(furthest_ - text_.data()); }

  template <class... Args>
  void report(Code code, std::size_t begin, std::size_t end, const Args&... args) {
    failed_ = true;
    diagnostics_.report(code, {&source_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)},
                        args...);
  }
  bool fail(std::size_t begin, std::size_t end, std::string_view what) {
    report(Code::broken_json, begin, end, what);
    return false;
  }
  bool misshapen() {
    return fail(end() - 1, end(),
                "it is no object of columns `{\"t\": [0, 1]}` and no array of rows `[{\"t\": 0}]`");
  }

  bool number() {
    std::size_t last = std::min(end(), text_.size());
    while (last > 0 && !is_of_number(text_[last - 1])) --last;
    std::size_t first = last;
    while (first > 0 && is_of_number(text_[first - 1])) --first;
    return cell(first, last);
  }

  bool cell(std::size_t begin, std::size_t end) {
    if (depth_ != 2) return misshapen();
    std::vector<Table::Cell>& column = cells_[column_];
    if (by_row_) column.resize(row_ - 1, gap(begin));  // rows that do not name it
    column.push_back({});
    Table::set(column.back(), begin, end);
    if (!by_row_) ++row_;
    return true;
  }
  static Table::Cell gap(std::size_t at) {
    Table::Cell missing;
    Table::set(missing, at, at);
    return missing;
  }

  [[nodiscard]] std::size_t longest_column() const {
    std::size_t rows = 0;
    for (const auto& column : cells_) rows = std::max(rows, column.size());
    return rows;
  }
  bool columns_agree(std::size_t rows) {
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      if (cells_[c].size() == rows) continue;
      const std::string what =
          fmt::format("its column `{}` has {} cells, another {}", table_.columns_[c], cells_[c].size(), rows);
      return fail(0, 0, what);
    }
    return true;
  }
  void fill(std::size_t rows) {
    for (auto& column : cells_) column.resize(rows, gap(text_.size()));
    for (std::size_t row = 0; row < rows; ++row) {
      for (const auto& column : cells_) table_.cells_.push_back(column[row]);
    }
  }

  const Source& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  Table table_;
  const char* furthest_ = nullptr;
  bool by_row_ = false, failed_ = false;
  int depth_ = 0;
  std::size_t row_ = 0, column_ = 0;
  std::unordered_map<std::string, std::size_t> places_;  // of the columns, by name
  std::vector<std::vector<Table::Cell>> cells_;          // by column
};

std::optional<Table> Table::read_json(const Source& source, Diagnostics& diagnostics) {
  return JsonTableReader(source, diagnostics).run();
}

}  // namespace hcsp::lang
