// SPDX-License-Identifier: Apache-2.0
#include "solver/online/followers.h"

#include <algorithm>

namespace hcsp::online {

// A parameter is declared after those that it follows.
Followers::Followers(const Dag& dag, const std::map<VariableId, NodeId>& followed,
                     const std::map<Input, std::size_t>& places) {
  for (const auto& [id, node] : followed) {
    Follower& follower =
        followers_.emplace_back(Follower{places.at({Input::Kind::real, id, 0, 0}), Program(dag, {node}), {}});
    for (const Input& input : follower.program.inputs()) follower.inputs.push_back(places.at(input));
  }
  for (const Follower& follower : followers_) evaluations_.emplace_back(follower.program);
}

void Followers::update(std::span<Interval> values, std::span<const std::uint8_t> is_set,
                       std::span<std::uint8_t> has_changed) {
  for (std::size_t f = 0; f < followers_.size(); ++f) {
    const Follower& follower = followers_[f];
    const auto is_new = [&](std::size_t place) { return has_changed[place] != 0; };
    const bool is_stale = is_new(follower.place) || std::ranges::any_of(follower.inputs, is_new);
    if (is_set[follower.place] != 0 || !is_stale) continue;
    Evaluation& evaluation = evaluations_[f];
    for (std::uint32_t i = 0; i < follower.inputs.size(); ++i) evaluation.set(i, values[follower.inputs[i]]);
    evaluation.forward();
    const std::uint32_t root = follower.program.root();
    values[follower.place] = evaluation.defined(root) ? evaluation.get(root) : Interval::entire();
    has_changed[follower.place] = 1;
  }
  std::ranges::fill(has_changed, std::uint8_t{0});
}

}  // namespace hcsp::online
