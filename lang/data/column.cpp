// SPDX-License-Identifier: Apache-2.0
#include "lang/data/column.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace hcsp::lang {

namespace {

bool is_no_finite_number(std::string text) {
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) text.erase(0, 1);
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text == "nan" || text == "inf" || text == "infinity";
}

class ColumnConverter {
 public:
  ColumnConverter(const Table& table, std::size_t index, Diagnostics& diagnostics)
      : table_(table), index_(index), diagnostics_(diagnostics) {}

  std::optional<Column> run() {
    Column column{&table_, index_, std::vector<CellValue>(table_.rows())};
    for (std::size_t row = 0; row < table_.rows(); ++row) column.cells[row] = value_of(row);
    if (wrong_ == 0) return column;
    if (wrong_ > 1)
      first_.note(wrong_ == 2 ? "one more cell of the column is wrong"
                              : fmt::format("{} more cells of the column are wrong", wrong_ - 1));
    diagnostics_.add(first_);
    return {};
  }

 private:
  CellValue value_of(std::size_t row) {
    const std::string& name = table_.columns()[index_];
    if (table_.is_missing(row, index_)) return wrong(row, Code::missing_cell, name);
    const std::string text = table_.cell(row, index_);
    if (text.empty()) return {CellValue::Kind::blank, {}};
    if (text == "oo") return {CellValue::Kind::no_echo, {}};
    if (const auto number = Number::parse(text)) return {CellValue::Kind::number, *number};
    if (is_no_finite_number(text)) return wrong(row, Code::not_finite, name, text);
    return wrong(row, Code::not_a_number, name, text.substr(0, 40));
  }

  template <class... Args>
  CellValue wrong(std::size_t row, Code code, const Args&... args) {
    if (++wrong_ == 1) {
      first_ = {code,
                table_.range(row, index_),
                fmt::vformat(entry(code).format, fmt::make_format_args(args...)),
                {}};
    }
    return {};
  }

  const Table& table_;
  std::size_t index_;
  Diagnostics& diagnostics_;
  std::size_t wrong_ = 0;
  Diagnostic first_{};
};

}  // namespace

std::optional<Column> convert_column(const Table& table, std::size_t index, Diagnostics& diagnostics) {
  return ColumnConverter(table, index, diagnostics).run();
}

std::optional<std::vector<double>> instants_of(const Column& stamps, Diagnostics& diagnostics) {
  std::vector<double> instants;
  instants.reserve(stamps.cells.size());
  for (std::size_t row = 0; row < stamps.cells.size(); ++row) {
    const SourceRange place = stamps.table->range(row, stamps.index);
    const CellValue& cell = stamps.cells[row];
    if (cell.kind == CellValue::Kind::no_echo) {
      diagnostics.report(Code::no_echo_here, place, stamps.name());
      return {};
    }
    if (cell.kind == CellValue::Kind::blank) {
      diagnostics.report(Code::blank_cell, place, stamps.name()).note("every row needs its stamp");
      return {};
    }
    const double instant = cell.number.nearest();
    if (!std::isfinite(instant)) {
      diagnostics.report(Code::not_finite, place, stamps.name(), stamps.table->cell(row, stamps.index));
      return {};
    }
    if (!instants.empty() && instant == instants.back()) {
      diagnostics.report(Code::stamp_twice, place, stamps.name(), stamps.table->cell(row, stamps.index));
      return {};
    }
    if (!instants.empty() && instant < instants.back()) {
      diagnostics.report(Code::stamps_unsorted, place, stamps.name(), stamps.table->cell(row, stamps.index),
                         stamps.table->cell(row - 1, stamps.index));
      return {};
    }
    instants.push_back(instant);
  }
  return instants;
}

}  // namespace hcsp::lang
