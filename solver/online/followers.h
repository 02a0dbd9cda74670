// SPDX-License-Identifier: Apache-2.0
// Parameters whose values follow from others for as long as they are not set themselves.
#pragma once

#include <map>
#include <span>
#include <vector>

#include "solver/expression/program.h"

namespace hcsp::online {

class Followers {
 public:
  /// `followed`: by parameter, the expression of other parameters; `places`: by parameter, its number.
  Followers(const Dag& dag, const std::map<VariableId, NodeId>& followed,
            const std::map<Input, std::size_t>& places);

  /// Gives values to those that are not set and have changed, or follow one that has; then none has: before
  /// the first time all are to have. Allocates nothing. PRECONDITION: the thread rounds upward.
  void update(std::span<Interval> values, std::span<const std::uint8_t> is_set,
              std::span<std::uint8_t> has_changed);

 private:
  struct Follower {
    std::size_t place;
    Program program;
    std::vector<std::size_t> inputs;  // by input of the program: the number of the parameter
  };
  std::vector<Follower> followers_;  // after those that they follow
  std::vector<Evaluation> evaluations_;
};

}  // namespace hcsp::online
