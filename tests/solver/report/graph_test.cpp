// SPDX-License-Identifier: Apache-2.0
#include "solver/report/graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "domains/interval/interval.h"
#include "solver/engine/graph.h"
#include "tests/solver/report/sample_result.h"
#include "tests/solver/report/well_formed.h"

namespace hcsp {
namespace {

using testing::HasSubstr;
using testing::Not;

class Idle : public Contractor {
 public:
  using Contractor::Contractor;
  void contract(Access&) override {}
};

void add(ContractorGraph& graph, const std::string& name, std::vector<VariableId> reads,
         std::vector<VariableId> writes) {
  graph.add_contractor(
      std::make_unique<Idle>(name, name, Cost::constant, std::move(reads), std::move(writes)));
}

TEST(GraphReport, SaysWhoReadsAndContractsWhat) {
  ContractorGraph graph;
  const VariableId x = graph.add_variable("x", Interval());
  const VariableId y = graph.add_variable("y", Interval());
  const VariableId d = graph.add_variable("d", Interval(), true);
  add(graph, "evolution", {x, y}, {x});
  add(graph, "dug", {x}, {d});
  const std::string dot = to_dot(graph);
  EXPECT_THAT(dot, HasSubstr("v0 [label=\"x\", shape=ellipse]"));
  EXPECT_THAT(dot, HasSubstr("v2 [label=\"d\", shape=ellipse, style=dashed]"));
  EXPECT_THAT(dot, HasSubstr("c0 [label=\"evolution\", shape=box]"));
  EXPECT_THAT(dot, HasSubstr("v0 -> c0 [dir=both]"));
  EXPECT_THAT(dot, HasSubstr("v1 -> c0 [dir=forward]"));
  EXPECT_THAT(dot, HasSubstr("v2 -> c1 [dir=back]"));
  const std::string svg = graph_svg(graph);
  EXPECT_EQ(sample::xml_error(svg), "");
  EXPECT_THAT(svg, HasSubstr(">evolution</text>"));
}

TEST(GraphReport, HostileNamesAreEscaped) {
  ContractorGraph graph;
  const VariableId x = graph.add_variable(sample::kHostile, Interval());
  add(graph, sample::kHostile, {x}, {x});
  EXPECT_EQ(sample::xml_error(graph_svg(graph)), "");
  EXPECT_THAT(to_dot(graph), Not(HasSubstr("1'>\"\\&")));
}

TEST(GraphReport, OfNothing) {
  EXPECT_EQ(sample::xml_error(graph_svg(ContractorGraph())), "");
  EXPECT_THAT(to_dot(ContractorGraph()), HasSubstr("digraph"));
}

}  // namespace
}  // namespace hcsp
