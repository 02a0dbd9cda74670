// SPDX-License-Identifier: Apache-2.0
// Tables of data. Of comma-separated values (RFC 4180): the first line names the columns, cells may stand in
// double quotes, lines end in LF or CRLF, blank lines are skipped, a byte order mark is ignored. Of JSON (RFC
// 8259): an object of columns, {"t": [0, 0.1]}, or an array of rows, [{"t": 0}, {"t": 0.1}]; null is a blank
// cell. Cells stay text until they are used.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics.h"
#include "lang/source.h"

namespace hcsp::lang {

class Table {
 public:
  /// Reads the text of a source, which outlives the table. What is wrong with the text itself (no header,
  /// quotes that do not close, cells beyond the header) is reported; what is wrong with a cell is for its
  /// reader to say.
  static std::optional<Table> read_csv(const Source& source, Diagnostics& diagnostics);
  static std::optional<Table> read_json(const Source& source, Diagnostics& diagnostics);

  [[nodiscard]] const Source& source() const { return *source_; }
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return cells_.size() / columns_.size(); }
  /// The text of a cell without quotes and the blanks around it; rows and columns count from 0.
  [[nodiscard]] std::string cell(std::size_t row, std::size_t column) const;
  /// Whether the row is too short to have the cell.
  [[nodiscard]] bool is_missing(std::size_t row, std::size_t column) const { return at(row, column).missing; }
  [[nodiscard]] SourceRange range(std::size_t row, std::size_t column) const;
  /// The line of the file, from 1.
  [[nodiscard]] std::size_t line(std::size_t row) const;

 private:
  friend class CsvTableReader;
  friend class JsonTableReader;
  struct Cell {
    std::uint32_t begin = 0;
    std::uint32_t length : 30 = 0;
    std::uint32_t quoted : 1 = 0;
    std::uint32_t missing : 1 = 0;
  };
  static constexpr std::size_t kLongestCell = (std::size_t{1} << 30) - 1;
  static void set(Cell& cell, std::size_t begin, std::size_t end) {
    cell.begin = static_cast<std::uint32_t>(begin);
    cell.length = static_cast<std::uint32_t>(std::min(end - begin, kLongestCell)) & 0x3FFFFFFFU;
  }
  explicit Table(const Source& source) : source_(&source) {}
  [[nodiscard]] const Cell& at(std::size_t row, std::size_t column) const {
    return cells_[row * columns_.size() + column];
  }

  const Source* source_;
  std::vector<std::string> columns_;
  std::vector<Cell> cells_;  // row by row
};

}  // namespace hcsp::lang
