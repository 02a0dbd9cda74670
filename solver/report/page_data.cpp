// SPDX-License-Identifier: Apache-2.0
#include "solver/report/page_data.h"

#include <algorithm>
#include <cmath>

#include "solver/report/binary.h"
#include "solver/report/drawn.h"
#include "solver/report/paving_map.h"
#include "solver/report/text.h"

namespace hcsp::report {

namespace {

template <class List, class Write>
void put_list(TextBuffer& out, const List& list, Write write) {
  put(out, '[');
  bool first = true;
  for (const auto& item : list) {
    if (!first) put(out, ',');
    first = false;
    write(item);
  }
  put(out, ']');
}

void put_pair(TextBuffer& out, double lo, double hi) {
  put(out, '[');
  put_json_number(out, lo);
  put(out, ',');
  put_json_number(out, hi);
  put(out, ']');
}

void put_base64(TextBuffer& out, const Bytes& bytes) {
  put(out, '"');
  put(out, bytes.base64());
  put(out, '"');
}

void put_doubles(TextBuffer& out, const std::vector<double>& values) {
  Bytes bytes;
  for (const double value : values) bytes.put(value);
  put_base64(out, bytes);
}

// Whether the widths of a tube are so small beside its values that rounding bounds to float would blur them:
// by more than a thousandth of the mean width.
bool needs_double(const Tube& x) {
  for (std::size_t c = 0; c < x.dim(); ++c) {
    double largest = 0.0;
    double widths = 0.0;
    std::size_t bounded = 0;
    for (std::size_t item = 1; item < x.items(); item += 2) {
      const Interval slice = x.at(c, item);
      if (!slice.is_bounded()) continue;
      largest = std::max(largest, slice.mag());
      widths += slice.hi() - slice.lo();
      ++bounded;
    }
    if (bounded != 0 && widths / static_cast<double>(bounded) < 0x1p-13 * largest) return true;
  }
  return false;
}

// A variable that the page shows, and how all its domains are written.
struct Shown {
  std::string name;
  const Domain* last;     // its domain in the last frame where it is not empty
  std::size_t line = 0;   // of a tube
  bool is_wide = false;   // a tube in doubles
  bool is_drawn = false;  // a tube on phases
  std::size_t degree = 0;
};

void put_domain(TextBuffer& out, const Shown&, const Interval& x) {
  put(out, '[');
  put_pair(out, x.lo(), x.hi());
  put(out, ']');
}

void put_domain(TextBuffer& out, const Shown&, const Box& x) {
  put_list(out, x.components(),
           [&](const Interval& component) { put_pair(out, component.lo(), component.hi()); });
}

void put_domain(TextBuffer& out, const Shown& shown, const Tube& x) {
  Bytes bytes;
  for (std::size_t c = 0; c < x.dim(); ++c) {
    for (std::size_t item = 0; item < x.items(); ++item) {
      shown.is_wide ? bytes.put(x.lo(c)[item]) : bytes.put(float_below(x.lo(c)[item]));
    }
    for (std::size_t item = 0; item < x.items(); ++item) {
      shown.is_wide ? bytes.put(x.hi(c)[item]) : bytes.put(float_above(x.hi(c)[item]));
    }
  }
  put_base64(out, bytes);
}

void put_boxes(TextBuffer& out, const SetInterval& x, CellState state) {
  std::vector<std::int32_t> cells;
  bool is_wide = false;
  for (const std::vector<double>& box : x.boxes(state)) {
    for (const double bound : box) {
      const auto cell = static_cast<std::int32_t>(std::lround(std::clamp(bound / x.precision(), -2e9, 2e9)));
      is_wide = is_wide || cell < -32768 || cell > 32767;
      cells.push_back(cell);
    }
  }
  Bytes bytes;
  for (const std::int32_t cell : cells)
    is_wide ? bytes.put(cell) : bytes.put(static_cast<std::int16_t>(cell));
  put(out, is_wide ? R"({"wide":true,"boxes":)" : R"({"wide":false,"boxes":)");
  put_base64(out, bytes);
  put(out, '}');
}

// Drawn as a tube of known instants.
void put_domain(TextBuffer&, const Shown&, const PolynomialTube&) {}

void put_domain(TextBuffer& out, const Shown&, const SetInterval& x) {
  put(out, R"({"volume":)");
  put_pair(out, x.lower_volume(), x.upper_volume());
  fmt::format_to(fmt::appender(out), R"(,"background":"{}")",
                 x.background() == CellState::outside  ? "outside"
                 : x.background() == CellState::inside ? "inside"
                                                       : "unknown");
  if (x.dim() == 2) {
    const Region reach = x.reach();
    fmt::format_to(fmt::appender(out), R"(,"reach":[{},{},{},{}],"inside":)", reach.lo[0], reach.hi[0],
                   reach.lo[1], reach.hi[1]);
    put_boxes(out, x, CellState::inside);
    put(out, R"(,"unknown":)");
    put_boxes(out, x, CellState::unknown);
  }
  put(out, '}');
}

void put_variable(TextBuffer& out, const Shown& shown) {
  put(out, R"({"name":)");
  put_json_string(out, shown.name);
  if (const auto* tube = std::get_if<Tube>(shown.last)) {
    fmt::format_to(fmt::appender(out),
                   R"(,"kind":"tube","dim":{},"line":{},"wide":{},"drawn":{},"degree":{})", tube->dim(),
                   shown.line, shown.is_wide, shown.is_drawn, shown.degree);
  } else if (const auto* set = std::get_if<SetInterval>(shown.last)) {
    fmt::format_to(fmt::appender(out), R"(,"kind":"set","dim":{},"precision":{})", set->dim(),
                   set->precision());
  } else {
    const auto* box = std::get_if<Box>(shown.last);
    box == nullptr ? put(out, R"(,"kind":"real")")
                   : void(fmt::format_to(fmt::appender(out), R"(,"kind":"vector","dim":{})", box->dim()));
  }
  put(out, '}');
}

bool is_same(const ResultVariable* a, const ResultVariable* b) {
  return a != nullptr && b != nullptr && a->is_empty() == b->is_empty() && a->domain == b->domain;
}

const ResultVariable* find(const std::vector<ResultVariable>& variables, std::string_view name) {
  for (const ResultVariable& variable : variables) {
    if (variable.name == name) return &variable;
  }
  return nullptr;
}

struct Frame {
  std::uint64_t pass;
  const std::vector<ResultVariable>* variables;
};

// The passes, and the result itself where it is not the last of them.
std::vector<Frame> frames_of(const Result& result, const std::vector<const ResultVariable*>& shown) {
  std::vector<Frame> frames;
  for (const PassSnapshot& snapshot : result.snapshots)
    frames.push_back({snapshot.pass, &snapshot.variables});
  const bool is_there =
      !frames.empty() && std::all_of(shown.begin(), shown.end(), [&](const ResultVariable* variable) {
        const ResultVariable* kept = find(*frames.back().variables, variable->name);
        return kept == nullptr || is_same(kept, variable);
      });
  if (!is_there) frames.push_back({result.statistics.passes, &result.variables});
  return frames;
}

// A snapshot need not hold what never changes: such a variable has its final domain.
const ResultVariable* in_frame(const Frame& frame, const ResultVariable* variable) {
  const ResultVariable* kept = find(*frame.variables, variable->name);
  return kept != nullptr ? kept : variable;
}

void put_frames(TextBuffer& out, const std::vector<Frame>& frames,
                const std::vector<const ResultVariable*>& variables, const std::vector<Shown>& shown) {
  put(out, "\"frames\":");
  put_list(out, frames, [&](const Frame& frame) {
    fmt::format_to(fmt::appender(out), "{{\"pass\":{},\"domains\":[", frame.pass);
    for (std::size_t i = 0; i < variables.size(); ++i) {
      if (i != 0) put(out, ',');
      const ResultVariable* now = in_frame(frame, variables[i]);
      const bool is_first = &frame == &frames.front();
      if (now->is_empty()) {
        put(out, "null");
      } else if (!is_first && is_same(now, in_frame(*(&frame - 1), variables[i]))) {
        put(out, '0');
      } else {
        std::visit([&](const auto& domain) { put_domain(out, shown[i], domain); }, now->domain);
      }
    }
    put(out, "]}");
  });
}

void put_explanation(TextBuffer& out, const Explanation& why) {
  put(out, R"({"constraint":)");
  put_json_string(out, why.constraint);
  put(out, R"(,"variable":)");
  put_json_string(out, why.variable);
  put(out, R"(,"time":)");
  why.time ? put_pair(out, (*why.time)[0], (*why.time)[1]) : put(out, "null");
  put(out, why.support_is_complete ? R"(,"complete":true,"readings":)" : R"(,"complete":false,"readings":)");
  put_list(out, why.support, [&](const SupportingReading& reading) {
    put(out, '[');
    put_json_string(out, reading.variable);
    put(out, ',');
    put_json_number(out, reading.time);
    put(out, ',');
    put_json_string(out, reading.source);
    put(out, ']');
  });
  put(out, '}');
}

// The boxes of a search, the first of them where there are many: per box its certificate, its reason, and for
// each variable its sides.
void put_search(TextBuffer& out, const SolutionSet& search, const Presentation& presentation) {
  constexpr std::size_t kShown = 1000;
  const std::vector<Solution> first(
      search.solutions.begin(),
      search.solutions.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, search.solutions.size())));
  fmt::format_to(fmt::appender(out), R"({{"cells":{},"boxes":{},"unexplored":{},"solutions":)", search.cells,
                 search.solutions.size(), search.unexplored.size());
  put_list(out, first, [&](const Solution& solution) {
    fmt::format_to(fmt::appender(out), R"(["{}","{}",)", to_string(solution.certificate),
                   to_string(solution.reason));
    put_list(out, shown_variables(solution.variables, presentation), [&](const ResultVariable* variable) {
      std::vector<Interval> sides;
      if (const auto* real = std::get_if<Interval>(&variable->domain)) sides = {*real};
      if (const auto* box = std::get_if<Box>(&variable->domain))
        sides.assign(box->components().begin(), box->components().end());
      put_list(out, sides, [&](const Interval& side) { put_pair(out, side.lo(), side.hi()); });
    });
    put(out, ']');
  });
  put(out, '}');
}

void put_paving(TextBuffer& out, const Paving& paving) {
  const PavingMap map = paving_map(paving);
  put(out, R"({"names":)");
  put_list(out, paving.names, [&](const std::string& name) { put_json_string(out, name); });
  fmt::format_to(fmt::appender(out), R"(,"cells":{},"projected":{},"strip":{},"stretch":)", paving.cells,
                 map.is_projected, map.names[1].empty());
  put_json_number(out, map.stretch);
  put(out, R"(,"volume":)");
  put_pair(out, paving.inside_volume, paving.inside_volume + paving.boundary_volume);
  put(out, R"(,"reach":)");
  put_list(out, map.frame, [&](double bound) { put_json_number(out, bound); });
  put(out, R"(,"inside":)");
  put_doubles(out, map.inside);
  put(out, R"(,"boundary":)");
  put_doubles(out, map.boundary);
  put(out, R"(,"unexplored":)");
  put_doubles(out, map.unexplored);
  put(out, '}');
}

void put_truth(TextBuffer& out, const Truth& truth) {
  put(out, R"({"t":)");
  put_doubles(out, truth.t);
  put(out, R"(,"tubes":{)");
  bool first = true;
  for (const auto& [name, rows] : truth.tubes) {
    if (!first) put(out, ',');
    first = false;
    put_json_string(out, name);
    put(out, ':');
    std::vector<double> values;
    for (const std::vector<double>& row : rows) values.insert(values.end(), row.begin(), row.end());
    put_doubles(out, values);
  }
  put(out, "}}");
}

void put_head(TextBuffer& out, const Result& result, const Presentation& presentation) {
  put(out, R"({"hcsp":")" HCSP_VERSION R"(","model":)");
  put_json_string(out, result.model);
  put(out, R"(,"status":)");
  put_json_string(out, to_string(result.status));
  put(out, R"(,"seconds":)");
  put_json_number(out, result.statistics.seconds);
  fmt::format_to(fmt::appender(out), R"(,"passes":{},"threads":{},"contractors":)", result.statistics.passes,
                 result.statistics.threads);
  put_list(out, result.statistics.contractors, [&](const ContractorStatistics& contractor) {
    put(out, '[');
    put_json_string(out, contractor.name);
    fmt::format_to(fmt::appender(out), ",{},", contractor.calls);
    put_json_number(out, contractor.seconds);
    put(out, ']');
  });
  put(out, ",\"explanation\":");
  result.explanation ? put_explanation(out, *result.explanation) : put(out, "null");
  put(out, ",\"search\":");
  result.search ? put_search(out, *result.search, presentation) : put(out, "null");
  put(out, ",\"objective\":");
  const bool has_objective = result.objective && !result.objective->is_empty();
  has_objective ? put_pair(out, result.objective->lo(), result.objective->hi()) : put(out, "null");
  put(out, ",\"paving\":");
  result.paving ? put_paving(out, *result.paving) : put(out, "null");
}

}  // namespace

std::vector<const ResultVariable*> shown_variables(const std::vector<ResultVariable>& variables,
                                                   const Presentation& presentation) {
  return select(variables, presentation.shown);
}

std::string page_data(const Result& result, const Presentation& presentation) {
  if (const auto shown_result = drawn(result)) return page_data(*shown_result, presentation);
  const std::vector<const ResultVariable*> variables = shown_variables(result.variables, presentation);
  const std::vector<Frame> frames = frames_of(result, variables);
  std::vector<Shown> shown;
  std::vector<const TimeLine*> lines;
  for (const ResultVariable* variable : variables) {
    Shown how{variable->name, &variable->domain};
    for (const Frame& frame : frames) {
      const ResultVariable* now = in_frame(frame, variable);
      if (!now->is_empty()) how.last = &now->domain;
    }
    if (const auto* tube = std::get_if<Tube>(how.last)) {
      const auto known =
          std::find_if(lines.begin(), lines.end(), [&](const auto* line) { return *line == tube->line(); });
      how.line = static_cast<std::size_t>(known - lines.begin());
      if (known == lines.end()) lines.push_back(&tube->line());
      how.is_wide = needs_double(*tube);
      how.is_drawn = variable->shape.is_drawn;
      how.degree = variable->shape.degree;
    }
    shown.push_back(how);
  }
  TextBuffer out;
  put_head(out, result, presentation);
  put(out, ",\n\"lines\":");
  put_list(out, lines, [&](const TimeLine* line) { put_doubles(out, line->instants()); });
  put(out, ",\n\"variables\":");
  put_list(out, shown, [&](const Shown& variable) { put_variable(out, variable); });
  put(out, ",\n");
  put_frames(out, frames, variables, shown);
  put(out, ",\n\"truth\":");
  presentation.truth ? put_truth(out, *presentation.truth) : put(out, "null");
  put(out, "}\n");
  return to_text(out);
}

}  // namespace hcsp::report
