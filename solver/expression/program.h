// SPDX-License-Identifier: Apache-2.0
// Expressions as flat bytecode: the part of a graph that some roots need, in evaluation order, each
// instruction with its own register. HC4-revise (Benhamou, Goualard, Granvilliers, Puget 1999) is one sweep
// forward and one back. The same bytecode runs on one box (one lane) and on a range of a tube's items (many
// lanes); nothing is allocated in it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "solver/expression/dag.h"

namespace hcsp {

/// The compiled form. Immutable; registers are the inputs, the constants, then one an instruction.
class Program {
 public:
  struct Instruction {
    Op op;
    std::uint32_t result, a, b, c;  // registers; unused operands repeat a
  };

  Program(const Dag& dag, const std::vector<NodeId>& roots);

  [[nodiscard]] const std::vector<Input>& inputs() const { return inputs_; }
  [[nodiscard]] std::uint32_t root(std::size_t i = 0) const { return roots_[i]; }
  [[nodiscard]] std::size_t roots() const { return roots_.size(); }
  /// The instructions that need no bound point come first: point_code() is the place of the first that needs
  /// one.
  [[nodiscard]] std::span<const Instruction> code() const { return code_; }
  [[nodiscard]] std::size_t point_code() const { return point_code_; }
  /// The register of a node that the roots need.
  [[nodiscard]] std::uint32_t register_of(NodeId node) const { return places_.at(node); }
  [[nodiscard]] std::size_t registers() const { return registers_; }
  /// Whether every input and intermediate value is used once: HC4-revise then gives the hull of a relation's
  /// solutions at its first pass.
  [[nodiscard]] bool single_use() const { return single_use_; }
  /// Values of the constants, which stand after the inputs.
  [[nodiscard]] const std::vector<Interval>& constants() const { return constants_; }
  [[nodiscard]] bool is_constant(std::uint32_t reg) const {
    return reg >= inputs_.size() && reg < inputs_.size() + constants_.size();
  }

 private:
  std::vector<Input> inputs_;
  std::vector<Interval> constants_;
  std::vector<Instruction> code_;
  std::vector<std::uint32_t> roots_;
  std::map<NodeId, std::uint32_t> places_;
  std::size_t registers_ = 0;
  std::size_t point_code_ = 0;
  bool single_use_ = true;
};

/// The registers of a program for a number of lanes. One thread at a time. PRECONDITION of forward and
/// backward: the thread rounds upward.
class Evaluation {
 public:
  explicit Evaluation(const Program& program, std::size_t lanes = 1);

  void set(std::uint32_t reg, const Interval& value, std::size_t lane = 0) {
    lo_[reg * lanes_ + lane] = value.lo();
    hi_[reg * lanes_ + lane] = value.hi();
  }
  [[nodiscard]] Interval get(std::uint32_t reg, std::size_t lane = 0) const {
    return Interval::raw(lo_[reg * lanes_ + lane], hi_[reg * lanes_ + lane]);
  }

  /// Evaluates the first `lanes` lanes: every register is an enclosure of its node on the inputs' box, and
  /// defined() tells whether the node is defined on all of it.
  void forward(std::size_t lanes = 1) { run_forward(0, program_->code().size(), lanes); }
  /// forward() in two halves: what the bound point does not enter, and the rest.
  void forward_before_point(std::size_t lanes = 1) { run_forward(0, program_->point_code(), lanes); }
  void forward_from_point(std::size_t lanes = 1) {
    run_forward(program_->point_code(), program_->code().size(), lanes);
  }
  [[nodiscard]] bool defined(std::uint32_t reg, std::size_t lane = 0) const {
    return defined_[reg * lanes_ + lane] != 0;
  }

  /// After forward: contracts the inputs to where root `i` can lie in `wanted`, the same for every lane.
  /// False when some lane has no such point; failed_lane() tells which.
  bool backward(const Interval& wanted, std::size_t i = 0, std::size_t lanes = 1);
  /// forward() and backward() on one lane, again and again while the inputs shrink: at most kRounds times,
  /// and once where each value is used once.
  bool revise(const Interval& wanted);
  static constexpr int kRounds = 4;
  [[nodiscard]] std::size_t failed_lane() const { return failed_lane_; }

  [[nodiscard]] const Program& program() const { return *program_; }

 private:
  void run_forward(std::size_t first, std::size_t last, std::size_t lanes);
  template <class Operator, bool kBoolean, bool kRelation>
  void forward_one(const Program::Instruction& at, std::size_t lanes);
  template <class Operator, bool kBoolean, bool kRelation>
  bool backward_one(const Program::Instruction& at, std::size_t lanes);

  const Program* program_;
  std::size_t lanes_;
  std::size_t failed_lane_ = 0;
  std::vector<double> lo_, hi_;                // register by register, lane by lane
  std::vector<double> lo_before_, hi_before_;  // the inputs, before a round of revise()
  std::vector<std::uint8_t> defined_;          // the decoration `def`
  std::vector<std::uint8_t>
      needed_;  // backward: the root cannot take a wanted value unless this register has one
};

}  // namespace hcsp
