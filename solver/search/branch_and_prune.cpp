// SPDX-License-Identifier: Apache-2.0
#include "solver/search/branch_and_prune.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "domains/interval/kernel.h"
#include "solver/search/boxes.h"
#include "solver/search/checkpoint.h"
#include "solver/search/choices.h"
#include "solver/search/elimination.h"
#include "solver/search/hc4.h"
#include "solver/search/newton.h"
#include "solver/search/shaving.h"
#include "solver/search/tree_search.h"

namespace hcsp {

namespace {

bool lies_in(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](const Interval& x, const Interval& y) { return leq(x, y); });
}

bool have_a_common_point(const std::vector<Interval>& a, const std::vector<Interval>& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](const Interval& x, const Interval& y) { return !meet(x, y).is_empty(); });
}

// A found box with a box around it: of a unique solution, one that holds no other.
struct Leaf {
  FoundBox found;
  std::vector<Interval> reach;
};

// What a thread needs to look at boxes, and what it found.
class Explorer {
 public:
  Explorer(const System& system, const SearchOptions& options)
      : system_(system),
        options_(options),
        hc4_(system),
        shaving_(hc4_),
        choices_(system),
        forms_(system),
        elimination_(forms_),
        newton_(system, forms_),
        run_(*system.tape) {}
  Explorer(const Explorer&) = delete;
  Explorer& operator=(const Explorer&) = delete;

  /// A box, of which the unknown that was cut last may be all that is new.
  struct Node {
    std::vector<Interval> box;
    std::optional<std::uint32_t> cut_last;
    double priority = 0.0;  // the widest first
  };
  /// Contracts a box and cuts what is left in two. Nothing is left to cut where there is no solution, or
  /// where one is found.
  void explore(Node& node, std::vector<Node>& children) {
    std::vector<Interval>& box = node.box;
    ++cells;
    if (!contract(box, node.cut_last)) return;
    if (is_inner(box)) return keep_inner(box);
    const std::optional<std::uint32_t> cut = choose_cut(box, node.cut_last);
    if (!cut) return keep_small(box);
    const double at = cut_of(box[*cut]);
    children.push_back(half(box, *cut, Interval::raw(box[*cut].lo(), at)));
    children.push_back(half(box, *cut, Interval::raw(at, box[*cut].hi())));
  }

  std::vector<Leaf> leaves;
  std::uint64_t cells = 0;

 private:
  // False when nothing is left, or what is left was kept.
  bool contract(std::vector<Interval>& box, std::optional<std::uint32_t> cut_last) {
    if (!(cut_last ? hc4_.contract(box, *cut_last) : hc4_.contract(box))) return false;
    if (!choices_.contract(box) || !eliminate(box) || !shave(box) || !eliminate(box)) return false;
    for (;;) {
      const std::vector<Interval> before = box;
      const Newton::Outcome outcome = newton_.contract(box);
      if (outcome == Newton::Outcome::empty) return false;
      if (outcome == Newton::Outcome::proven && newton_.is_one()) return keep_alone(), false;
      if (outcome == Newton::Outcome::nothing || !is_much_less(before, box)) return true;
      if (!hc4_.contract(box) || !choices_.contract(box)) return false;
    }
  }

  // While it gains much.
  bool eliminate(std::vector<Interval>& box) {
    constexpr int kMostRounds = 5;
    for (int round = 0; round < kMostRounds; ++round) {
      const std::vector<Interval> before = box;
      if (!elimination_.contract(box)) return false;
      if (!is_much_less(before, box)) return true;
      if (!hc4_.contract(box)) return false;
    }
    return true;
  }

  // By every unknown, those first with which the equations vary most.
  bool shave(std::vector<Interval>& box) {
    order_.resize(box.size());
    for (std::uint32_t v = 0; v < box.size(); ++v) order_[v] = v;
    const std::vector<double>& smear = forms_.smear(box);
    std::stable_sort(order_.begin(), order_.end(), [&](auto u, auto v) { return smear[u] > smear[v]; });
    return std::all_of(order_.begin(), order_.end(), [&](auto v) { return shaving_.contract(box, v); });
  }

  static bool is_much_less(const std::vector<Interval>& before, const std::vector<Interval>& now) {
    constexpr double kMuch = 0.9;
    return is_less_than(kMuch, before, now);
  }

  static Node half(const std::vector<Interval>& box, std::uint32_t cut, const Interval& part) {
    Node node{box, cut};
    node.box[cut] = part;
    for (const Interval& side : node.box) node.priority = std::min(node.priority, -width_of(side));
    return node;
  }

  // Of the unknowns that are wider than the precision: which is cut.
  std::optional<std::uint32_t> choose_cut(const std::vector<Interval>& box,
                                          std::optional<std::uint32_t> cut_last) {
    const auto is_worth_cutting = [&](std::uint32_t v) {
      return width_of(box[v]) > options_.precision && is_divisible(box[v]);
    };
    const auto n = static_cast<std::uint32_t>(box.size());
    if (options_.bisector == Bisector::round_robin) {
      for (std::uint32_t k = 1; k <= n; ++k) {
        const std::uint32_t v = (cut_last.value_or(n - 1) + k) % n;
        if (is_worth_cutting(v)) return v;
      }
      return {};
    }
    const std::vector<double>* smear = nullptr;
    if (options_.bisector == Bisector::smear) smear = &forms_.smear(box);
    if (options_.bisector == Bisector::smear_max) smear = &forms_.smear_max(box);
    std::optional<std::uint32_t> best;
    const auto merit = [&](std::uint32_t v) {
      return std::pair(smear != nullptr ? (*smear)[v] : 0.0, width_of(box[v]));
    };
    for (std::uint32_t v = 0; v < n; ++v) {
      if (is_worth_cutting(v) && (!best || merit(v) > merit(*best))) best = v;
    }
    return best;
  }

  // Every point is a solution.
  bool is_inner(const std::vector<Interval>& box) {
    return newton_.equations() == 0 && whole_where_asked(box) && all_hold(box);
  }

  [[nodiscard]] bool whole_where_asked(const std::vector<Interval>& box) const {
    for (std::size_t v = 0; v < box.size(); ++v) {
      if (system_.is_whole[v] != 0 && !box[v].is_point()) return false;
    }
    return true;
  }

  // All relations but equations, and what is implied, hold for every point of a box.
  bool all_hold(const std::vector<Interval>& box) {
    run_.evaluate(box, false);
    for (std::size_t i = 0; i < system_.relations.size(); ++i) {
      const System::Relation& relation = system_.relations[i];
      if (relation.is_equation() || relation.is_implied) continue;
      const double most = run_.value(i).hi();
      const bool holds = relation.strict ? most < 0.0 : most <= 0.0;
      if (!holds || !run_.is_continuous(i)) return false;
    }
    return choices_.all_hold(box);
  }

  // The ends of domains that no double is are left aside.
  void keep_inner(std::vector<Interval> box) {
    for (std::size_t v = 0; v < box.size(); ++v) {
      const Interval whole = box[v], certain = meet(whole, system_.certain[v]);
      if (certain == whole) continue;
      if (certain.is_empty()) return keep(box, Certificate::none, Reason::boundary);
      for (const Interval& end :
           {Interval::raw(whole.lo(), certain.lo()), Interval::raw(certain.hi(), whole.hi())}) {
        box[v] = end;
        if (!end.is_point()) keep(box, Certificate::none, Reason::boundary);
      }
      box[v] = certain;
    }
    keep(box, Certificate::inner, Reason::proven);
  }

  // Newton proved that its enclosure holds the one solution of the equations, or of some of them, near a box.
  // It may be the neighbour's, or no solution of the rest.
  void keep_alone() {
    std::vector<Interval> box = newton_.enclosure();
    bool is_within = whole_where_asked(box);
    for (std::size_t v = 0; v < box.size(); ++v) {
      is_within = is_within && leq(box[v], system_.certain[v]);
      box[v] = meet(box[v], system_.domains[v]);
      if (box[v].is_empty()) return;
    }
    if (!hc4_.contract(box)) return;
    if (newton_.equations() > box.size()) return keep(box, Certificate::none, Reason::overdetermined);
    if (!is_within || !all_hold(box)) return keep(box, Certificate::none, Reason::boundary);
    keep(newton_.enclosure(), Certificate::unique, Reason::proven);
  }

  // A box that is not cut any more: there is a solution for every value of the parameters, or nothing is
  // proven.
  void keep_small(std::vector<Interval> box) {
    const std::size_t equations = newton_.equations();
    if (equations == 0) return keep(box, Certificate::none, Reason::boundary);
    if (newton_.prove_alone(box, options_.precision)) return keep_alone();
    if (equations >= box.size())
      return keep(box, Certificate::none, equations > box.size() ? Reason::overdetermined : Reason::singular);
    if (newton_.prove_some(box) && lies_in(newton_.enclosure(), system_.certain) &&
        whole_where_asked(newton_.enclosure()) && all_hold(newton_.enclosure()))
      return keep(newton_.enclosure(), Certificate::exists, Reason::proven);
    keep(box, Certificate::none, Reason::manifold);
  }

  void keep(const std::vector<Interval>& box, Certificate certificate, Reason reason) {
    leaves.push_back({{box, certificate, reason}, newton_.reach()});
  }

  const System& system_;
  const SearchOptions& options_;
  Hc4 hc4_;
  Shaving shaving_;
  Choices choices_;
  MeanValueForms forms_;
  Elimination elimination_;
  Newton newton_;
  TapeRun run_;
  std::vector<std::uint32_t> order_;
};

class Search {
 public:
  Search(const System& system, const SearchOptions& options)
      : system_(system), options_(options), tree_(options, [&] { return Explorer(system, options); }) {}

  SearchAnswer run() {
    const std::uint64_t mark = mark_of(system_, "all", options_);
    std::vector<Explorer::Node> roots;
    if (options_.resume.empty()) {
      roots.push_back({system_.domains, {}});
    } else {
      roots = resume(opened(options_.resume, mark));
    }
    if (options_.checkpoint) {
      tree_.run(std::move(roots), [&](const auto& open) { options_.checkpoint(sealed(state(open), mark)); });
    } else {
      tree_.run(std::move(roots));
    }
    return gather();
  }

 private:
  nlohmann::json state(const std::vector<Explorer::Node>& open) {
    auto boxes = nlohmann::json::array(), leaves = nlohmann::json::array();
    for (const Explorer::Node& node : open)
      boxes.push_back({json_of(node.box), node.cut_last ? static_cast<std::int64_t>(*node.cut_last) : -1});
    std::uint64_t cells = cells_before_;
    const auto add = [&](const Leaf& leaf) {
      leaves.push_back(
          {json_of(leaf.found.box), leaf.found.certificate, leaf.found.reason, json_of(leaf.reach)});
    };
    std::for_each(leaves_before_.begin(), leaves_before_.end(), add);
    for (const Explorer& explorer : tree_.explorers()) {
      cells += explorer.cells;
      std::for_each(explorer.leaves.begin(), explorer.leaves.end(), add);
    }
    return {{"open", boxes}, {"leaves", leaves}, {"cells", cells}};
  }

  std::vector<Explorer::Node> resume(const nlohmann::json& state) {
    cells_before_ = state.at("cells").get<std::uint64_t>();
    for (const auto& leaf : state.at("leaves"))
      leaves_before_.push_back(
          {{box_of(leaf[0]), leaf[1].get<Certificate>(), leaf[2].get<Reason>()}, box_of(leaf[3])});
    std::vector<Explorer::Node> open;
    for (const auto& node : state.at("open")) {
      const auto cut_last = node[1].get<std::int64_t>();
      open.push_back({box_of(node[0]), {}});
      if (cut_last >= 0) open.back().cut_last = static_cast<std::uint32_t>(cut_last);
    }
    return open;
  }

  SearchAnswer gather() {
    SearchAnswer answer;
    answer.cells = cells_before_;
    std::vector<Leaf> leaves = std::move(leaves_before_);
    for (Explorer& explorer : tree_.explorers()) {
      answer.cells += explorer.cells;
      std::move(explorer.leaves.begin(), explorer.leaves.end(), std::back_inserter(leaves));
    }
    for (const Explorer::Node& node : tree_.open()) answer.unexplored.push_back(node.box);
    std::sort(answer.unexplored.begin(), answer.unexplored.end(), comes_before);
    std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
      if (a.found.box == b.found.box) return comes_before(a.reach, b.reach);
      return comes_before(a.found.box, b.found.box);
    });
    tell_once(leaves, answer.found);
    return answer;
  }

  // Two unique boxes with a common point have the same solution when one lies where the other's is alone.
  static void tell_once(const std::vector<Leaf>& leaves, std::vector<FoundBox>& found) {
    double widest = 0.0;
    for (const Leaf& leaf : leaves) {
      if (leaf.found.certificate == Certificate::unique)
        widest = std::max(widest, width_of(leaf.found.box[0]));
    }
    std::vector<const Leaf*> told;  // those that are unique
    for (const Leaf& leaf : leaves) {
      FoundBox box = leaf.found;
      bool is_new = true;
      for (auto known = told.rbegin(); box.certificate == Certificate::unique && known != told.rend();
           ++known) {
        const Leaf& other = **known;
        if (other.found.box[0].lo() + 2 * widest < box.box[0].lo()) break;
        if (lies_in(box.box, other.reach) || lies_in(other.found.box, leaf.reach)) {
          is_new = false;
          break;
        }
        if (have_a_common_point(box.box, other.found.box)) {
          box.certificate = Certificate::none;
          box.reason = Reason::singular;
        }
      }
      if (!is_new) continue;
      if (box.certificate == Certificate::unique) told.push_back(&leaf);
      found.push_back(std::move(box));
    }
  }

  const System& system_;
  const SearchOptions& options_;
  TreeSearch<Explorer> tree_;
  std::vector<Leaf> leaves_before_;  // those of the state that was resumed
  std::uint64_t cells_before_ = 0;
};

}  // namespace

SearchAnswer branch_and_prune(const System& system, const SearchOptions& options) {
  return Search(system, options).run();
}

}  // namespace hcsp
