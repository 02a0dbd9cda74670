// SPDX-License-Identifier: Apache-2.0
#include "solver/engine/graph.h"

#include <gtest/gtest.h>

#include <typeinfo>

#include "domains/box.h"
#include "tests/solver/engine/probe.h"
#include "tests/support/truth.h"

namespace hcsp {
namespace {

TEST(ContractorGraph, JoinsVariablesToTheContractorsThatReadThem) {
  ContractorGraph graph;
  const VariableId x = graph.add_variable("x", Interval(0, 1)), y = graph.add_variable("y", Interval(), true);
  const ContractorId first = add_probe(graph, "first", Cost::constant, {x, y}, {y}, [](Access&) {});
  const ContractorId second = add_probe(graph, "second", Cost::constant, {x}, {}, [](Access&) {});
  EXPECT_EQ(graph.variable(x).readers(), (std::vector{first, second}));
  EXPECT_EQ(graph.variable(y).readers(), std::vector{first});
  EXPECT_FALSE(graph.variable(x).hidden());
  EXPECT_TRUE(graph.variable(y).hidden());
  EXPECT_EQ(graph.initial<Interval>(x), Interval(0, 1));
}

TEST(ContractorGraph, MisuseThrows) {
  ContractorGraph graph;
  const VariableId x = graph.add_variable("x", Interval());
  try {
    graph.add_variable("x", Interval());
    FAIL() << "a name was taken twice";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find('x'), std::string::npos);
  }
  EXPECT_THROW(add_probe(graph, "reads too far", Cost::constant, {x + 1}, {}, [](Access&) {}),
               std::invalid_argument);
  EXPECT_THROW(add_probe(graph, "writes too far", Cost::constant, {x}, {x + 1}, [](Access&) {}),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(graph.initial<Box>(x)), std::bad_cast);
}

TEST(ContractorGraph, ARefusedContractorLeavesNoTrace) {
  ContractorGraph graph;
  const VariableId x = graph.add_variable("x", Interval());
  EXPECT_THROW(add_probe(graph, "bad", Cost::constant, {x, x + 1}, {}, [](Access&) {}),
               std::invalid_argument);
  EXPECT_TRUE(graph.contractors().empty());
  EXPECT_TRUE(graph.variable(x).readers().empty()) << "a contractor that is not there is woken";
}

}  // namespace
}  // namespace hcsp
