// SPDX-License-Identifier: Apache-2.0
// What is known of the nodes of a graph, each found once: the unknowns and parameters that it needs, and an
// enclosure of its values.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <vector>

#include "solver/expression/dag.h"

namespace hcsp::online {

/// What all cases share.
struct Unknowns {
  using Domains = std::map<Input, Interval>;
  std::set<Input> parameters;
  std::set<Input> whole;
  Domains domains;  ///< of all, as declared; parameters may be anything
  Domains certain;  ///< what of it certainly belongs to it, where that is less
  [[nodiscard]] const Interval& certain_domain(const Input& input) const {
    const auto known = certain.find(input);
    return known != certain.end() ? known->second : domains.at(input);
  }
  [[nodiscard]] bool is_unknown(const Input& input) const { return !parameters.contains(input); }
};

/// Of a graph that may grow.
class Facts {
 public:
  /// Every input of the graph has a domain.
  Facts(const Dag& dag, const Unknowns& unknowns);

  /// Whether an expression needs an input; the number of one, for asking often.
  [[nodiscard]] bool needs(NodeId node, const Input& input) { return needs(node, number_of(input)); }
  [[nodiscard]] bool needs(NodeId node, std::size_t number) {
    if (supports_.size() < dag_.size() * words_) extend();
    return ((support(node)[number / 64] >> (number % 64)) & 1U) != 0;
  }
  [[nodiscard]] std::size_t number_of(const Input& input) const { return places_.at(input); }
  /// Whether an expression is the same whatever the unknowns are.
  [[nodiscard]] bool is_given(NodeId node);
  [[nodiscard]] std::vector<Input> inputs_of(NodeId node);
  /// How many nodes it needs, itself too; and those of them that are not given.
  struct Size {
    std::size_t nodes, open;
  };
  [[nodiscard]] Size size(NodeId node);
  /// Whether an expression is another, or needs it.
  [[nodiscard]] bool is_part(NodeId part, NodeId of);
  /// An enclosure of its values for inputs within their domains.
  [[nodiscard]] Interval range(NodeId node);

 private:
  void extend();
  template <class F>
  void for_each_part(NodeId node, F f);
  void find_range(NodeId node);
  [[nodiscard]] std::uint64_t* support(NodeId node) { return &supports_[node * words_]; }

  const Dag& dag_;
  const Unknowns& unknowns_;
  std::vector<Input> inputs_;
  std::map<Input, std::size_t> places_;
  std::size_t words_;
  std::vector<std::uint64_t> is_unknown_;  // by input, as bits
  std::vector<std::uint64_t> supports_;    // by node, as bits
  std::vector<Interval> ranges_;           // by node, of those that were asked for
  std::vector<std::uint8_t> has_range_;    // by node
  std::vector<std::uint8_t> is_defined_;   // by node with a range: for all inputs
  std::vector<std::uint32_t> marks_;       // by node: the last visit
  std::uint32_t mark_ = 0;
  std::vector<NodeId> open_;  // of the visit at hand
  std::unordered_map<NodeId, Size> sizes_;
};

/// Whether a <= b wherever both are defined: by their form, or by their ranges.
bool is_at_most(const Dag& dag, NodeId a, NodeId b, Facts& facts);

}  // namespace hcsp::online
