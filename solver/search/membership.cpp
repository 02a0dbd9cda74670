// SPDX-License-Identifier: Apache-2.0
#include "solver/search/membership.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "solver/expression/connectives.h"
#include "solver/expression/operators.h"

namespace hcsp {

namespace {

constexpr std::size_t kLargestCount = 10'000;

using Part = Membership::Part;
using Parts = std::vector<std::unique_ptr<Part>>;

// A relation without quantifiers, on many boxes at once.
class Plain final : public Part {
 public:
  Plain(const PointSet& set, NodeId relation)
      : size_(set.size()), program_(set.dag, {relation}), evaluation_(program_, Evaluation::kMaxLanes) {
    for (const Input& input : program_.inputs()) places_.push_back(set.place_of(input));
  }

  void decide(std::span<const Interval> boxes, std::span<Verdict> verdicts) override {
    for (std::size_t first = 0; first < verdicts.size(); first += Evaluation::kMaxLanes) {
      const std::size_t lanes = std::min(Evaluation::kMaxLanes, verdicts.size() - first);
      for (std::uint32_t i = 0; i < places_.size(); ++i) {
        Interval* row = evaluation_.row(i).data();
        const Interval* from = &boxes[first * size_ + places_[i]];
        for (std::size_t k = 0; k < lanes; ++k) row[k] = from[k * size_];
      }
      evaluation_.forward(lanes);
      for (std::size_t k = 0; k < lanes; ++k) {
        const Interval& truth = evaluation_.get(program_.root(), k);
        verdicts[first + k] = truth == kTrue ? Verdict::yes : truth == kFalse ? Verdict::no : Verdict::open;
      }
    }
  }

 private:
  std::size_t size_;
  Program program_;
  Evaluation evaluation_;
  std::vector<std::uint32_t> places_;
};

// At least `least` of some relations hold. A relation is asked of the boxes only that those before leave
// open.
class Count final : public Part {
 public:
  Count(std::size_t size, std::size_t least, Parts parts)
      : size_(size), least_(least), parts_(std::move(parts)) {}

  void decide(std::span<const Interval> boxes, std::span<Verdict> verdicts) override {
    open_.resize(verdicts.size());
    std::iota(open_.begin(), open_.end(), std::size_t{0});
    hold_.assign(verdicts.size(), 0);
    fail_.assign(verdicts.size(), 0);
    std::fill(verdicts.begin(), verdicts.end(), Verdict::open);
    for (const auto& part : parts_) {
      if (open_.empty()) return;
      asked_.clear();
      for (const std::size_t k : open_) {
        const auto box = boxes.subspan(k * size_, size_);
        asked_.insert(asked_.end(), box.begin(), box.end());
      }
      answers_.resize(open_.size());
      part->decide(asked_, answers_);
      std::size_t left = 0;
      for (std::size_t i = 0; i < open_.size(); ++i) {
        const std::size_t k = open_[i];
        hold_[k] += answers_[i] == Verdict::yes ? 1 : 0;
        fail_[k] += answers_[i] == Verdict::no ? 1 : 0;
        if (hold_[k] >= least_) {
          verdicts[k] = Verdict::yes;
        } else if (parts_.size() - fail_[k] < least_) {
          verdicts[k] = Verdict::no;
        } else {
          open_[left++] = k;
        }
      }
      open_.resize(left);
    }
  }

 private:
  std::size_t size_, least_;
  Parts parts_;
  std::vector<std::size_t> open_, hold_, fail_;
  std::vector<Interval> asked_;
  std::vector<Verdict> answers_;
};

class Negation final : public Part {
 public:
  explicit Negation(std::unique_ptr<Part> part) : part_(std::move(part)) {}
  void decide(std::span<const Interval> boxes, std::span<Verdict> verdicts) override {
    part_->decide(boxes, verdicts);
    for (Verdict& verdict : verdicts) verdict = opposite(verdict);
  }

 private:
  std::unique_ptr<Part> part_;
};

// `a if condition, else b`; and with b = not a, "condition and a are alike".
class Choice final : public Part {
 public:
  Choice(std::unique_ptr<Part> condition, std::unique_ptr<Part> a, std::unique_ptr<Part> b)
      : condition_(std::move(condition)), a_(std::move(a)), b_(std::move(b)) {}
  void decide(std::span<const Interval> boxes, std::span<Verdict> verdicts) override {
    then_.resize(verdicts.size());
    otherwise_.resize(verdicts.size());
    condition_->decide(boxes, verdicts);
    a_->decide(boxes, then_);
    b_->decide(boxes, otherwise_);
    for (std::size_t k = 0; k < verdicts.size(); ++k) {
      const bool is_open = verdicts[k] == Verdict::open && then_[k] != otherwise_[k];
      verdicts[k] = is_open ? Verdict::open : verdicts[k] == Verdict::no ? otherwise_[k] : then_[k];
    }
  }

 private:
  std::unique_ptr<Part> condition_, a_, b_;
  std::vector<Verdict> then_, otherwise_;
};

class Maker {
 public:
  Maker(const PointSet& set, const std::vector<std::uint32_t>& outer) : set_(set), outer_(outer) {}

  std::unique_ptr<Part> make(NodeId id) {
    Dag& dag = set_.dag;
    const DagNode node = dag[id];
    if (!has_quantifier(dag, id)) return std::make_unique<Plain>(set_, id);
    const auto operand = [&](std::size_t k) { return make(node.operands[k]); };
    switch (node.op) {
      case Op::for_every:
      case Op::for_some:
        return make_quantified(set_, id, outer_);
      case Op::logical_not:
        return std::make_unique<Negation>(operand(0));
      case Op::logical_and:
      case Op::logical_or:
        return chain(operands_of(dag, id, node.op), node.op);
      case Op::if_then_else:
        return std::make_unique<Choice>(operand(0), operand(1), operand(2));
      case Op::equal:
        return std::make_unique<Choice>(operand(0), operand(1), std::make_unique<Negation>(operand(1)));
      case Op::not_equal:
        return std::make_unique<Choice>(operand(0), std::make_unique<Negation>(operand(1)), operand(1));
      default:
        return count(node, id);
    }
  }

 private:
  // Those without quantifiers are one, which is asked first.
  std::unique_ptr<Part> chain(const std::vector<NodeId>& relations, Op connective) {
    Parts parts(1);
    std::vector<NodeId> plain;
    for (const NodeId relation : relations) {
      if (has_quantifier(set_.dag, relation)) {
        parts.push_back(make(relation));
      } else {
        plain.push_back(relation);
      }
    }
    if (plain.empty()) {
      parts.erase(parts.begin());
    } else {
      NodeId all = plain.front();
      for (std::size_t i = 1; i < plain.size(); ++i) all = set_.dag.apply(connective, {all, plain[i]}, 2);
      parts.front() = make(all);
    }
    const std::size_t least = connective == Op::logical_and ? parts.size() : 1;
    return std::make_unique<Count>(set_.size(), least, std::move(parts));
  }

  // `k <= c1 + c2 + ...`. Anything else is decided by its value, quantifiers being over their whole domains.
  std::unique_ptr<Part> count(const DagNode& node, NodeId id) {
    const Dag& dag = set_.dag;
    if (node.op == Op::less_equal && dag[node.operands[0]].op == Op::constant) {
      const std::vector<NodeId> relations = counted_relations(dag, node.operands[1], kLargestCount);
      const double least = dag[node.operands[0]].value.lo();
      Parts parts;
      for (const NodeId relation : relations) parts.push_back(make(relation));
      if (!parts.empty() && least >= 1)
        return std::make_unique<Count>(set_.size(), static_cast<std::size_t>(std::ceil(least)),
                                       std::move(parts));
    }
    return std::make_unique<Plain>(set_, id);
  }

  const PointSet& set_;
  const std::vector<std::uint32_t>& outer_;
};

}  // namespace

std::unique_ptr<Part> make_part(const PointSet& set, NodeId relation,
                                const std::vector<std::uint32_t>& outer) {
  return Maker(set, outer).make(relation);
}

Membership::Membership(const PointSet& set) : set_(set) {
  std::vector<std::uint32_t> coordinates(set.dim);
  std::iota(coordinates.begin(), coordinates.end(), 0U);
  whole_ = make_part(set, set.relation, coordinates);
}

void Membership::decide(std::span<const Interval> boxes, std::vector<Verdict>& verdicts) {
  verdicts.resize(boxes.size() / set_.dim);
  if (set_.size() == set_.dim) return whole_->decide(boxes, verdicts);
  extended_.clear();
  for (std::size_t k = 0; k < verdicts.size(); ++k) {
    const auto box = boxes.subspan(k * set_.dim, set_.dim);
    extended_.insert(extended_.end(), box.begin(), box.end());
    for (std::size_t v = set_.dim; v < set_.size(); ++v) extended_.push_back(set_.unknowns[v].domain);
  }
  whole_->decide(extended_, verdicts);
}

}  // namespace hcsp
