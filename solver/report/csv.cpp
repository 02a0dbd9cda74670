// SPDX-License-Identifier: Apache-2.0
#include "solver/report/csv.h"

#include "solver/report/segments.h"
#include "solver/report/text.h"

namespace hcsp {

namespace {

using report::NumberTexts;
using report::put;
using report::TextBuffer;

std::size_t components(const Domain& domain) {
  if (const auto* box = std::get_if<Box>(&domain)) return static_cast<std::size_t>(box->dim());
  if (const auto* tube = std::get_if<Tube>(&domain)) return tube->dim();
  return std::holds_alternative<Interval>(domain) ? 1 : 0;
}

// A real and a tube of dimension 1 have the bare name.
bool is_indexed(const Domain& domain) {
  return std::holds_alternative<Box>(domain) || components(domain) > 1;
}

// `leading` are the columns before those of the unknowns.
void put_header(TextBuffer& out, const Result& result, std::string_view leading) {
  std::string_view separator = leading.empty() ? "" : ",";
  put(out, leading);
  for (const ResultVariable& variable : result.variables) {
    for (std::size_t c = 0; c < components(variable.domain); ++c) {
      const std::string name =
          is_indexed(variable.domain) ? fmt::format("{}[{}]", variable.name, c + 1) : variable.name;
      fmt::format_to(fmt::appender(out), "{}{}.lo,{}.hi", separator, name, name);
      separator = ",";
    }
  }
  put(out, '\n');
}

// One column of the table: the bounds of a component.
struct Column {
  const ResultVariable* variable;
  std::size_t component;
  bool is_blank;  // of an empty domain, or on another time line than the table
};

std::vector<Column> columns_of(const std::vector<ResultVariable>& variables, const TimeLine* line) {
  std::vector<Column> columns;
  for (const ResultVariable& variable : variables) {
    const auto* tube = std::get_if<Tube>(&variable.domain);
    const bool is_elsewhere = tube != nullptr && &tube->line() != line && tube->line() != *line;
    for (std::size_t c = 0; c < components(variable.domain); ++c) {
      columns.push_back({&variable, c, is_elsewhere || variable.is_empty()});
    }
  }
  return columns;
}

Interval bounds(const Column& column, std::size_t item) {
  const Domain& domain = column.variable->domain;
  if (const auto* tube = std::get_if<Tube>(&domain)) return tube->at(column.component, item);
  if (const auto* box = std::get_if<Box>(&domain)) return (*box)[static_cast<Eigen::Index>(column.component)];
  return std::get<Interval>(domain);
}

void put_row(TextBuffer& out, NumberTexts& texts, const std::vector<Column>& columns, std::size_t item) {
  for (const Column& column : columns) {
    const Interval x = column.is_blank ? Interval::empty() : bounds(column, item);
    if (!column.is_blank) put(out, texts.of(x.lo()));
    put(out, ',');
    if (!column.is_blank) put(out, texts.of(x.hi()));
    put(out, ',');
  }
  if (out.size() != 0 && out[out.size() - 1] == ',') out.resize(out.size() - 1);
  put(out, '\n');
}

// A row a box.
std::string search_csv(const Result& result) {
  TextBuffer out;
  NumberTexts texts;
  put_header(out, result,
             result.objective ? "certificate,reason,objective.lo,objective.hi" : "certificate,reason");
  const auto put_box = [&](const std::vector<ResultVariable>& box, std::string_view certificate,
                           std::string_view reason) {
    fmt::format_to(fmt::appender(out), "{},{},", certificate, reason);
    if (result.objective) {
      put(out, texts.of(result.objective->lo()));
      put(out, ',');
      put(out, texts.of(result.objective->hi()));
      put(out, ',');
    }
    put_row(out, texts, columns_of(box, nullptr), 0);
  };
  for (const Solution& solution : result.search->solutions)
    put_box(solution.variables, to_string(solution.certificate), to_string(solution.reason));
  for (const auto& box : result.search->unexplored) put_box(box, to_string(Certificate::none), "unexplored");
  return report::to_text(out);
}

// A row a box, with its kind.
std::string paving_csv(const Paving& paving) {
  TextBuffer out;
  NumberTexts texts;
  put(out, "kind");
  for (const std::string& name : paving.names) fmt::format_to(fmt::appender(out), ",{}.lo,{}.hi", name, name);
  put(out, '\n');
  const auto put_rows = [&](std::string_view kind, const std::vector<Interval>& boxes) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (i % paving.names.size() == 0) put(out, kind);
      put(out, ',');
      put(out, texts.of(boxes[i].lo()));
      put(out, ',');
      put(out, texts.of(boxes[i].hi()));
      if ((i + 1) % paving.names.size() == 0) put(out, '\n');
    }
  };
  put_rows("inside", paving.inside);
  put_rows("boundary", paving.boundary);
  put_rows("outside", paving.outside);
  put_rows("unexplored", paving.unexplored);
  return report::to_text(out);
}

}  // namespace

std::string to_csv(const Result& result) {
  if (report::has_segments(result)) return report::segments_csv(result);
  if (result.search) return search_csv(result);
  if (result.paving) return paving_csv(*result.paving);
  const TimeLine* line = nullptr;  // of the first tube: all tubes of a model stand on one line
  for (const ResultVariable& variable : result.variables) {
    const auto* tube = std::get_if<Tube>(&variable.domain);
    if (tube != nullptr && line == nullptr) line = &tube->line();
  }
  TextBuffer out;
  put_header(out, result, line != nullptr ? "t_lo,t_hi" : "");
  const std::vector<Column> columns = columns_of(result.variables, line);
  NumberTexts texts;
  const std::size_t rows = line == nullptr ? 1 : line->items();
  for (std::size_t item = 0; item < rows; ++item) {
    if (line != nullptr) {
      put(out, texts.of(line->instants()[item / 2]));
      put(out, ',');
      put(out, texts.of(line->instants()[(item + 1) / 2]));
      put(out, ',');
    }
    put_row(out, texts, columns, item);
  }
  return report::to_text(out);
}

}  // namespace hcsp
