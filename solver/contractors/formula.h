// SPDX-License-Identifier: Apache-2.0
// A relation as a formula of atoms, contracted constructively: of alternatives, each contracts a copy of the
// box by itself, and what at least as many of them keep as have to hold is kept.
#pragma once

#include <memory>
#include <vector>

#include "solver/expression/program.h"

namespace hcsp {

class Formula {
 public:
  /// Of the relation at a node; the inputs are those of `whole`, the program of that relation, in its order.
  Formula(const Dag& dag, NodeId relation, const Program& whole);

  /// Whether plain HC4-revise would wait for all alternatives of an `or` but one to fail.
  [[nodiscard]] bool has_alternatives() const;
  /// Contracts values of the inputs to where the relation can hold; false when it nowhere can. The thread
  /// rounds upward.
  bool contract(std::vector<Interval>& inputs);

 private:
  struct Atom {
    explicit Atom(Program compiled) : program(std::move(compiled)), evaluation(program) {}
    Program program;
    Evaluation evaluation;
    std::vector<std::size_t> places;  // of its inputs among those of the whole
  };
  class Maker;
  Formula() = default;
  bool contract_atom(std::vector<Interval>& inputs);
  bool contract_parts(std::vector<Interval>& inputs);

  std::unique_ptr<Atom> atom_;  // or else parts
  bool wanted_ = true;          // of the atom: the truth that it has to have
  std::size_t least_ = 0;       // of the parts: how many have to hold
  std::vector<Formula> parts_;
};

}  // namespace hcsp
