// SPDX-License-Identifier: Apache-2.0
// The relations of a system relaxed to linear ones over a box (McCormick 1976; Tawarmalani and Sahinidis
// 2004): a column for each unknown and for each nonlinear operation, whose rows enclose its graph: products
// between their four corner planes, functions of one operand between a secant and tangents. What is linear
// stays exact.
#pragma once

#include <vector>

#include "solver/search/linear_program.h"
#include "solver/search/system.h"

namespace hcsp {

class Relaxation {
 public:
  explicit Relaxation(const System& system);

  /// Contracts a box by HC4-revise of each relation once, then states rows that every solution in it
  /// satisfies; the first columns are the unknowns. False when it has no solution. PRECONDITION: the thread
  /// rounds upward.
  bool state(std::vector<Interval>& box, LinearProgram& program);

 private:
  // A sum of columns times factors, plus a value in `rest`.
  struct Sum {
    std::vector<LinearTerm> terms;  // by column, each once
    Interval rest = Interval::raw(0.0, 0.0);
  };
  Sum scaled(const Sum& sum, const Interval& factor) const;
  Sum added(const Sum& a, const Sum& b) const;
  Sum column_of(std::uint32_t reg);
  void state_instruction(const Tape::Instruction& at);
  void state_curve(const Tape::Instruction& at, std::uint32_t argument);
  void state_product(const Sum& product, const Interval& a, const Sum& of_a, const Interval& b,
                     const Sum& of_b);
  void require(const Sum& sum, const Interval& within);

  const System& system_;
  TapeRun run_;
  LinearProgram* program_ = nullptr;
  std::vector<Interval> columns_;
  std::vector<Sum> sums_;  // by register
  struct Row {
    std::vector<LinearTerm> terms;
    Interval within;
  };
  std::vector<Row> rows_;
};

}  // namespace hcsp
