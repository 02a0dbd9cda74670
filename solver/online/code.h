// SPDX-License-Identifier: Apache-2.0
// Views as bytecode over one file of registers. What depends on parameters alone is the prefix, evaluated
// once for all views; a view's own registers are those of its core, then one an instruction.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "solver/online/elimination.h"
#include "solver/online/node_map.h"

namespace hcsp::online {

using Register = std::uint32_t;

struct Instruction {
  Op op;
  std::uint8_t arity;
  Register y, a, b, c;  // unused operands repeat a
};

/// How a result's derivatives follow from those of its operands, which of them have any being known: of sums,
/// choices and kinks directly, otherwise with slopes in registers.
struct ChainRule {
  enum class Kind : std::uint8_t {
    copy,       ///< y' = a'
    negate,     ///< y' = -a'
    add,        ///< y' = a' + b'
    sub,        ///< y' = a' - b'
    min,        ///< of a and b
    max,        ///< of a and b
    abs,        ///< of a
    choice,     ///< of b or c by the Boolean a
    constant,   ///< y' = 0: steps
    root,       ///< y' = sa a', of sqrt(a)
    scale,      ///< y' = sa a'
    scale_both  ///< y' = sa a' + sb b'
  };
  Kind kind;
  Register y, a, b, c, sa, sb;
  /// Of min, max and abs: where the kink is, the zeros of an expression. Kinks with one surface turn
  /// together.
  std::uint32_t surface = 0;
  bool is_first_above = false;  ///< y' is a' where that expression is positive, not where it is negative
};

/// What parameters alone decide.
class Prefix {
 public:
  explicit Prefix(const std::vector<Input>& parameters);

  /// The register of a node of parameters and constants, which is computed from then on. `copies`: what the
  /// prefix has of that graph; to be passed on.
  Register place(const Dag& from, NodeId node, NodeMap& copies);
  [[nodiscard]] Register size() const { return size_; }
  [[nodiscard]] const std::vector<Instruction>& code() const { return code_; }
  /// Constants and their registers; parameter i is in register i.
  [[nodiscard]] const std::vector<std::pair<Register, Interval>>& constants() const { return constants_; }

 private:
  NodeId copy(const Dag& from, NodeId node, NodeMap& copies);

  Dag dag_;                       // of all that is computed, whatever graphs it came from
  std::vector<Register> places_;  // by node of it
  std::map<Input, Register> parameters_;
  Register size_;
  std::vector<Instruction> code_;
  std::vector<std::pair<Register, Interval>> constants_;
};

/// "The register is defined, and in `wanted`."
struct Test {
  Register reg;
  Interval wanted;
  bool strict;
  bool is_equation;
  bool is_truth;    ///< of a Boolean
  bool is_implied;  ///< no constraint states it
  std::uint32_t name;
  bool is_of_quotient = false;  ///< by what may be 0, and then it says nothing
};

/// Unknown v of the core is at most, or at least, what a register of the prefix holds.
struct CoreBound {
  std::size_t v;
  Register reg;
  bool is_upper;
};

class Code {
 public:
  /// Adds derivatives to the graph, and what is given to the prefix. Throws std::invalid_argument where
  /// the core has more than 64 facts, or an equation has a term without a derivative.
  Code(Dag& dag, Prefix& prefix, Facts& facts, const View& view, std::size_t objectives, Purpose purpose);

  /// To be called when the prefix has all that it will hold: the own registers follow it.
  void place_after(Register prefix_size);

  [[nodiscard]] std::size_t core() const { return core_; }
  [[nodiscard]] Register first() const { return first_; }  ///< the register of the core's first unknown
  [[nodiscard]] Register registers() const { return registers_; }  ///< of its own

  /// Tests and values come in stages: what costs next to nothing, for what a search can refute by it;
  /// equations and the objective; the rest.
  enum Stage : std::size_t { cheap, main, all };
  /// Where they end.
  struct End {
    std::size_t tests, values, slopes, chain;
  };
  std::array<End, 3> ends{};
  std::vector<Instruction> values;     ///< of the tests and of the objective
  std::vector<Instruction> slopes;     ///< what chain rules need besides
  std::vector<ChainRule> chain;        ///< along `values`
  std::vector<Instruction> real_path;  ///< those of `values` that tests of numbers need, not Booleans' parts
  std::vector<Instruction> rest;       ///< what definitions need besides
  std::vector<Instruction> further;    ///< what further wanted expressions need besides all that
  std::vector<Test> tests;
  std::vector<Test> conditions;  ///< of the prefix alone; share_givens() puts them where they are tested
  /// What of the prefix is evaluated for it alone, in parts, each with the conditions that need no more; and
  /// all that it reads of the prefix.
  struct Part {
    std::vector<Instruction> code;
    std::vector<Test> conditions;
  };
  std::vector<Part> prelude;
  std::vector<Register> reads;
  std::vector<CoreBound> bounds;
  std::vector<Register> nonzero;
  std::vector<Register> definitions;  ///< by definition of the view
  std::vector<Register> wanted;
  std::vector<std::uint64_t> depends;  ///< by own register: the unknowns of the core, a bit each
  std::uint32_t surfaces = 0;          ///< of kinks

 private:
  Register place(Dag& dag, Prefix& prefix, Facts& facts, NodeId node, std::vector<Instruction>& to);
  void add_chain(Dag& dag, Prefix& prefix, Facts& facts);
  void add_chain_rule(Dag& dag, Prefix& prefix, Facts& facts, const Instruction& at, NodeId node);
  void find_surface(const Dag& dag, std::initializer_list<std::pair<NodeId, int>> difference,
                    ChainRule& rule);
  void find_real_path();
  void end_stage(Stage stage);
  [[nodiscard]] bool is_available(Register reg) const;

  std::size_t core_;
  Register first_ = 0, registers_;
  NodeMap places_, givens_;                      // of nodes; of the prefix
  std::array<Register, 3> ends_of_registers_{};  // by stage
  std::pair<Register, Register> later_{};        // own registers from the first to below the second
  std::vector<NodeId> nodes_;                    // by instruction of `values`
  std::map<std::vector<std::pair<NodeId, int>>, std::uint32_t> surface_of_;
};

}  // namespace hcsp::online
