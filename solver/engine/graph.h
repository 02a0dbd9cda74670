// SPDX-License-Identifier: Apache-2.0
// The contractor graph: variables joined to the contractors that read and write them (the paper's Fig. 6). It
// holds the initial domains; a Propagation works on copies.
#pragma once

#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

#include "domains/check.h"
#include "solver/engine/contractor.h"
#include "solver/engine/slot.h"

namespace hcsp {

class ContractorGraph {
 public:
  class Variable {
   public:
    Variable(std::string name, bool hidden, std::unique_ptr<Slot> initial)
        : name_(std::move(name)), hidden_(hidden), initial_(std::move(initial)) {}
    [[nodiscard]] const std::string& name() const { return name_; }
    /// Made by a decomposition, not declared by the model.
    [[nodiscard]] bool hidden() const { return hidden_; }
    /// Whether it is there: a part of a graph has only the variables that its contractors join.
    [[nodiscard]] bool present() const { return initial_ != nullptr; }
    [[nodiscard]] const Slot& initial() const { return *initial_; }
    [[nodiscard]] Slot& initial() { return *initial_; }
    [[nodiscard]] const std::vector<ContractorId>& readers() const { return readers_; }

   private:
    friend class ContractorGraph;
    std::string name_;
    bool hidden_;
    std::unique_ptr<Slot> initial_;
    std::vector<ContractorId> readers_;
  };

  /// Adds a variable of any lattice. Throws std::invalid_argument when the name is taken.
  template <Lattice D>
  VariableId add_variable(const std::string& name, D initial, bool hidden = false) {
    return add_slot(name, hidden, std::make_unique<TypedSlot<D>>(std::move(initial)));
  }

  /// Adds a contractor; its variables must exist (std::invalid_argument otherwise).
  ContractorId add_contractor(std::unique_ptr<Contractor> contractor);

  /// A graph of these contractors and, under the same ids, of the variables that they join.
  [[nodiscard]] ContractorGraph part(std::vector<std::unique_ptr<Contractor>> contractors) const;

  /// The initial domain of a variable; D must be the lattice that it was added with (std::bad_cast
  /// otherwise).
  template <Lattice D>
  [[nodiscard]] D& initial(VariableId id) {
    return dynamic_cast<TypedSlot<D>&>(variables_.at(id).initial()).domain;
  }

  template <Lattice D>
  [[nodiscard]] const D& initial(VariableId id) const {
    return dynamic_cast<const TypedSlot<D>&>(variables_.at(id).initial()).domain;
  }

  [[nodiscard]] const std::vector<Variable>& variables() const { return variables_; }
  [[nodiscard]] const Variable& variable(VariableId id) const { return variables_[id]; }
  [[nodiscard]] const std::vector<std::unique_ptr<Contractor>>& contractors() const { return contractors_; }

 private:
  VariableId add_slot(const std::string& name, bool hidden, std::unique_ptr<Slot> slot);

  std::vector<Variable> variables_;
  std::unordered_set<std::string> names_;
  std::vector<std::unique_ptr<Contractor>> contractors_;
};

}  // namespace hcsp
