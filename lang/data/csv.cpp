// SPDX-License-Identifier: Apache-2.0
#include "lang/data/table.h"

#include <algorithm>

namespace hcsp::lang {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool ends_line(char c) { return c == '\n' || c == '\r'; }

}  // namespace

class CsvTableReader {
 public:
  CsvTableReader(const Source& source, Diagnostics& diagnostics)
      : source_(source), text_(source.text()), diagnostics_(diagnostics), table_(source) {}

  std::optional<Table> run() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    if (!next_record()) {
      if (!failed_) report(Code::no_rows, {0, 0}, "no header line");
      return {};
    }
    if (!read_header()) return {};
    while (next_record()) {
      if (!add_row()) return {};
    }
    if (failed_) return {};
    if (table_.cells_.empty()) {
      report(Code::no_rows, {0, 0}, "a header line, but no rows");
      return {};
    }
    return std::move(table_);
  }

 private:
  struct Span {
    std::size_t begin;
    std::size_t end;
  };

  template <class... Args>
  Diagnostic& report(Code code, const Span& span, const Args&... args) {
    failed_ = true;
    const SourceRange range{&source_, static_cast<std::uint32_t>(span.begin),
                            static_cast<std::uint32_t>(span.end)};
    return diagnostics_.report(code, range, args...);
  }

  // Reads the next record that is not blank into record_; false at the end of the text or after a report.
  bool next_record() {
    while (at_ < text_.size() && !failed_) {
      record_.clear();
      const std::size_t begin = at_;
      while (read_cell()) {
      }
      if (failed_) return false;
      record_span_ = {begin, at_};
      if (at_ < text_.size() && text_[at_] == '\r') ++at_;
      if (at_ < text_.size() && text_[at_] == '\n') ++at_;
      const bool blank = record_.size() == 1 && record_[0].length == 0 && record_[0].quoted == 0;
      if (!blank) return true;
    }
    return false;
  }

  // Reads one cell; true when a comma, that is another cell, follows.
  bool read_cell() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    Table::Cell cell;
    if (at_ < text_.size() && text_[at_] == '"') {
      if (!read_quoted(cell)) return false;
    } else {
      const std::size_t begin = at_;
      while (at_ < text_.size() && text_[at_] != ',' && !ends_line(text_[at_])) ++at_;
      std::size_t end = at_;
      while (end > begin && is_blank(text_[end - 1])) --end;
      Table::set(cell, begin, end);
    }
    record_.push_back(cell);
    const bool more = at_ < text_.size() && text_[at_] == ',';
    at_ += more ? 1 : 0;
    return more;
  }

  bool read_quoted(Table::Cell& cell) {
    const std::size_t begin = ++at_;
    while (true) {
      const std::size_t quote = text_.find('"', at_);
      if (quote == std::string_view::npos) {
        report(Code::broken_quotes, {begin - 1, begin}, "is not closed");
        return false;
      }
      at_ = quote + 1;
      if (at_ < text_.size() && text_[at_] == '"') {
        ++at_;
        continue;
      }
      Table::set(cell, begin, quote);
      cell.quoted = 1;
      break;
    }
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    if (at_ == text_.size() || text_[at_] == ',' || ends_line(text_[at_])) return true;
    report(Code::broken_quotes, {at_, at_ + 1}, "is followed by more text");
    return false;
  }

  bool read_header() {
    table_.cells_ = record_;
    table_.columns_.resize(record_.size());
    for (std::size_t c = 0; c < record_.size(); ++c) {
      const std::string name = table_.cell(0, c);
      const auto seen = table_.columns_.begin() + static_cast<std::ptrdiff_t>(c);
      if (!name.empty() && std::find(table_.columns_.begin(), seen, name) != seen) {
        const SourceRange range = table_.range(0, c);
        report(Code::column_twice, {range.begin, range.end}, name);
        return false;
      }
      table_.columns_[c] = name;
    }
    table_.cells_.clear();
    return true;
  }

  bool add_row() {
    const std::size_t columns = table_.columns_.size();
    for (std::size_t c = columns; c < record_.size(); ++c) {
      if (record_[c].length == 0) continue;  // a comma at the end of the line
      const Span extra{record_[c].begin, record_[c].begin + record_[c].length};
      report(Code::ragged_row, extra, record_.size(), columns);
      return false;
    }
    Table::Cell missing;
    Table::set(missing, record_span_.end, record_span_.end);
    missing.missing = 1;
    record_.resize(columns, missing);
    table_.cells_.insert(table_.cells_.end(), record_.begin(), record_.end());
    return true;
  }

  const Source& source_;
  std::string_view text_;
  Diagnostics& diagnostics_;
  Table table_;
  std::size_t at_ = 0;
  bool failed_ = false;
  std::vector<Table::Cell> record_;
  Span record_span_{0, 0};
};

std::optional<Table> Table::read_csv(const Source& source, Diagnostics& diagnostics) {
  return CsvTableReader(source, diagnostics).run();
}

std::string Table::cell(std::size_t row, std::size_t column) const {
  const Cell& cell = at(row, column);
  std::string text(source_->text().substr(cell.begin, cell.length));
  if (cell.quoted == 0) return text;
  for (std::size_t quote = text.find("\"\""); quote != std::string::npos;
       quote = text.find("\"\"", quote + 1)) {
    text.erase(quote, 1);
  }
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

SourceRange Table::range(std::size_t row, std::size_t column) const {
  const Cell& cell = at(row, column);
  return {source_, cell.begin, cell.begin + cell.length};
}

std::size_t Table::line(std::size_t row) const { return source_->position(at(row, 0).begin).line; }

}  // namespace hcsp::lang
