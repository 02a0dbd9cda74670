// SPDX-License-Identifier: Apache-2.0
#include "solver/search/pave.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <string>

#include "domains/interval/kernel.h"
#include "solver/expression/connectives.h"
#include "solver/search/membership.h"
#include "solver/search/separator.h"
#include "solver/search/tree_search.h"

namespace hcsp {

namespace {

double volume_share(std::span<const Interval> part, std::span<const Interval> whole) {
  double share = 1.0;
  for (std::size_t v = 0; v < part.size(); ++v) {
    const double width = whole[v].hi() - whole[v].lo();
    if (width > 0.0 && width < kInfinity) share *= (part[v].hi() - part[v].lo()) / width;
    if (width == kInfinity && part[v].is_bounded()) share = 0.0;
  }
  return share;
}

// What a thread needs to look at boxes, and what it found. A node is boxes side by side, which are decided
// together.
class Paver {
 public:
  struct Node {
    std::vector<Interval> boxes;
    std::string path;        // from the root: the order of nodes
    int rest = 0, vain = 0;  // how many cuts separators are not worth a try, and how often they gained little
  };
  // Where what a node left behind begins in `found`, and where it ends.
  struct Leaves {
    std::string path;
    std::array<std::size_t, 3> first, last;
  };

  Paver(const PointSet& set, const SearchOptions& options, std::size_t batch)
      : set_(set), precision_(options.precision), batch_(batch), membership_(set), separator_(set) {}
  Paver(const Paver&) = delete;
  Paver& operator=(const Paver&) = delete;

  void explore(Node& node, std::vector<Node>& children) {
    const std::array<std::size_t, 3> first_found = sizes();
    cells += node.boxes.size() / set_.dim;
    keep_open(node.boxes);
    if (node.rest > 0) {
      --node.rest;
    } else {
      separate(node);
    }
    cut_boxes(node.boxes);
    leaves.push_back({node.path, first_found, sizes()});
    const std::size_t most = batch_ * set_.dim;
    for (std::size_t first = 0; first < next_.size(); first += most) {
      Node& child = children.emplace_back();
      const std::size_t last = std::min(next_.size(), first + most);
      child.boxes.assign(next_.begin() + static_cast<std::ptrdiff_t>(first),
                         next_.begin() + static_cast<std::ptrdiff_t>(last));
      child.path = node.path + static_cast<char>('0' + first / most);
      child.rest = node.rest;
      child.vain = node.vain;
    }
  }

  PavedBoxes found;
  std::vector<Leaves> leaves;
  std::uint64_t cells = 0;

 private:
  [[nodiscard]] std::array<std::size_t, 3> sizes() const {
    return {found.inside.size(), found.boundary.size(), found.outside.size()};
  }

  // Leaves of some boxes those that are not decided.
  void keep_open(std::vector<Interval>& boxes) {
    membership_.decide(boxes, verdicts_);
    auto left = boxes.begin();
    for (std::size_t k = 0; k < verdicts_.size(); ++k) {
      const auto box = boxes.begin() + static_cast<std::ptrdiff_t>(k * set_.dim);
      const auto end = box + static_cast<std::ptrdiff_t>(set_.dim);
      if (verdicts_[k] == Verdict::open) {
        left = std::copy(box, end, left);
      } else {
        auto& kind = verdicts_[k] == Verdict::yes ? found.inside : found.outside;
        kind.insert(kind.end(), box, end);
      }
    }
    boxes.erase(left, boxes.end());
  }

  // Where they gain little they are tried less and less often: to decide parts is cheaper.
  void separate(Node& node) {
    constexpr double kMuch = 0.25;
    constexpr int kMostVain = 6;
    const std::size_t dim = set_.dim;
    double share = 0.0;
    std::size_t left = 0;
    const std::size_t count = node.boxes.size() / dim;
    for (std::size_t k = 0; k < count; ++k) {
      const std::span<Interval> box(&node.boxes[k * dim], dim);
      before_.assign(box.begin(), box.end());
      if (!separate(box, true, found.outside) || !separate(box, false, found.inside)) continue;
      share += volume_share(box, before_);
      std::copy(box.begin(), box.end(), node.boxes.begin() + static_cast<std::ptrdiff_t>(left++ * dim));
    }
    node.boxes.resize(left * dim);
    if (share <= kMuch * static_cast<double>(count)) {
      node.vain = 0;
    } else {
      node.vain = std::min(node.vain + 1, kMostVain);
      node.rest = 1 << 3 * node.vain;
    }
  }

  // One side: what it cuts off is certain. False when nothing is left.
  bool separate(std::span<Interval> box, bool wanted, std::vector<Interval>& cut_off) {
    contracted_.assign(box.begin(), box.end());
    if (!separator_.contract(contracted_, wanted)) {
      cut_off.insert(cut_off.end(), box.begin(), box.end());
      return false;
    }
    for (std::uint32_t v = 0; v < box.size(); ++v) {
      const Interval whole = box[v], &kept = contracted_[v];
      const bool is_whole = set_.unknowns[v].is_whole;
      const auto cut_off_here = [&](double lo, double hi) {
        if (!(lo < hi || (is_whole && lo == hi))) return false;
        const std::size_t first = cut_off.size();
        cut_off.insert(cut_off.end(), box.begin(), box.end());
        cut_off[first + v] = Interval::raw(lo, hi);
        return true;
      };
      // A face of what is kept may belong to either side: a step off it is certain.
      constexpr double kStep = 0x1p-40;
      const double step = whole.is_bounded() ? kStep * (whole.hi() - whole.lo()) : 0.0;
      const double low = is_whole ? kept.lo() - 1.0 : up::next_down(kept.lo() - step);
      const double high = is_whole ? kept.hi() + 1.0 : up::next_up(kept.hi() + step);
      if (cut_off_here(whole.lo(), low)) box[v] = Interval::raw(is_whole ? kept.lo() : low, whole.hi());
      if (cut_off_here(high, whole.hi())) box[v] = Interval::raw(box[v].lo(), is_whole ? kept.hi() : high);
    }
    return true;
  }

  // Each across its widest side; those that are small enough are the boundary.
  void cut_boxes(const std::vector<Interval>& boxes) {
    next_.clear();
    for (std::size_t first = 0; first < boxes.size(); first += set_.dim) {
      const std::span<const Interval> box(&boxes[first], set_.dim);
      if (!cut(box)) found.boundary.insert(found.boundary.end(), box.begin(), box.end());
    }
  }

  // Such that the last parts are as wide as they may be, and their number no accident of the domain's width.
  [[nodiscard]] double cut_at(const Interval& side) const {
    constexpr double kMostParts = 0x1p40;
    const double width = side.hi() - side.lo(), parts = std::ceil(width / precision_);
    if (!(parts < kMostParts)) return cut_of(side);
    return side.lo() + width * (std::floor(0.5 * parts) / parts);
  }

  bool cut(std::span<const Interval> box) {
    tried_.assign(box.size(), 0);
    for (;;) {
      std::uint32_t widest = 0;
      double width = -1.0;
      for (std::uint32_t v = 0; v < box.size(); ++v) {
        const double own = box[v].hi() - box[v].lo();
        if (tried_[v] != 0 || own <= width || !(set_.unknowns[v].is_whole ? own > 0.0 : own > precision_))
          continue;
        widest = v;
        width = own;
      }
      if (width < 0.0) return false;
      if (cut_across(set_, box, widest, cut_at(box[widest]), next_)) return true;
      tried_[widest] = 1;
    }
  }

  const PointSet& set_;
  double precision_;
  std::size_t batch_;
  Membership membership_;
  Separator separator_;
  std::vector<Verdict> verdicts_;
  std::vector<Interval> next_, before_, contracted_;
  std::vector<std::uint8_t> tried_;
};

// The boxes of all pavers, in the order of the nodes that left them.
PavedBoxes gathered(const std::vector<const Paver*>& pavers) {
  struct Left {
    const Paver* by;
    const Paver::Leaves* leaves;
  };
  std::vector<Left> all;
  for (const Paver* paver : pavers) {
    for (const Paver::Leaves& leaves : paver->leaves) all.push_back({paver, &leaves});
  }
  std::sort(all.begin(), all.end(),
            [](const Left& a, const Left& b) { return a.leaves->path < b.leaves->path; });
  PavedBoxes boxes;
  std::size_t kind = 0;
  for (const auto of : {&PavedBoxes::inside, &PavedBoxes::boundary, &PavedBoxes::outside}) {
    std::size_t size = 0;
    for (const Paver* paver : pavers) size += (paver->found.*of).size();
    (boxes.*of).reserve(size);
    for (const auto& [by, leaves] : all) {
      const Interval* found = (by->found.*of).data();
      (boxes.*of).insert((boxes.*of).end(), found + leaves->first[kind], found + leaves->last[kind]);
    }
    ++kind;
  }
  return boxes;
}

}  // namespace

PavingAnswer pave(const PointSet& set, const SearchOptions& options) {
  // Many boxes at once are cheap where there is nothing but arithmetic to decide; else threads share them.
  constexpr std::size_t kFewBoxes = 4;
  const std::size_t batch = has_quantifier(set.dag, set.relation) ? kFewBoxes : Evaluation::kMaxLanes;
  PavingAnswer answer;
  Paver::Node root;
  for (std::size_t v = 0; v < set.dim; ++v) {
    const System::Unknown& unknown = set.unknowns[v];
    root.boxes.push_back(unknown.is_whole ? whole_numbers_of(unknown.domain) : unknown.domain);
    if (root.boxes.back().is_empty()) return answer;
  }
  std::mutex at_work;  // to make a paver adds to the graph
  TreeSearch<Paver> search(options, [&] {
    const std::lock_guard lock(at_work);
    return Paver(set, options, batch);
  });
  search.run({root});
  std::vector<const Paver*> pavers;
  for (const Paver& paver : search.explorers()) {
    answer.cells += paver.cells;
    pavers.push_back(&paver);
  }
  answer.boxes = gathered(pavers);
  for (const Paver::Node& node : search.open())
    answer.unexplored.insert(answer.unexplored.end(), node.boxes.begin(), node.boxes.end());
  return answer;
}

}  // namespace hcsp
