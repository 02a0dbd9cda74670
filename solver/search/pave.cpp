// SPDX-License-Identifier: Apache-2.0
#include "solver/search/pave.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include <mutex>
#include <string>

#include "domains/interval/kernel.h"
#include "solver/expression/connectives.h"
#include "solver/search/checkpoint.h"
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

// What was found, and by which nodes.
struct Findings {
  // Where what a node left behind begins in `boxes`, and where it ends.
  struct Leaves {
    std::string path;
    std::array<std::size_t, 3> first, last;
  };
  PavedBoxes boxes;
  std::vector<Leaves> leaves;
  std::uint64_t cells = 0;
};

constexpr std::array kKinds{&PavedBoxes::inside, &PavedBoxes::boundary, &PavedBoxes::outside};

// What a thread needs to look at boxes, and what it found. A node is boxes side by side, which are decided
// together.
class Paver {
 public:
  struct Node {
    std::vector<Interval> boxes;
    std::string path;        // from the root: the order of nodes
    int rest = 0, vain = 0;  // how many cuts separators are not worth a try, and how often they gained little
  };
  Paver(const PointSet& set, const SearchOptions& options)
      : set_(set),
        precision_(options.precision),
        is_quantified_(has_quantifier(set.dag, set.relation)),
        membership_(set),
        separator_(set) {}
  Paver(const Paver&) = delete;
  Paver& operator=(const Paver&) = delete;

  void explore(Node& node, std::vector<Node>& children) {
    const std::array<std::size_t, 3> first_found = sizes();
    findings.cells += node.boxes.size() / set_.dim;
    keep_open(node.boxes);
    if (node.rest > 0) {
      --node.rest;
    } else {
      separate(node);
    }
    cut_boxes(node.boxes);
    findings.leaves.push_back({node.path, first_found, sizes()});
    // Many at once are cheap where there is nothing but arithmetic to decide; else threads share them.
    constexpr std::size_t kMany = 4 * Evaluation::kMaxLanes, kFew = 4;
    const std::size_t most = (is_quantified_ ? kFew : kMany) * set_.dim;
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

  Findings findings;

 private:
  [[nodiscard]] std::array<std::size_t, 3> sizes() const {
    return {found_.inside.size(), found_.boundary.size(), found_.outside.size()};
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
        auto& kind = verdicts_[k] == Verdict::yes ? found_.inside : found_.outside;
        kind.insert(kind.end(), box, end);
      }
    }
    boxes.erase(left, boxes.end());
  }

  // Where they gain little they are tried less and less often: to cut a box and decide its parts costs a
  // twentieth of a contraction, unless there are quantifiers to decide.
  void separate(Node& node) {
    constexpr double kMuch = 0x1p-5, kMuchBesideQuantifiers = 0.5;
    constexpr int kMostVain = 6;
    const double much = is_quantified_ ? kMuchBesideQuantifiers : kMuch;
    const std::size_t dim = set_.dim;
    double share = 0.0;
    std::size_t left = 0;
    const std::size_t count = node.boxes.size() / dim;
    for (std::size_t k = 0; k < count; ++k) {
      const std::span<Interval> box(&node.boxes[k * dim], dim);
      before_.assign(box.begin(), box.end());
      if (!separate(box, true, found_.outside) || !separate(box, false, found_.inside)) continue;
      share += volume_share(box, before_);
      std::copy(box.begin(), box.end(), node.boxes.begin() + static_cast<std::ptrdiff_t>(left++ * dim));
    }
    node.boxes.resize(left * dim);
    if (share <= much * static_cast<double>(count)) {
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
      const bool cuts_low = !is_whole || are_next(low, kept.lo()),
                 cuts_high = !is_whole || are_next(kept.hi(), high);
      if (cuts_low && cut_off_here(whole.lo(), low))
        box[v] = Interval::raw(is_whole ? kept.lo() : low, whole.hi());
      if (cuts_high && cut_off_here(high, whole.hi()))
        box[v] = Interval::raw(box[v].lo(), is_whole ? kept.hi() : high);
    }
    return true;
  }

  // Each across its widest side; those that are small enough are the boundary.
  void cut_boxes(const std::vector<Interval>& boxes) {
    next_.clear();
    for (std::size_t first = 0; first < boxes.size(); first += set_.dim) {
      const std::span<const Interval> box(&boxes[first], set_.dim);
      if (!cut(box)) found_.boundary.insert(found_.boundary.end(), box.begin(), box.end());
    }
  }

  // Such that the last parts are as wide as they may be, and their number no accident of the domain's width.
  [[nodiscard]] double cut_at(const Interval& side) const {
    constexpr double kMostParts = 0x1p40, kForRounding = 1 + 0x1p-40;
    const double width = side.hi() - side.lo(), least = kForRounding * (width / precision_);
    if (!(least < kMostParts)) return cut_of(side);
    const std::int64_t parts = static_cast<std::int64_t>(least) + 1;
    if (parts % 2 == 0) return cut_of(side);
    return side.lo() + width * (static_cast<double>(parts / 2) / static_cast<double>(parts));
  }

  // Across the widest of the sides that are to be cut and can be; narrower ones seldom have to be tried.
  bool cut(std::span<const Interval> box, double below = kInfinity) {
    std::uint32_t widest = 0;
    double width = -1.0;
    for (std::uint32_t v = 0; v < box.size(); ++v) {
      const double own = box[v].hi() - box[v].lo();
      const bool is_wide = own > (set_.unknowns[v].is_whole ? 0.0 : precision_);
      if (!is_wide || own <= width || !(own < below || below == kInfinity)) continue;
      widest = v;
      width = own;
    }
    if (width < 0.0) return false;
    return cut_across(set_, box, widest, cut_at(box[widest]), next_) ||
           (width < kInfinity && cut(box, width));
  }

  PavedBoxes& found_ = findings.boxes;
  const PointSet& set_;
  double precision_;
  bool is_quantified_;
  Membership membership_;
  Separator separator_;
  std::vector<Verdict> verdicts_;
  std::vector<Interval> next_, before_, contracted_;
};

// All that was found, in the order of the nodes that left it.
PavedBoxes gathered(const std::vector<Findings*>& parts) {
  struct Left {
    const PavedBoxes* boxes;
    const Findings::Leaves* leaves;
  };
  const auto comes_before = [](const Left& a, const Left& b) { return a.leaves->path < b.leaves->path; };
  std::vector<Left> all;
  for (const Findings* part : parts) {
    for (const Findings::Leaves& leaves : part->leaves) all.push_back({&part->boxes, &leaves});
  }
  if (parts.size() == 1 && std::is_sorted(all.begin(), all.end(), comes_before))
    return std::move(parts.front()->boxes);
  std::sort(all.begin(), all.end(), comes_before);
  PavedBoxes gathered;
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind) {
    std::vector<Interval>& one_kind = gathered.*kKinds[kind];
    std::size_t size = 0;
    for (const Findings* part : parts) size += (part->boxes.*kKinds[kind]).size();
    one_kind.reserve(size);
    for (const auto& [boxes, leaves] : all) {
      const Interval* found = (boxes->*kKinds[kind]).data();
      one_kind.insert(one_kind.end(), found + leaves->first[kind], found + leaves->last[kind]);
    }
  }
  return gathered;
}

nlohmann::json json_of(const Findings& findings) {
  auto leaves = nlohmann::json::array(), boxes = nlohmann::json::array();
  for (const Findings::Leaves& some : findings.leaves) leaves.push_back({some.path, some.first, some.last});
  for (const auto kind : kKinds) boxes.push_back(json_of(findings.boxes.*kind));
  return {{"leaves", leaves}, {"boxes", boxes}, {"cells", findings.cells}};
}

Findings findings_of(const nlohmann::json& state) {
  Findings findings;
  for (const auto& some : state.at("leaves"))
    findings.leaves.push_back(
        {some[0], some[1].get<std::array<std::size_t, 3>>(), some[2].get<std::array<std::size_t, 3>>()});
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
    findings.boxes.*kKinds[kind] = box_of(state.at("boxes")[kind]);
  findings.cells = state.at("cells").get<std::uint64_t>();
  return findings;
}

class PavingSearch {
 public:
  PavingSearch(const PointSet& set, const SearchOptions& options)
      : set_(set),
        options_(options),
        mark_(mark_of(set.dag, {set.relation}, set.unknowns, fmt::format("pave {}", set.dim), options)),
        tree_(options, [this] {
          const std::lock_guard lock(making_);
          return Paver(set_, options_);
        }) {}

  PavingAnswer run() {
    std::vector<Paver::Node> roots = options_.resume.empty() ? whole_domain() : resume();
    if (options_.checkpoint) {
      tree_.run(std::move(roots), [&](const auto& open) { options_.checkpoint(sealed(state(open), mark_)); });
    } else {
      tree_.run(std::move(roots));
    }
    PavingAnswer answer;
    const std::vector<Findings*> parts = all_findings();
    for (const Findings* part : parts) answer.cells += part->cells;
    answer.boxes = gathered(parts);
    for (const Paver::Node& node : tree_.open())
      answer.unexplored.insert(answer.unexplored.end(), node.boxes.begin(), node.boxes.end());
    return answer;
  }

 private:
  [[nodiscard]] std::vector<Paver::Node> whole_domain() const {
    Paver::Node root;
    for (std::size_t v = 0; v < set_.dim; ++v) {
      const System::Unknown& unknown = set_.unknowns[v];
      root.boxes.push_back(unknown.is_whole ? whole_numbers_of(unknown.domain) : unknown.domain);
      if (root.boxes.back().is_empty()) return {};
    }
    return {root};
  }

  std::vector<Findings*> all_findings() {
    std::vector<Findings*> parts;
    for (Findings& part : before_) parts.push_back(&part);
    for (Paver& paver : tree_.explorers()) parts.push_back(&paver.findings);
    return parts;
  }

  nlohmann::json state(const std::vector<Paver::Node>& open) {
    auto nodes = nlohmann::json::array(), found = nlohmann::json::array();
    for (const Paver::Node& node : open)
      nodes.push_back({json_of(node.boxes), node.path, node.rest, node.vain});
    for (const Findings* part : all_findings()) found.push_back(json_of(*part));
    return {{"open", nodes}, {"found", found}};
  }

  std::vector<Paver::Node> resume() {
    const nlohmann::json state = opened(options_.resume, mark_);
    for (const auto& part : state.at("found")) before_.push_back(findings_of(part));
    std::vector<Paver::Node> open;
    for (const auto& node : state.at("open"))
      open.push_back({box_of(node[0]), node[1], node[2].get<int>(), node[3].get<int>()});
    return open;
  }

  const PointSet& set_;
  const SearchOptions& options_;
  std::uint64_t mark_;
  std::mutex making_;  // a paver adds to the graph while it is made
  TreeSearch<Paver> tree_;
  std::vector<Findings> before_;  // those of the state that was resumed
};

}  // namespace

PavingAnswer pave(const PointSet& set, const SearchOptions& options) {
  return PavingSearch(set, options).run();
}

}  // namespace hcsp
