// SPDX-License-Identifier: Apache-2.0
// A contractor of a constraint c: it removes values from the domains of the variables that c joins, and no
// solution (completeness and contractance: Jaulin 2011, equation 7). How to write one: docs/contractors.md.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "solver/engine/ids.h"

namespace hcsp {

class Access;

/// The engine runs awake contractors of a lower cost first.
enum class Cost : std::uint8_t {
  constant,  ///< a few operations, however large the domains
  linear,    ///< one sweep over what changed
  search,    ///< descends or searches domains
};

class Contractor {
 public:
  /// `name` is what statistics call it, `constraint` the constraint that the model states.
  Contractor(std::string name, std::string constraint, Cost cost, std::vector<VariableId> reads,
             std::vector<VariableId> writes)
      : name_(std::move(name)),
        constraint_(std::move(constraint)),
        cost_(cost),
        reads_(std::move(reads)),
        writes_(std::move(writes)) {}
  virtual ~Contractor() = default;
  Contractor(const Contractor&) = delete;
  Contractor& operator=(const Contractor&) = delete;

  /// A run begins, on domains that may be any: forgets what only held in another run.
  virtual void begin() {}

  /// Contracts the domains of writes() with regard to those of reads(). `access` tells what changed in each
  /// since the last run (everything, the first time) and takes the Deltas that this run caused, after which
  /// the contractor is woken by what others do, and by its own changes too unless it says access.settled().
  /// Must be inclusion-isotone: smaller domains never give a larger result. A domain found empty is told by
  /// access.fail().
  virtual void contract(Access& access) = 0;

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& constraint() const { return constraint_; }
  [[nodiscard]] Cost cost() const { return cost_; }
  [[nodiscard]] std::span<const VariableId> reads() const { return reads_; }
  [[nodiscard]] std::span<const VariableId> writes() const { return writes_; }

 private:
  std::string name_;
  std::string constraint_;
  Cost cost_;
  std::vector<VariableId> reads_;
  std::vector<VariableId> writes_;
};

}  // namespace hcsp
