// SPDX-License-Identifier: Apache-2.0
#include "solver/search/branch_and_bound.h"

#include <algorithm>
#include <cmath>

#include "solver/search/boxes.h"
#include "solver/search/feasible_point.h"
#include "solver/search/hc4.h"
#include "solver/search/incumbent.h"
#include "solver/search/local_search.h"
#include "solver/search/polytope_hull.h"
#include "solver/search/stationary.h"
#include "solver/search/tree_search.h"

namespace hcsp {

namespace {

// The search is over boxes of the unknowns and of the objective's value, which is the last.
class Bounder {
 public:
  struct Node {
    std::vector<Interval> box;
    double priority = -kInfinity;  // the least value that the objective may have there
  };

  Bounder(const Minimisation& problem, const SearchOptions& options, Incumbent& incumbent)
      : problem_(problem),
        options_(options),
        incumbent_(incumbent),
        hc4_(problem.with_value),
        choices_(problem.with_value),
        hull_(problem.with_value),
        objective_(problem),
        local_search_(problem),
        feasible_(problem.constraints),
        run_(*problem.with_value.tape) {
    if (problem.gradient) stationary_ = std::make_unique<Stationary>(problem);
  }
  Bounder(const Bounder&) = delete;
  Bounder& operator=(const Bounder&) = delete;

  void explore(Node& node, std::vector<Node>& children) {
    ++cells;
    std::vector<Interval>& box = node.box;
    if (!limit(box)) return;
    if (is_close_enough(box)) return keep(box);
    if (!contract(box)) return;
    if (stationary_ && (!stationary_->contract(box) || !hc4_.contract(box))) return;
    if (is_close_enough(box)) return keep(box);
    const std::optional<std::uint32_t> cut = choose_cut(box);
    if (!cut) return keep(box);
    const double at = cut_of(box[*cut]);
    for (const Interval& half : {Interval::raw(box[*cut].lo(), at), Interval::raw(at, box[*cut].hi())}) {
      children.push_back({box, value_in(box).lo()});
      children.back().box[*cut] = half;
    }
  }

  std::vector<std::vector<Interval>> leaves;
  std::uint64_t cells = 0;

 private:
  static Interval& value_in(std::vector<Interval>& box) { return box.back(); }

  // What is worse than the incumbent is out.
  bool limit(std::vector<Interval>& box) {
    value_in(box) = meet(value_in(box), Interval::raw(-kInfinity, incumbent_.value()));
    return !value_in(box).is_empty();
  }
  bool is_close_enough(std::vector<Interval>& box) {
    const double best = incumbent_.value();
    return best < kInfinity && is_close(Interval::raw(value_in(box).lo(), best), options_.precision);
  }
  void keep(const std::vector<Interval>& box) { leaves.push_back(box); }

  bool contract(std::vector<Interval>& box) {
    if (!hc4_.contract(box) || !choices_.contract(box)) return false;
    constexpr int kMostRounds = 3;
    for (int round = 0; round < kMostRounds; ++round) {
      if (!hull_.contract_below(box, problem_.value())) return false;
      if (round == 0) look_for_point(box);
      if (!limit(box)) return false;
      if (is_close_enough(box)) return true;
      const std::vector<Interval> before = box;
      if (!hull_.contract_sides(box) || !hc4_.contract(box) || !choices_.contract(box)) return false;
      if (!is_much_less(before, box)) return true;
    }
    return true;
  }

  // From where the relaxation is least, and from the middle; with a local search now and then.
  void look_for_point(const std::vector<Interval>& box) {
    std::vector<double> start = hull_.least_at();
    const std::size_t n = problem_.constraints.size();
    if (start.empty()) {
      for (const Interval& side : box) start.push_back(side.mid());
    }
    start.resize(n);
    try_point(start);
    constexpr std::uint64_t kPeriod = 16;
    if (cells > kPeriod && cells % kPeriod != 0) return;
    for (const double margin : {0.0, 1e-12, 1e-8}) {
      constexpr int kMostSteps = 60;
      local_search_.improve(start, margin, kMostSteps);
      if (try_point(start)) return;
    }
  }

  bool try_point(const std::vector<double>& point) {
    if (!feasible_.find(point)) return false;
    incumbent_.offer(objective_.on(feasible_.box()).hi(), feasible_.box());
    return true;
  }

  static bool is_much_less(const std::vector<Interval>& before, const std::vector<Interval>& now) {
    constexpr double kMuch = 0.8;
    return !std::equal(now.begin(), now.end(), before.begin(), [](const Interval& x, const Interval& was) {
      return width_of(x) >= kMuch * width_of(was);
    });
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
    constexpr double kFine = 1e-3;  // of the precision
    return is_divisible(side) && (!side.is_bounded() ||
                                  width_of(side) > kFine * options_.precision * std::max(side.mag(), 1.0));
  }

  const Minimisation& problem_;
  const SearchOptions& options_;
  Incumbent& incumbent_;
  Hc4 hc4_;
  Choices choices_;
  PolytopeHull hull_;
  ObjectiveRun objective_;
  LocalSearch local_search_;
  FeasiblePoint feasible_;
  std::unique_ptr<Stationary> stationary_;
  TapeRun run_;
  std::vector<double> smear_;
  std::vector<Interval> slopes_;
};

bool touch(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](const Interval& x, const Interval& y) { return !meet(x, y).is_empty(); });
}

// Boxes that touch become the one box around them.
std::vector<std::vector<Interval>> clustered(std::vector<std::vector<Interval>> boxes) {
  std::vector<std::vector<Interval>> clusters;
  for (std::vector<Interval>& box : boxes) {
    for (auto other = clusters.begin(); other != clusters.end();) {
      if (!touch(box, *other)) {
        ++other;
        continue;
      }
      std::transform(box.begin(), box.end(), other->begin(), box.begin(),
                     [](const Interval& x, const Interval& y) { return join(x, y); });
      clusters.erase(other);
      other = clusters.begin();
    }
    clusters.push_back(std::move(box));
  }
  std::sort(clusters.begin(), clusters.end(), comes_before);
  return clusters;
}

}  // namespace

// Against the lesser of the bounds' sizes: then a bracket within a close one is close.
bool is_close(const Interval& minimum, double precision) {
  const double gap = minimum.hi() - minimum.lo();
  const bool one_sign = (minimum.lo() > 0) == (minimum.hi() > 0);
  const double size = one_sign ? std::min(std::abs(minimum.lo()), std::abs(minimum.hi())) : 0.0;
  return gap <= precision || gap <= precision * size;
}

MinimumAnswer branch_and_bound(const Minimisation& problem, const SearchOptions& options) {
  Incumbent incumbent;
  SearchOptions ordered = options;
  ordered.order = options.order.value_or(SearchOrder::best_first);
  TreeSearch<Bounder> tree(ordered, [&] { return Bounder(problem, options, incumbent); });
  tree.run({{problem.with_value.domains}});
  MinimumAnswer answer;
  const double best = incumbent.value();
  if (best < kInfinity) {
    answer.best = incumbent.box();
    answer.minimum = Interval::raw(best, best);
  }
  const auto take = [&](std::vector<Interval> box, std::vector<std::vector<Interval>>& to) {
    const Interval value = meet(box.back(), Interval::raw(-kInfinity, best));
    if (value.is_empty()) return;
    answer.minimum = join(answer.minimum, Interval::raw(value.lo(), best));
    box.pop_back();
    to.push_back(std::move(box));
  };
  for (Bounder& bounder : tree.explorers()) {
    answer.cells += bounder.cells;
    for (std::vector<Interval>& box : bounder.leaves) take(std::move(box), answer.boxes);
  }
  for (const Bounder::Node& node : tree.open()) take(node.box, answer.unexplored);
  answer.boxes = clustered(std::move(answer.boxes));
  std::sort(answer.unexplored.begin(), answer.unexplored.end(), comes_before);
  return answer;
}

}  // namespace hcsp
