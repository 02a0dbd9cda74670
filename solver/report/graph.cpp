// SPDX-License-Identifier: Apache-2.0
#include "solver/report/graph.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "solver/engine/graph.h"
#include "solver/report/text.h"

namespace hcsp {

namespace {

using report::put;
using report::TextBuffer;

// A contractor and a variable that it reads, contracts, or both.
struct Edge {
  std::size_t contractor;
  std::size_t variable;
  bool reads = false;
  bool writes = false;
};

std::vector<Edge> edges_of(const ContractorGraph& graph) {
  std::vector<Edge> edges;
  const auto edge = [&](std::size_t contractor, std::size_t variable) -> Edge& {
    for (Edge& each : edges) {
      if (each.contractor == contractor && each.variable == variable) return each;
    }
    return edges.emplace_back(Edge{contractor, variable});
  };
  for (std::size_t c = 0; c < graph.contractors().size(); ++c) {
    for (const VariableId v : graph.contractors()[c]->reads()) edge(c, v).reads = true;
    for (const VariableId v : graph.contractors()[c]->writes()) edge(c, v).writes = true;
  }
  return edges;
}

// A string of Graphviz with its quotes.
std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' ? ' ' : c;
  }
  return out + '"';
}

// The rows of variables and contractors, so ordered that few edges cross: again and again each side is sorted
// by the mean row of its neighbours on the other (Sugiyama, Tagawa and Toda 1981).
struct Rows {
  std::vector<double> variables, contractors;
};

void sort_by_neighbours(std::vector<double>& rows, const std::vector<double>& others,
                        const std::vector<Edge>& edges, std::size_t Edge::*own, std::size_t Edge::*other) {
  std::vector<double> sum(rows.size(), 0.0);
  std::vector<double> count(rows.size(), 0.0);
  for (const Edge& edge : edges) {
    sum[edge.*own] += others[edge.*other];
    ++count[edge.*own];
  }
  const auto mean = [&](std::size_t i) { return count[i] > 0.0 ? sum[i] / count[i] : rows[i]; };
  std::vector<std::size_t> order(rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return mean(a) < mean(b); });
  for (std::size_t row = 0; row < order.size(); ++row) rows[order[row]] = static_cast<double>(row);
}

Rows rows_of(const ContractorGraph& graph, const std::vector<Edge>& edges) {
  Rows rows{std::vector<double>(graph.variables().size()), std::vector<double>(graph.contractors().size())};
  std::iota(rows.variables.begin(), rows.variables.end(), 0.0);
  std::iota(rows.contractors.begin(), rows.contractors.end(), 0.0);
  for (int sweep = 0; sweep < 8; ++sweep) {
    sort_by_neighbours(rows.contractors, rows.variables, edges, &Edge::contractor, &Edge::variable);
    sort_by_neighbours(rows.variables, rows.contractors, edges, &Edge::variable, &Edge::contractor);
  }
  return rows;
}

// Where a side's nodes stand: spread over the height of the picture.
double place(double row, std::size_t count, double height) {
  return 64 + (row + 0.5) * (height - 64) / static_cast<double>(std::max<std::size_t>(count, 1));
}

double half_width(std::string_view name) { return 16 + 4.1 * static_cast<double>(name.size()); }

constexpr std::string_view kHead = R"(<title>Contractor graph</title>
<style>
text { font: 14px ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; fill: #16202c; text-anchor: middle; }
.head { font: 600 13px system-ui, "Segoe UI", Roboto, "DejaVu Sans", sans-serif; fill: #5b6776; }
.variable { fill: #d9ecf8; stroke: #2f7fb2; stroke-width: 1.5; }
.hidden { stroke-dasharray: 4 3; }
.contractor { fill: #fbeccf; stroke: #a8740a; stroke-width: 1.5; }
.edge { stroke: #5b6776; stroke-width: 1.3; fill: none; }
</style>
<defs><marker id="arrow" viewBox="0 0 10 10" refX="9" refY="5" markerWidth="8" markerHeight="8"
  orient="auto-start-reverse"><path d="M0 1L10 5L0 9z" fill="#5b6776"/></marker></defs>
<rect width="100%" height="100%" fill="#ffffff"/>
)";

void put_variables(TextBuffer& out, const ContractorGraph& graph, const Rows& rows, double x, double height) {
  const std::size_t count = graph.variables().size();
  for (std::size_t v = 0; v < count; ++v) {
    const auto& variable = graph.variables()[v];
    const double y = place(rows.variables[v], count, height);
    fmt::format_to(fmt::appender(out),
                   "<ellipse class=\"variable{0}\" cx=\"{1:.1f}\" cy=\"{2:.1f}\" rx=\"{3:.1f}\" ry=\"18\"/>"
                   "<text x=\"{1:.1f}\" y=\"{4:.1f}\">{5}</text>\n",
                   variable.hidden() ? " hidden" : "", x, y, half_width(variable.name()), y + 5,
                   report::xml_escape(variable.name()));
  }
}

void put_contractors(TextBuffer& out, const ContractorGraph& graph, const Rows& rows, double x,
                     double height) {
  const std::size_t count = graph.contractors().size();
  for (std::size_t c = 0; c < count; ++c) {
    const std::string& name = graph.contractors()[c]->name();
    const double y = place(rows.contractors[c], count, height);
    fmt::format_to(
        fmt::appender(out),
        "<rect class=\"contractor\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"34\" rx=\"4\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        x - half_width(name), y - 17, 2 * half_width(name), x, y + 5, report::xml_escape(name));
  }
}

}  // namespace

std::string to_dot(const ContractorGraph& graph) {
  TextBuffer out;
  const auto to = fmt::appender(out);
  put(out, "// A contractor reads the variables that point to it, and contracts those that it points to.\n");
  put(out, "digraph contractors {\n  rankdir=LR;\n  node [fontname=\"monospace\"];\n");
  for (std::size_t v = 0; v < graph.variables().size(); ++v) {
    const auto& variable = graph.variables()[v];
    fmt::format_to(to, "  v{} [label={}, shape=ellipse{}];\n", v, quoted(variable.name()),
                   variable.hidden() ? ", style=dashed" : "");
  }
  for (std::size_t c = 0; c < graph.contractors().size(); ++c) {
    fmt::format_to(to, "  c{} [label={}, shape=box];\n", c, quoted(graph.contractors()[c]->name()));
  }
  for (const Edge& edge : edges_of(graph)) {
    fmt::format_to(to, "  v{} -> c{} [dir={}];\n", edge.variable, edge.contractor,
                   edge.reads && edge.writes ? "both"
                   : edge.reads              ? "forward"
                                             : "back");
  }
  put(out, "}\n");
  return report::to_text(out);
}

std::string graph_svg(const ContractorGraph& graph) {
  const std::vector<Edge> edges = edges_of(graph);
  const Rows rows = rows_of(graph, edges);
  const std::size_t variables = graph.variables().size();
  const std::size_t contractors = graph.contractors().size();
  double widest_variable = 60;
  double widest_contractor = 60;
  for (const auto& variable : graph.variables())
    widest_variable = std::max(widest_variable, half_width(variable.name()));
  for (const auto& each : graph.contractors())
    widest_contractor = std::max(widest_contractor, half_width(each->name()));
  const double height = 64 + 56 * static_cast<double>(std::max<std::size_t>({variables, contractors, 1}));
  const double x_variable = 20 + widest_variable;
  const double x_contractor = x_variable + widest_variable + 220 + widest_contractor;
  TextBuffer out;
  const auto to = fmt::appender(out);
  fmt::format_to(
      to, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\">\n",
      x_contractor + widest_contractor + 20, height + 10);
  put(out, kHead);
  fmt::format_to(to, "<text class=\"head\" x=\"{}\" y=\"36\">variables</text>\n", x_variable);
  fmt::format_to(to, "<text class=\"head\" x=\"{}\" y=\"36\">contractors</text>\n", x_contractor);
  for (const Edge& edge : edges) {
    fmt::format_to(to, "<path class=\"edge\" d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\"{}{}/>\n",
                   x_variable + half_width(graph.variables()[edge.variable].name()),
                   place(rows.variables[edge.variable], variables, height),
                   x_contractor - half_width(graph.contractors()[edge.contractor]->name()),
                   place(rows.contractors[edge.contractor], contractors, height),
                   edge.writes ? " marker-start=\"url(#arrow)\"" : "",
                   edge.reads ? " marker-end=\"url(#arrow)\"" : "");
  }
  put_variables(out, graph, rows, x_variable, height);
  put_contractors(out, graph, rows, x_contractor, height);
  put(out, "</svg>\n");
  return report::to_text(out);
}

}  // namespace hcsp
