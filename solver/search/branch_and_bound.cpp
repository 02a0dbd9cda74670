// SPDX-License-Identifier: Apache-2.0
#include "solver/search/branch_and_bound.h"

#include <algorithm>
#include <cmath>

#include "domains/rounding.h"
#include "solver/search/boxes.h"
#include "solver/search/checkpoint.h"
#include "solver/search/feasible_point.h"
#include "solver/search/fritz_john.h"
#include "solver/search/hc4.h"
#include "solver/search/incumbent.h"
#include "solver/search/local_search.h"
#include "solver/search/polytope_hull.h"
#include "solver/search/stationary.h"
#include "solver/search/tree_search.h"

namespace hcsp {

namespace {

// What the threads share.
struct Shared {
  Incumbent incumbent;
  // Once the bracket is close: how many boxes may still be looked at to see closer where the minimisers are.
  bool is_settling = false;
  std::atomic<std::int64_t> budget = 0;
};

// The search is over boxes of the unknowns and of the objective's value, which is the last.
class Bounder {
 public:
  struct Node {
    std::vector<Interval> box;
    double priority = -kInfinity;  // the least value that the objective may have there
  };

  Bounder(const Minimisation& problem, const SearchOptions& options, Shared& shared)
      : problem_(problem),
        options_(options),
        shared_(shared),
        hc4_(problem.with_value),
        choices_(problem.with_value),
        hull_(problem.with_value),
        objective_(problem),
        local_search_(problem),
        feasible_(problem.constraints),
        fritz_john_(problem),
        run_(*problem.with_value.tape) {
    if (problem.gradient) stationary_ = std::make_unique<Stationary>(problem);
  }
  Bounder(const Bounder&) = delete;
  Bounder& operator=(const Bounder&) = delete;

  void explore(Node& node, std::vector<Node>& children) {
    ++cells;
    std::vector<Interval>& box = node.box;
    if (!limit(box)) return;
    if (is_done(box)) return keep(box);
    if (!contract(box)) return;
    if (stationary_ && (!stationary_->contract(box) || !hc4_.contract(box))) return;
    if (is_done(box)) return keep(box);
    const std::optional<std::uint32_t> cut = choose_cut(box);
    if (!cut) {
      try_point(middle_of_point(box));
      if (limit(box)) keep(box);
      return;
    }
    const double at = cut_of(box[*cut]);
    for (const Interval& half : {Interval::raw(box[*cut].lo(), at), Interval::raw(at, box[*cut].hi())}) {
      children.push_back({box, priority_of(box)});
      children.back().box[*cut] = half;
    }
  }

  // The least lower bound first; of those that are close enough, the widest.
  double priority_of(const std::vector<Interval>& box) const {
    if (!shared_.is_settling) return box.back().lo();
    double widest = 0.0;
    for (std::size_t v = 0; v + 1 < box.size(); ++v) widest = std::max(widest, width_of(box[v]));
    return -widest;
  }

  std::vector<std::vector<Interval>> leaves;
  std::uint64_t cells = 0;

 private:
  static Interval& value_in(std::vector<Interval>& box) { return box.back(); }

  // What is worse than the incumbent is out.
  bool limit(std::vector<Interval>& box) {
    value_in(box) = meet(value_in(box), Interval::raw(-kInfinity, shared_.incumbent.value()));
    return !value_in(box).is_empty();
  }
  bool is_done(std::vector<Interval>& box) {
    if (shared_.is_settling)
      return shared_.budget.fetch_sub(1, std::memory_order_relaxed) <= 0 || is_narrow(box);
    const double best = shared_.incumbent.value();
    return best < kInfinity && is_close(Interval::raw(value_in(box).lo(), best), options_);
  }
  static bool is_narrow(const std::vector<Interval>& box) {
    constexpr double kNarrow = 1e-6;
    return std::all_of(box.begin(), box.end() - 1, [](const Interval& side) {
      return width_of(side) <= kNarrow * std::max(side.mag(), 1.0);
    });
  }
  void keep(const std::vector<Interval>& box) { leaves.push_back(box); }

  bool contract(std::vector<Interval>& box) {
    if (!hc4_.contract(box) || !choices_.contract(box)) return false;
    constexpr int kMostRounds = 3;
    for (int round = 0; round < kMostRounds; ++round) {
      if (!hull_.contract_below(box, problem_.value()) || !limit(box)) return false;
      if (!shared_.is_settling && is_done(box)) return true;
      if (round == 0) look_for_point(box);
      if (!limit(box)) return false;
      if (!shared_.is_settling && is_done(box)) return true;
      if (is_refuted_by_multipliers(box)) return false;
      const std::vector<Interval> before = box;
      if (!hull_.contract_sides(box) || !hc4_.contract(box) || !choices_.contract(box)) return false;
      if (!is_much_less(before, box)) return true;
    }
    return true;
  }

  // Where that seldom tells anything, it is asked seldom.
  bool is_refuted_by_multipliers(const std::vector<Interval>& box) {
    constexpr std::uint64_t kFirst = 32, kLeastPart = 20, kSeldom = 8;
    const bool pays = asked_ < kFirst || refuted_ * kLeastPart >= asked_;
    if (!pays && cells % kSeldom != 0) return false;
    ++asked_;
    if (fritz_john_.may_hold_minimiser(box)) return false;
    ++refuted_;
    return true;
  }

  // From where the relaxation is least, and from the middle; with a local search now and then.
  void look_for_point(const std::vector<Interval>& box) {
    std::vector<double> start = hull_.least_at();
    if (start.empty()) start = middle_of_point(box);
    start.resize(problem_.constraints.size());
    try_point(start);
    constexpr std::uint64_t kPeriod = 16;
    if (cells > kPeriod && cells % kPeriod != 0) return;
    for (const double margin : {0.0, 1e-12, 1e-8}) {
      constexpr int kMostSteps = 60;
      local_search_.improve(start, margin, kMostSteps);
      if (try_point(start)) return;
    }
  }

  [[nodiscard]] static std::vector<double> middle_of_point(const std::vector<Interval>& box) {
    std::vector<double> middle;
    for (std::size_t v = 0; v + 1 < box.size(); ++v) middle.push_back(box[v].mid());
    return middle;
  }

  bool try_point(const std::vector<double>& point) {
    if (!feasible_.find(point)) return false;
    shared_.incumbent.offer(objective_.on(feasible_.box()).hi(), feasible_.box());
    return true;
  }

  static bool is_much_less(const std::vector<Interval>& before, const std::vector<Interval>& now) {
    constexpr double kMuch = 0.8;
    return is_less_than(kMuch, before, now);
  }

  // The unknown with which the relations and the objective vary most (Trombettoni et al. 2011, smearSumRel).
  std::optional<std::uint32_t> choose_cut(const std::vector<Interval>& box) {
    const System& system = problem_.with_value;
    smear_.assign(system.size(), 0.0);
    slopes_.assign(system.size(), Interval::raw(0.0, 0.0));
    run_.evaluate(box, true);
    for (std::size_t i = 0; i < system.relations.size(); ++i) {
      run_.gradient(i, slopes_);
      const auto part = [&](std::uint32_t v) {
        constexpr double kMost = 1e100;
        const double slope = slopes_[v].mag();
        return slope == 0.0 || v == problem_.value() ? 0.0 : std::min(slope * width_of(box[v]), kMost);
      };
      double total = 0.0;
      for (const std::uint32_t v : system.tape->variables(i)) total += part(v);
      if (total == 0.0) continue;
      for (const std::uint32_t v : system.tape->variables(i)) smear_[v] += part(v) / total;
    }
    std::optional<std::uint32_t> best;
    const auto merit = [&](std::uint32_t v) { return std::pair(smear_[v], width_of(box[v])); };
    for (std::uint32_t v = 0; v < problem_.value(); ++v) {
      if (is_worth_cutting(box[v]) && (!best || merit(v) > merit(*best))) best = v;
    }
    return best;
  }

  [[nodiscard]] bool is_worth_cutting(const Interval& side) const {
    constexpr double kFine = 1e-3, kFinest = 1e-9;
    const double fine = std::min(kFine * options_.precision, kFinest);
    return is_divisible(side) && (!side.is_bounded() || width_of(side) > fine * std::max(side.mag(), 1.0));
  }

  const Minimisation& problem_;
  const SearchOptions& options_;
  Shared& shared_;
  Hc4 hc4_;
  Choices choices_;
  PolytopeHull hull_;
  ObjectiveRun objective_;
  LocalSearch local_search_;
  FeasiblePoint feasible_;
  FritzJohn fritz_john_;
  std::uint64_t asked_ = 0, refuted_ = 0;  // of boxes: by multipliers
  std::unique_ptr<Stationary> stationary_;
  TapeRun run_;
  std::vector<double> smear_;
  std::vector<Interval> slopes_;
};

// Whether two boxes are no farther from each other, along each axis, than the larger of them is wide.
bool are_near(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](const Interval& x, const Interval& y) {
    const double gap = std::max(x.lo() - y.hi(), y.lo() - x.hi());
    constexpr double kRounding = 1e-14;
    return gap <= std::max({width_of(x), width_of(y), kRounding * x.mag()});
  });
}

// Boxes near each other become the one box around them, until few are left.
std::vector<std::vector<Interval>> clustered(const std::vector<std::vector<Interval>>& boxes) {
  std::vector<std::vector<Interval>> clusters;
  for (std::vector<Interval> box : boxes) {
    const auto around = [&](const std::vector<Interval>& other) {
      std::transform(box.begin(), box.end(), other.begin(), box.begin(),
                     [](const Interval& x, const Interval& y) { return join(x, y); });
    };
    for (std::size_t k = 0; k < clusters.size();) {
      constexpr std::size_t kMost = 1000;
      if (clusters.size() < kMost && !are_near(box, clusters[k])) {
        ++k;
        continue;
      }
      around(clusters[k]);
      clusters[k] = std::move(clusters.back());
      clusters.pop_back();
      k = 0;
    }
    clusters.push_back(std::move(box));
  }
  std::sort(clusters.begin(), clusters.end(), comes_before);
  return clusters;
}

// The search, its state at rest, and its answer.
class Minimiser {
 public:
  Minimiser(const Minimisation& problem, const SearchOptions& options)
      : problem_(problem),
        options_(options),
        tree_(options_, [&] { return Bounder(problem_, options_, shared_); }) {}

  MinimumAnswer run(const KnownOptimum& known) {
    if (known.solution) offer(*known.solution);
    const std::uint64_t mark = mark_of(problem_.with_value, "minimize", options_);
    std::vector<Bounder::Node> roots;
    if (options_.resume.empty()) {
      add_root(known.minimum, roots);
    } else {
      resume(opened(options_.resume, mark), roots);
    }
    std::function<void(const std::vector<Bounder::Node>&)> at_rest;
    if (options_.checkpoint)
      at_rest = [&](const auto& open) { options_.checkpoint(sealed(state(open), mark)); };
    if (tree_.run(std::move(roots), at_rest) && shared_.incumbent.value() < kInfinity) settle();
    return gather();
  }

 private:
  void add_root(const Interval& minimum, std::vector<Bounder::Node>& roots) const {
    if (minimum.is_empty()) return;
    Bounder::Node root{problem_.with_value.domains};
    root.box.back() = meet(root.box.back(), Interval::raw(minimum.lo(), kInfinity));
    roots.push_back(std::move(root));
  }

  void offer(const std::vector<Interval>& box) {
    const RoundUpward guard;
    shared_.incumbent.offer(ObjectiveRun(problem_).on(box).hi(), box);
  }

  // Boxes whose lower bounds are close enough may be wide: a part of the work so far goes into cutting them.
  void settle() {
    std::vector<Bounder::Node> wide;
    std::uint64_t cells = 0;
    shared_.is_settling = true;
    const auto take = [&](const Bounder& bounder, std::vector<std::vector<Interval>>& leaves) {
      for (std::vector<Interval>& leaf : leaves) {
        const double priority = bounder.priority_of(leaf);
        wide.push_back({std::move(leaf), priority});
      }
      leaves.clear();
    };
    for (Bounder& bounder : tree_.explorers()) {
      cells += bounder.cells;
      take(bounder, bounder.leaves);
      if (&bounder == &*tree_.explorers().begin()) take(bounder, leaves_before_);
    }
    constexpr std::int64_t kLeast = 50, kPart = 4;
    shared_.budget =
        kLeast + static_cast<std::int64_t>(cells) / kPart + 2 * static_cast<std::int64_t>(wide.size());
    tree_.run(std::move(wide));
  }

  nlohmann::json state(const std::vector<Bounder::Node>& open) {
    auto boxes = nlohmann::json::array(), leaves = nlohmann::json::array();
    for (const Bounder::Node& node : open) boxes.push_back(json_of(node.box));
    for (const auto& leaf : leaves_before_) leaves.push_back(json_of(leaf));
    std::uint64_t cells = cells_before_;
    for (const Bounder& bounder : tree_.explorers()) {
      cells += bounder.cells;
      for (const auto& leaf : bounder.leaves) leaves.push_back(json_of(leaf));
    }
    std::vector<Interval> best = shared_.incumbent.box();
    if (!best.empty()) best.push_back(Interval::raw(shared_.incumbent.value(), shared_.incumbent.value()));
    return {{"open", boxes}, {"leaves", leaves}, {"best", json_of(best)}, {"cells", cells}};
  }

  void resume(const nlohmann::json& state, std::vector<Bounder::Node>& open) {
    cells_before_ = state.at("cells").get<std::uint64_t>();
    for (const auto& leaf : state.at("leaves")) leaves_before_.push_back(box_of(leaf));
    std::vector<Interval> best = box_of(state.at("best"));
    if (!best.empty()) {
      const double value = best.back().hi();
      best.pop_back();
      shared_.incumbent.offer(value, best);
    }
    for (const auto& box : state.at("open")) {
      open.push_back({box_of(box)});
      open.back().priority = open.back().box.back().lo();
    }
  }

  MinimumAnswer gather() {
    MinimumAnswer answer;
    const double best = shared_.incumbent.value();
    if (best < kInfinity) {
      answer.best = shared_.incumbent.box();
      answer.minimum = Interval::raw(best, best);
    }
    const auto take = [&](std::vector<Interval> box, std::vector<std::vector<Interval>>& to) {
      if (box.back().lo() > best) return;
      answer.minimum = join(answer.minimum, Interval::raw(box.back().lo(), best));
      box.pop_back();
      to.push_back(std::move(box));
    };
    answer.cells = cells_before_;
    for (const auto& leaf : leaves_before_) take(leaf, answer.boxes);
    for (Bounder& bounder : tree_.explorers()) {
      answer.cells += bounder.cells;
      for (const auto& leaf : bounder.leaves) take(leaf, answer.boxes);
    }
    // What settling left is explored: it is as close as was asked for.
    for (const Bounder::Node& node : tree_.open())
      take(node.box, shared_.is_settling ? answer.boxes : answer.unexplored);
    answer.boxes = clustered(answer.boxes);
    std::sort(answer.unexplored.begin(), answer.unexplored.end(), comes_before);
    return answer;
  }

  const Minimisation& problem_;
  const SearchOptions options_;
  Shared shared_;
  TreeSearch<Bounder> tree_;
  std::vector<std::vector<Interval>> leaves_before_;  // those of the state that was resumed
  std::uint64_t cells_before_ = 0;
};

}  // namespace

// Against the lesser of the bounds' sizes: then a bracket within a close one is close.
bool is_close(const Interval& minimum, const SearchOptions& options) {
  const double gap = minimum.hi() - minimum.lo();
  const bool one_sign = (minimum.lo() > 0) == (minimum.hi() > 0);
  const double size = one_sign ? std::min(std::abs(minimum.lo()), std::abs(minimum.hi())) : 0.0;
  const double absolute = options.absolute_precision > 0 ? options.absolute_precision : options.precision;
  return gap <= absolute || gap <= options.precision * size;
}

MinimumAnswer branch_and_bound(const Minimisation& problem, const SearchOptions& options,
                               const KnownOptimum& known) {
  SearchOptions ordered = options;
  if (!ordered.order) ordered.order = SearchOrder::best_first;
  return Minimiser(problem, ordered).run(known);
}

}  // namespace hcsp
