// SPDX-License-Identifier: Apache-2.0
#include "solver/report/json.h"

#include <algorithm>
#include <span>

#include "solver/report/segments.h"
#include "solver/report/text.h"

namespace hcsp {

namespace {

using report::NumberTexts;
using report::put;
using report::put_json_number;
using report::put_json_string;
using report::TextBuffer;

void put_key(TextBuffer& out, std::string_view key) {
  put_json_string(out, key);
  put(out, ": ");
}

// A number of the long arrays.
void put_number(TextBuffer& out, NumberTexts& texts, double value) {
  const std::string_view text = texts.of(value);
  if (text.back() != 'o') return put(out, text);
  put(out, '"');
  put(out, text);
  put(out, '"');
}

// [f(0), f(1), ...], each written by write(i).
template <class Write>
void put_list(TextBuffer& out, std::size_t size, Write write) {
  put(out, '[');
  for (std::size_t i = 0; i < size; ++i) {
    if (i != 0) put(out, ',');
    write(i);
  }
  put(out, ']');
}

void put_numbers(TextBuffer& out, NumberTexts& texts, std::span<const double> values) {
  put_list(out, values.size(), [&](std::size_t i) { put_number(out, texts, values[i]); });
}

void put_bounds(TextBuffer& out, std::string_view kind, const Interval& x) {
  fmt::format_to(fmt::appender(out), R"("kind": "{}", "lo": )", kind);
  put_json_number(out, x.lo());
  put(out, R"(, "hi": )");
  put_json_number(out, x.hi());
}

void put_boolean(TextBuffer& out, const Interval& x) {
  fmt::format_to(fmt::appender(out), R"("kind": "bool", "lo": {}, "hi": {})", x.lo() != 0, x.hi() != 0);
}

void put_domain(TextBuffer& out, NumberTexts&, const Interval& x) { put_bounds(out, "real", x); }

void put_domain(TextBuffer& out, NumberTexts&, const Box& x) {
  const auto component = [&](std::size_t i) -> const Interval& { return x[static_cast<Eigen::Index>(i)]; };
  const auto dim = static_cast<std::size_t>(x.dim());
  put(out, R"("kind": "vector", "lo": )");
  put_list(out, dim, [&](std::size_t i) { put_json_number(out, component(i).lo()); });
  put(out, R"(, "hi": )");
  put_list(out, dim, [&](std::size_t i) { put_json_number(out, component(i).hi()); });
}

// Rows of components, of every second item from `first` on: the gates from 0, the slices from 1.
void put_items(TextBuffer& out, NumberTexts& texts, const Tube& x, std::size_t first) {
  const std::size_t rows = (x.items() - first + 1) / 2;
  const auto put_bound = [&](const double* (Tube::*bound)(std::size_t) const) {
    put_list(out, rows, [&](std::size_t row) {
      put_list(out, x.dim(), [&](std::size_t c) { put_number(out, texts, (x.*bound)(c)[2 * row + first]); });
    });
  };
  put(out, R"({"lo": )");
  put_bound(&Tube::lo);
  put(out, R"(, "hi": )");
  put_bound(&Tube::hi);
  put(out, '}');
}

void put_domain(TextBuffer& out, NumberTexts& texts, const Tube& x) {
  fmt::format_to(fmt::appender(out), R"("kind": "tube", "dim": {}, "time": )", x.dim());
  put_numbers(out, texts, x.line().instants());
  put(out, ",\n      \"gates\": ");
  put_items(out, texts, x, 0);
  put(out, ",\n      \"slices\": ");
  put_items(out, texts, x, 1);
}

// The middles of the instants in "time", their bounds in "instants".
void put_domain(TextBuffer& out, NumberTexts& texts, const PolynomialTube& x) {
  const auto put_bounds_of = [&](std::size_t rows, const auto& value) {
    for (const bool is_lower : {true, false}) {
      put(out, is_lower ? R"({"lo": )" : R"(, "hi": )");
      put_list(out, rows, [&](std::size_t row) { value(row, is_lower); });
    }
    put(out, '}');
  };
  const auto number = [&](const Interval& value, bool is_lower) {
    put_number(out, texts, is_lower ? value.lo() : value.hi());
  };
  fmt::format_to(fmt::appender(out), R"("kind": "tube", "dim": {}, "time": )", x.dim());
  put_list(out, x.phases() + 1, [&](std::size_t k) { put_number(out, texts, x.instant(k).mid()); });
  put(out, ",\n      \"instants\": ");
  put_bounds_of(x.phases() + 1, [&](std::size_t k, bool is_lower) { number(x.instant(k), is_lower); });
  put(out, ",\n      \"gates\": ");
  put_bounds_of(x.phases() + 1, [&](std::size_t k, bool is_lower) {
    put_list(out, x.dim(), [&](std::size_t c) { number(x.gate(c, k), is_lower); });
  });
  put(out, ",\n      \"slices\": ");
  put_bounds_of(x.phases(), [&](std::size_t i, bool is_lower) {
    put_list(out, x.dim(), [&](std::size_t c) { number(x.slice(c, i), is_lower); });
  });
}

void put_boxes(TextBuffer& out, NumberTexts& texts, const SetInterval& x, CellState state) {
  const std::vector<std::vector<double>> boxes = x.boxes(state);
  put_list(out, boxes.size(), [&](std::size_t i) { put_numbers(out, texts, boxes[i]); });
}

void put_domain(TextBuffer& out, NumberTexts& texts, const SetInterval& x) {
  fmt::format_to(fmt::appender(out), R"("kind": "set", "dim": {}, "precision": )", x.dim());
  put_json_number(out, x.precision());
  fmt::format_to(fmt::appender(out), R"(, "background": "{}")",
                 x.background() == CellState::outside  ? "outside"
                 : x.background() == CellState::inside ? "inside"
                                                       : "unknown");
  put(out, ",\n      \"inside\": ");
  put_boxes(out, texts, x, CellState::inside);
  put(out, ",\n      \"unknown\": ");
  put_boxes(out, texts, x, CellState::unknown);
  put(out, ",\n      \"volume\": {\"lower\": ");
  put_json_number(out, x.lower_volume());
  put(out, R"(, "upper": )");
  put_json_number(out, x.upper_volume());
  put(out, '}');
}

void put_matrix(TextBuffer& out, const Box& x, std::size_t columns) {
  const auto put_bound = [&](double (Interval::*bound)() const) {
    put_list(out, static_cast<std::size_t>(x.dim()) / columns, [&](std::size_t row) {
      put_list(out, columns, [&](std::size_t column) {
        put_json_number(out, (x[static_cast<Eigen::Index>(row * columns + column)].*bound)());
      });
    });
  };
  put(out, R"("kind": "matrix", "lo": )");
  put_bound(&Interval::lo);
  put(out, R"(, "hi": )");
  put_bound(&Interval::hi);
}

void put_variable(TextBuffer& out, NumberTexts& texts, const ResultVariable& variable) {
  if (variable.is_empty()) {
    put(out, "null");
    return;
  }
  put(out, "{ ");
  if (variable.shape.scalar == Shape::Scalar::boolean) {
    put_boolean(out, std::get<Interval>(variable.domain));
  } else if (variable.shape.scalar == Shape::Scalar::whole) {
    put_bounds(out, "int", std::get<Interval>(variable.domain));
  } else if (variable.shape.columns != 0) {
    put_matrix(out, std::get<Box>(variable.domain), variable.shape.columns);
  } else {
    std::visit([&](const auto& domain) { put_domain(out, texts, domain); }, variable.domain);
  }
  put(out, " }");
}

// The elements of an array along its k-th index; they stand in the order of their indices.
void put_array(TextBuffer& out, NumberTexts& texts, std::span<const ResultVariable> elements, std::size_t k) {
  put(out, R"({ "kind": "array", "items": [)");
  for (std::size_t first = 0, next = 0; first < elements.size(); first = next) {
    const int index = elements[first].shape.indices[k];
    while (next < elements.size() && elements[next].shape.indices[k] == index) ++next;
    put(out, first == 0 ? "\n      " : ",\n      ");
    const bool is_last = k + 1 == elements[first].shape.indices.size();
    is_last ? put_variable(out, texts, elements[first])
            : put_array(out, texts, elements.subspan(first, next - first), k + 1);
  }
  put(out, "] }");
}

void put_variables(TextBuffer& out, NumberTexts& texts, std::span<const ResultVariable> variables) {
  put(out, "\"variables\": {");
  for (std::size_t first = 0, next = 0; first < variables.size(); first = next) {
    const std::string& array = variables[first].shape.array;
    next = first + 1;
    while (!array.empty() && next < variables.size() && variables[next].shape.array == array) ++next;
    put(out, first == 0 ? "\n    " : ",\n    ");
    put_key(out, array.empty() ? variables[first].name : array);
    array.empty() ? put_variable(out, texts, variables[first])
                  : put_array(out, texts, variables.subspan(first, next - first), 0);
  }
  put(out, variables.empty() ? "}" : "\n  }");
}

void put_search(TextBuffer& out, NumberTexts& texts, const SolutionSet& search) {
  put(out, "  \"solutions\": ");
  put_list(out, search.solutions.size(), [&](std::size_t i) {
    const Solution& solution = search.solutions[i];
    fmt::format_to(fmt::appender(out), "\n  {{ \"certificate\": \"{}\", ", to_string(solution.certificate));
    if (solution.reason != Reason::proven)
      fmt::format_to(fmt::appender(out), "\"reason\": \"{}\", ", to_string(solution.reason));
    put_variables(out, texts, solution.variables);
    put(out, " }");
  });
  put(out, ",\n  \"unexplored\": ");
  put_list(out, search.unexplored.size(), [&](std::size_t i) {
    put(out, "\n  { ");
    put_variables(out, texts, search.unexplored[i]);
    put(out, " }");
  });
  put(out, ",\n");
}

void put_objective(TextBuffer& out, const Interval& objective) {
  put(out, "  \"objective\": ");
  if (objective.is_empty()) return put(out, "null,\n");
  put(out, R"({ "lo": )");
  put_json_number(out, objective.lo());
  put(out, R"(, "hi": )");
  put_json_number(out, objective.hi());
  put(out, " },\n");
}

// Boxes as lists [lo1, hi1, lo2, hi2, ...].
void put_boxes(TextBuffer& out, NumberTexts& texts, const std::vector<Interval>& boxes, std::size_t dim) {
  put_list(out, boxes.size() / dim, [&](std::size_t k) {
    put(out, k % 4 == 0 ? "\n      [" : " [");
    for (std::size_t i = 2 * k * dim; i < 2 * (k + 1) * dim; ++i) {
      if (i != 2 * k * dim) put(out, ", ");
      put_number(out, texts, i % 2 == 0 ? boxes[i / 2].lo() : boxes[i / 2].hi());
    }
    put(out, ']');
  });
}

void put_paving(TextBuffer& out, NumberTexts& texts, const Paving& paving) {
  const std::size_t dim = paving.names.size();
  put(out, "  \"paving\": {\n    \"names\": ");
  put_list(out, dim, [&](std::size_t v) { put_json_string(out, paving.names[v]); });
  put(out, ",\n    \"volume\": { \"inside\": ");
  put_json_number(out, paving.inside_volume);
  put(out, ", \"boundary\": ");
  put_json_number(out, paving.boundary_volume);
  put(out, " },\n    \"inside\": ");
  put_boxes(out, texts, paving.inside, dim);
  put(out, ",\n    \"boundary\": ");
  put_boxes(out, texts, paving.boundary, dim);
  put(out, ",\n    \"outside\": ");
  put_boxes(out, texts, paving.outside, dim);
  put(out, "\n  },\n  \"unexplored\": ");
  put_boxes(out, texts, paving.unexplored, dim);
  put(out, ",\n");
}

void put_explanation(TextBuffer& out, NumberTexts& texts, const Explanation& why) {
  put(out, "  \"explanation\": {\n    \"constraint\": ");
  put_json_string(out, why.constraint);
  put(out, ", \"variable\": ");
  put_json_string(out, why.variable);
  if (why.time) {
    put(out, ", \"time\": ");
    put_numbers(out, texts, *why.time);
  }
  std::vector<double> instants;
  for (const SupportingReading& reading : why.support) instants.push_back(reading.time);
  std::sort(instants.begin(), instants.end());
  instants.erase(std::unique(instants.begin(), instants.end()), instants.end());
  put(out, ",\n    \"support\": ");
  put_numbers(out, texts, instants);
  put(out,
      why.support_is_complete ? R"(, "support_is_complete": true)" : R"(, "support_is_complete": false)");
  put(out, ",\n    \"readings\": ");
  put_list(out, why.support.size(), [&](std::size_t i) {
    put(out, "\n      { \"variable\": ");
    put_json_string(out, why.support[i].variable);
    put(out, ", \"time\": ");
    put_json_number(out, why.support[i].time);
    put(out, ", \"source\": ");
    put_json_string(out, why.support[i].source);
    put(out, " }");
  });
  put(out, "\n  },\n");
}

// A name that several contractors share is one entry: an object of JSON has no name twice.
std::vector<ContractorStatistics> by_name(const std::vector<ContractorStatistics>& all) {
  std::vector<ContractorStatistics> merged;
  for (const ContractorStatistics& entry : all) {
    const auto same =
        std::find_if(merged.begin(), merged.end(), [&](const auto& m) { return m.name == entry.name; });
    if (same == merged.end()) {
      merged.push_back(entry);
    } else {
      same->calls += entry.calls;
      same->seconds += entry.seconds;
    }
  }
  return merged;
}

void put_statistics(TextBuffer& out, const Result& result) {
  const Statistics& statistics = result.statistics;
  put(out, "  \"statistics\": {\n    \"seconds\": ");
  put_json_number(out, statistics.seconds);
  if (result.search) fmt::format_to(fmt::appender(out), ", \"cells\": {}", result.search->cells);
  if (result.paving) fmt::format_to(fmt::appender(out), ", \"cells\": {}", result.paving->cells);
  fmt::format_to(fmt::appender(out), ", \"passes\": {}, \"threads\": {},\n    \"contractors\": {{",
                 statistics.passes, statistics.threads);
  bool first = true;
  for (const ContractorStatistics& contractor : by_name(statistics.contractors)) {
    put(out, first ? "\n      " : ",\n      ");
    first = false;
    put_key(out, contractor.name);
    fmt::format_to(fmt::appender(out), R"({{ "calls": {}, "seconds": )", contractor.calls);
    put_json_number(out, contractor.seconds);
    put(out, " }");
  }
  put(out, "\n    }\n  }\n");
}

}  // namespace

std::string to_json(const Result& result) {
  TextBuffer out;
  NumberTexts texts;
  put(out, "{ \"hcsp\": \"" HCSP_VERSION "\", \"model\": ");
  put_json_string(out, result.model);
  put(out, ",\n  \"status\": ");
  put_json_string(out, to_string(result.status));
  put(out, ",\n");
  put(out, "  ");
  put_variables(out, texts, result.variables);
  put(out, ",\n");
  if (result.search) put_search(out, texts, *result.search);
  if (result.objective) put_objective(out, *result.objective);
  if (result.paving) put_paving(out, texts, *result.paving);
  if (report::has_segments(result)) {
    put(out, "  \"segments\": ");
    report::put_segments(out, result);
    put(out, ",\n");
  }
  if (result.explanation) put_explanation(out, texts, *result.explanation);
  put_statistics(out, result);
  put(out, "}\n");
  return report::to_text(out);
}

}  // namespace hcsp
