// SPDX-License-Identifier: Apache-2.0
#include "solver/search/checkpoint.h"

#include <fmt/format.h>

#include <cstring>

#include "domains/check.h"

namespace hcsp {

namespace {

constexpr std::string_view kFormat = "hcsp search 1\n";

class Hash {
 public:
  template <class Value>
  void add(const Value& value) {
    hash_ = hash_of({reinterpret_cast<const char*>(&value), sizeof value}, hash_);
  }
  void add(const Input& input) {
    add(input.kind);
    add(input.variable);
    add(input.component);
    add(input.gate);
  }
  void add(std::string_view text) { hash_ = hash_of(text, hash_); }
  void add(const Interval& value) {
    add(value.lo());
    add(value.hi());
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = hash_of({});
};

}  // namespace

std::uint64_t hash_of(std::string_view bytes, std::uint64_t before) {
  constexpr std::uint64_t kPrime = 0x100000001b3U;
  for (const char byte : bytes) before = (before ^ static_cast<unsigned char>(byte)) * kPrime;
  return before;
}

std::uint64_t mark_of(const System& system, std::string_view goal, const SearchOptions& options) {
  std::vector<System::Unknown> unknowns;
  for (std::size_t v = 0; v < system.size(); ++v)
    unknowns.push_back(
        {system.inputs[v], system.domains[v], system.is_whole[v] != 0, false, system.certain[v]});
  std::string of(goal);
  if (system.implied > 0) of += fmt::format(", {} implied", system.implied);
  return mark_of(system.dag, system.stated, unknowns, of, options);
}

std::uint64_t mark_of(const Dag& dag, const std::vector<NodeId>& stated,
                      const std::vector<System::Unknown>& unknowns, std::string_view goal,
                      const SearchOptions& options) {
  Hash hash;
  hash.add(goal);
  hash.add(options.precision);
  for (const System::Unknown& unknown : unknowns) {
    hash.add(unknown.input);
    hash.add(unknown.domain);
    hash.add(unknown.certain_part());
    hash.add(unknown.is_whole);
  }
  for (const NodeId id : needed_nodes(dag, stated)) {
    const DagNode& node = dag[id];
    hash.add(id);
    hash.add(node.op);
    for (const NodeId operand : node.operands) hash.add(operand);
    if (node.op == Op::constant) hash.add(node.value);
    if (node.op == Op::input) hash.add(node.input);
  }
  for (const NodeId id : stated) hash.add(id);
  return hash.value();
}

std::string sealed(const nlohmann::json& state, std::uint64_t mark) {
  std::string bytes(kFormat);
  nlohmann::json::to_cbor(nlohmann::json{{"mark", mark}, {"state", state}}, bytes);
  const std::uint64_t sum = hash_of(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes;
}

nlohmann::json opened(const std::string& bytes, std::uint64_t mark) {
  std::uint64_t sum = 0;
  require(bytes.starts_with(kFormat) && bytes.size() > kFormat.size() + sizeof sum,
          "this is no checkpoint of a search");
  const std::string_view content(bytes.data(), bytes.size() - sizeof sum);
  std::memcpy(&sum, bytes.data() + content.size(), sizeof sum);
  require(hash_of(content) == sum, "the checkpoint is damaged");
  nlohmann::json whole = nlohmann::json::from_cbor(content.substr(kFormat.size()));
  require(whole.at("mark").get<std::uint64_t>() == mark,
          "the checkpoint is of another model, other parameters or another precision");
  return std::move(whole.at("state"));
}

nlohmann::json json_of(const std::vector<Interval>& box) {
  auto bounds = nlohmann::json::array();
  for (const Interval& side : box) {
    bounds.push_back(side.lo());
    bounds.push_back(side.hi());
  }
  return bounds;
}

std::vector<Interval> box_of(const nlohmann::json& bounds) {
  std::vector<Interval> box;
  for (std::size_t i = 0; i + 1 < bounds.size(); i += 2)
    box.push_back(Interval::raw(bounds[i].get<double>(), bounds[i + 1].get<double>()));
  return box;
}

}  // namespace hcsp
