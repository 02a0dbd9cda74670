// SPDX-License-Identifier: Apache-2.0
// A column of a table as numbers, and what arithmetic makes of it: `2*log.range`, `log.t - log.t[1]`.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lang/data/decimal.h"
#include "lang/data/table.h"

namespace hcsp::lang {

/// One cell: a number, no reading (blank), or no echo (the word oo).
struct CellValue {
  enum class Kind : std::uint8_t { number, blank, no_echo };
  Kind kind = Kind::blank;
  Number number;
};

/// A value for each row of a table.
struct Column {
  const Table* table = nullptr;
  std::size_t index = 0;  ///< the column of the table that diagnostics point at
  std::vector<CellValue> cells;

  [[nodiscard]] const std::string& name() const { return table->columns()[index]; }
};

/// Converts the cells of a column. A cell that is no number is reported with its file, line and column; the
/// first one only, with a count of the others. None after a report.
std::optional<Column> convert_column(const Table& table, std::size_t index, Diagnostics& diagnostics);

/// The stamps of a column as instants, the nearest doubles. Reported, with the row: a blank, stamps that do
/// not increase, stamps that are too close to be two doubles. None after a report.
std::optional<std::vector<double>> instants_of(const Column& stamps, Diagnostics& diagnostics);

}  // namespace hcsp::lang
