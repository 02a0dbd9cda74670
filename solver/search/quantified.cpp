// SPDX-License-Identifier: Apache-2.0
// Quantifiers over reals, decided by parts of the domains that they bind.
#include <algorithm>
#include <cmath>

#include "solver/expression/operators.h"
#include "solver/search/existence.h"
#include "solver/search/membership.h"

namespace hcsp {

namespace {

// Parts that a box is worth: at the border of a set no number of them decides.
constexpr std::size_t kMostParts = 100;
constexpr int kMostProofs = 4;  // by Newton

class Quantified final : public Membership::Part {
 public:
  Quantified(const PointSet& set, std::vector<std::uint32_t> outer, std::vector<std::uint32_t> own, bool some,
             NodeId body)
      : set_(set),
        outer_(std::move(outer)),
        own_(std::move(own)),
        settles_(some ? Verdict::yes : Verdict::no),
        body_(make_part(set, body, inner_of(outer_, own_))),
        narrowing_(set, some ? body : set.dag.apply(Op::logical_not, {body}, 1)) {
    if (some) existence_ = Existence::of(set, body, outer_, own_);
  }

  void decide(std::span<const Interval> boxes, std::span<Verdict> verdicts) override {
    for (std::size_t k = 0; k < verdicts.size(); ++k)
      verdicts[k] = decide_one(boxes.subspan(k * set_.size(), set_.size()));
  }

 private:
  static std::vector<std::uint32_t> inner_of(std::vector<std::uint32_t> outer,
                                             const std::vector<std::uint32_t>& own) {
    outer.insert(outer.end(), own.begin(), own.end());
    return outer;
  }

  // One part where the body has the verdict that settles it, or in all the opposite one.
  Verdict decide_one(std::span<const Interval> box) {
    const std::size_t size = set_.size();
    const double finest = finest_share(box);
    bool is_open = false;
    std::size_t looked_at = 0;
    proofs_left_ = kMostProofs;
    parts_.assign(box.begin(), box.end());
    while (!parts_.empty()) {
      if (is_settled_in(parts_)) return settles_;
      looked_at += verdicts_.size();
      if (looked_at > kMostParts) return Verdict::open;
      std::size_t left = 0;
      for (std::size_t k = 0; k < verdicts_.size(); ++k) {
        const std::span<Interval> part(&parts_[k * size], size);
        if (verdicts_[k] != Verdict::open || !narrow(part)) continue;
        std::copy(part.begin(), part.end(), parts_.begin() + static_cast<std::ptrdiff_t>(left++ * size));
      }
      parts_.resize(left * size);
      if (is_settled_at_points() || exists_in_some()) return settles_;
      next_.clear();
      for (std::size_t k = 0; k < left; ++k)
        is_open = !cut(std::span<const Interval>(&parts_[k * size], size), finest) || is_open;
      parts_.swap(next_);
    }
    return is_open ? Verdict::open : opposite(settles_);
  }

  // A part without values that the domain certainly has settles nothing, and stays open.
  bool is_settled_in(const std::vector<Interval>& boxes) {
    verdicts_.resize(boxes.size() / set_.size());
    body_->decide(boxes, verdicts_);
    for (std::size_t k = 0; k < verdicts_.size(); ++k) {
      if (verdicts_[k] != settles_) continue;
      if (is_certain({&boxes[k * set_.size()], set_.size()})) return true;
      verdicts_[k] = Verdict::open;
    }
    return false;
  }

  [[nodiscard]] bool is_certain(std::span<const Interval> part) const {
    return std::all_of(own_.begin(), own_.end(), [&](std::uint32_t v) {
      return !meet(part[v], set_.unknowns[v].certain_part()).is_empty();
    });
  }

  // To the values of what is bound that do not have the opposite verdict on the whole box.
  bool narrow(std::span<Interval> part) {
    narrowed_.assign(part.begin(), part.end());
    if (!narrowing_.contract(narrowed_)) return false;
    for (const std::uint32_t v : own_) part[v] = narrowed_[v];
    return true;
  }

  bool is_settled_at_points() {
    points_ = parts_;
    for (std::size_t first = 0; first < points_.size(); first += set_.size()) {
      for (const std::uint32_t v : own_) {
        Interval& side = points_[first + v];
        const Interval& certain = set_.unknowns[v].certain_part();
        if (certain.is_empty()) return false;
        const double middle = set_.unknowns[v].is_whole ? std::floor(cut_of(side)) : cut_of(side),
                     value = std::clamp(middle, certain.lo(), certain.hi());
        side = Interval::raw(value, value);
      }
    }
    return !points_.empty() && is_settled_in(points_);
  }

  bool exists_in_some() {
    if (existence_ == nullptr) return false;
    for (std::size_t first = 0; first < parts_.size() && proofs_left_ > 0; first += set_.size()) {
      --proofs_left_;
      if (existence_->holds({&parts_[first], set_.size()})) return true;
    }
    return false;
  }

  // As a share of its domain, half of what the widest unknown outside is of its own: that wide, parts of the
  // domain that is bound blur no more than the box itself does.
  [[nodiscard]] double finest_share(std::span<const Interval> box) const {
    constexpr double kLeast = 0x1p-20;
    double share = kLeast;
    for (const std::uint32_t v : outer_) share = std::max(share, 0.5 * share_of(box, v));
    return share;
  }

  [[nodiscard]] double share_of(std::span<const Interval> box, std::uint32_t v) const {
    const Interval &domain = set_.unknowns[v].domain, &side = box[v];
    if (side.is_point()) return 0.0;
    if (!side.is_bounded()) return kInfinity;
    return domain.is_bounded() ? (side.hi() - side.lo()) / (domain.hi() - domain.lo()) : 1.0;
  }

  // Across the widest; false where all are as fine as they are worth.
  bool cut(std::span<const Interval> part, double finest) {
    const auto widest = *std::max_element(
        own_.begin(), own_.end(), [&](auto u, auto v) { return share_of(part, u) < share_of(part, v); });
    return share_of(part, widest) > std::min(finest, 1.0) &&
           cut_across(set_, part, widest, cut_of(part[widest]), next_);
  }

  const PointSet& set_;
  std::vector<std::uint32_t> outer_, own_;
  Verdict settles_;
  std::unique_ptr<Part> body_;
  Narrowing narrowing_;
  std::unique_ptr<Existence> existence_;
  std::vector<Interval> parts_, next_, points_, narrowed_;
  std::vector<Verdict> verdicts_;
  int proofs_left_ = 0;
};

}  // namespace

std::unique_ptr<Membership::Part> make_quantified(const PointSet& set, NodeId quantifier,
                                                  const std::vector<std::uint32_t>& outer) {
  const Op op = set.dag[quantifier].op;
  std::vector<std::uint32_t> own;
  NodeId body = quantifier;
  while (set.dag[body].op == op) {
    const auto operands = set.dag[body].operands;
    own.push_back(set.place_of(set.dag[operands[0]].input));
    body = operands[1];
  }
  return std::make_unique<Quantified>(set, outer, std::move(own), op == Op::for_some, body);
}

}  // namespace hcsp
