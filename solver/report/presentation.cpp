// SPDX-License-Identifier: Apache-2.0
#include "solver/report/presentation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace hcsp {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t from = 0; from <= line.size();) {
    const std::size_t to = std::min(line.find(',', from), line.size());
    cells.push_back(trimmed(line.substr(from, to - from)));
    from = to + 1;
  }
  return cells;
}

// Where a tube's components stand among the columns.
struct TubeColumns {
  std::string name;
  std::vector<std::size_t> columns;
};

std::optional<std::size_t> find_column(const std::vector<std::string_view>& names,
                                       const std::string& wanted) {
  const auto found = std::find(names.begin(), names.end(), wanted);
  if (found == names.end()) return {};
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<TubeColumns> columns_of(const ResultVariable& variable,
                                      const std::vector<std::string_view>& names) {
  const auto* tube = std::get_if<Tube>(&variable.domain);
  if (tube == nullptr) return {};
  TubeColumns found{variable.name, {}};
  for (std::size_t c = 1; c <= tube->dim(); ++c) {
    std::optional<std::size_t> column = find_column(names, fmt::format("{}[{}]", variable.name, c));
    if (!column) column = find_column(names, fmt::format("{}{}", variable.name, c));
    if (!column && tube->dim() == 1) column = find_column(names, variable.name);
    if (!column) return {};
    found.columns.push_back(*column);
  }
  return found;
}

std::optional<double> number_in(std::string_view cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return {};
  return value;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  if (text.substr(0, 3) == "\xef\xbb\xbf") text.remove_prefix(3);  // a byte order mark
  std::vector<std::string_view> lines;
  for (std::size_t from = 0; from < text.size();) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    lines.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return lines;
}

struct Layout {
  std::size_t time = 0;
  std::vector<TubeColumns> tubes;
};

// Adds one line to the truth; says what is wrong otherwise.
std::string read_row(std::string_view line, const Layout& layout, Truth& truth) {
  const std::vector<std::string_view> cells = cells_of(line);
  const auto value_at = [&](std::size_t column) {
    return column < cells.size() ? number_in(cells[column]) : std::nullopt;
  };
  const std::optional<double> t = value_at(layout.time);
  if (!t) return "expected a number in column t";
  if (!truth.t.empty() && *t <= truth.t.back()) return "the instants of column t must increase";
  for (const TubeColumns& tube : layout.tubes) {
    std::vector<double> row;
    for (const std::size_t column : tube.columns) {
      const std::optional<double> value = value_at(column);
      if (!value) return fmt::format("expected a number in column {}", column + 1);
      row.push_back(*value);
    }
    truth.tubes[tube.name].push_back(std::move(row));
  }
  truth.t.push_back(*t);
  return {};
}

}  // namespace

std::optional<Truth> read_truth(std::string_view csv_text, const Result& result, std::string& error) {
  const std::vector<std::string_view> lines = lines_of(csv_text);
  if (lines.empty()) {
    error = "line 1: expected a header with a column t";
    return {};
  }
  const std::vector<std::string_view> names = cells_of(lines.front());
  const std::optional<std::size_t> time = find_column(names, "t");
  if (!time) {
    error = "line 1: expected a column t";
    return {};
  }
  Layout layout{*time, {}};
  for (const ResultVariable& variable : result.variables) {
    if (auto columns = columns_of(variable, names)) layout.tubes.push_back(std::move(*columns));
  }
  if (layout.tubes.empty()) {
    error =
        "line 1: no column names a tube of the result (x1 and x2, or x[1] and x[2], for a tube x of "
        "dimension 2)";
    return {};
  }
  Truth truth;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (trimmed(lines[i]).empty()) continue;
    const std::string wrong = read_row(lines[i], layout, truth);
    if (wrong.empty()) continue;
    error = fmt::format("line {}: {}", i + 1, wrong);
    return {};
  }
  return truth;
}

}  // namespace hcsp
