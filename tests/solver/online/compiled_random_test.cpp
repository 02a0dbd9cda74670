// SPDX-License-Identifier: Apache-2.0
// Random problems, each compiled once and solved for parameters that follow each other: what is said of all
// solutions against known ones, what is said of one against an independent evaluation and search, and what is
// said after other solves against a problem that was compiled afresh. HCSP_FULL=1 takes a hundred times as
// many; HCSP_SEED=n begins with that one.
#include <gtest/gtest.h>

#include <cstdlib>

#include "random_posed.h"
#include "tests/support/environment.h"

namespace hcsp {
namespace {

using oracle::below;
using oracle::one_in;
using oracle::Point;
using oracle::Random;
using oracle::RandomPosed;

struct Counts {
  int draws = 0, solved = 0, infeasible = 0, known = 0, searched = 0;
};

class RandomSequence {
 public:
  RandomSequence(std::uint64_t seed, Counts& counts)
      : seed_(seed),
        random_(seed * 7919 + 1),
        posed_(seed),
        counts_(counts),
        reused_(compile(posed_.problem, posed_.objective[0])) {}

  void run(int draws) {
    for (int draw = 0; draw < draws && !testing::Test::HasFailure(); ++draw) {
      where_ = fmt::format("HCSP_SEED={} draw {}", seed_, draw);
      const Point point = give_parameters();
      if (one_in(random_, 5)) reused_.forget();
      const bool is_odd = one_in(random_, 4);
      const int mode = oracle::kRoundingModes[static_cast<std::size_t>(below(random_, 4))];
      {
        std::optional<oracle::Environment> environment;
        if (is_odd) environment.emplace(mode, one_in(random_, 2));
        status_ = reused_.solve();
      }
      for (const auto& [id, value] : given_) where_ += fmt::format(" {}={}", name_of(id), to_string(value));
      SCOPED_TRACE(fmt::format("{}: {} {} in {} boxes", where_, to_string(status_),
                               to_string(reused_.objective()), reused_.boxes()));
      ++counts_.draws;
      counts_.solved += status_ == OnlineStatus::solved ? 1 : 0;
      counts_.infeasible += status_ == OnlineStatus::infeasible ? 1 : 0;
      check_known(point);
      check_samples(point);
      check_solution();
      check_afresh();
      if (one_in(random_, 4)) check_by_search();
    }
  }

 private:
  // Parameters and a point, which is a solution where the numbers that this takes are exact.
  Point give_parameters() {
    Point point = posed_.draw_point(random_);
    is_wide_ = one_in(random_, 10);
    const bool is_random = one_in(random_, 4);  // most likely no solution
    const auto draw = [&] { return one_in(random_, 3) ? 0.0 : 0.25 * (below(random_, 17) - 8); };
    for (const RealVariable& parameter : posed_.parameters) point[parameter.id] = Interval(draw());
    if (posed_.data) {
      constexpr std::array kPlay = {1e-12, 0.0, 0.5, -0.25};
      point[posed_.data->play] = Interval(kPlay[static_cast<std::size_t>(below(random_, 4))]);
      const bool is_whole = posed_.is_whole[index_of(posed_.data->unknown)];
      if (!is_whole) point[posed_.data->unknown] = point[posed_.data->least];
    }
    for (const RandomPosed::Side& side : posed_.sides) {
      const auto value = oracle::value_at(side.expression, point);
      if (is_random || !value || !value->is_bounded()) continue;
      const double slack = side.is_equation || one_in(random_, 2) ? 0.0 : 0.25 * below(random_, 5);
      point[side.offset] = Interval(value->hi()) + Interval(slack);
      if (!point[side.offset].is_point()) point[side.offset] = Interval(point[side.offset].hi());
    }
    given_.clear();
    for (const RealVariable& parameter : posed_.parameters) {
      const Interval at = point[parameter.id];
      const Interval wide = is_wide_ && one_in(random_, 2) ? Interval(at.lo(), at.hi() + 0.125) : at;
      given_[parameter.id] = wide;
      set(reused_, parameter.id);
    }
    return point;
  }

  [[nodiscard]] std::size_t index_of(VariableId unknown) const {
    const auto& all = posed_.unknowns;
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), unknown) - all.begin());
  }
  void set(CompiledProblem& compiled, VariableId id) {
    const Interval value = given_.at(id);
    ASSERT_TRUE(compiled.set(compiled.parameter(name_of(id)), std::span(&value, 1)));
  }
  [[nodiscard]] const std::string& name_of(VariableId id) const {
    return posed_.problem.graph().variable(id).name();
  }

  void check_feasible(const Point& point) {
    if (!posed_.certainly_solves(point)) return;
    const auto value = oracle::value_at(posed_.objective[0], point);
    if (!value) return;  // the objective has no value there
    ++counts_.known;
    EXPECT_NE(status_, OnlineStatus::infeasible) << "by " << reused_.reason();
    if (reused_.has_solution()) {
      EXPECT_LE(reused_.objective().lo(), value->hi());
    }
  }
  void check_known(const Point& point) { check_feasible(point); }
  void check_samples(const Point& known) {
    for (int i = 0; i < 20; ++i) {
      Point point = posed_.draw_point(random_);
      for (const auto& [id, value] : known) point.try_emplace(id, value);
      for (const VariableId id : posed_.unknowns) {
        if (one_in(random_, 2)) point[id] = known.at(id);
      }
      check_feasible(point);
    }
  }

  // All that was stated is possible on the box that holds the solution, and the objective's value is there.
  void check_solution() {
    if (!reused_.has_solution()) return;
    Point box = given_;
    for (std::size_t i = 0; i < posed_.unknowns.size(); ++i) {
      const Interval value = reused_.value(RealVariable{posed_.unknowns[i]});
      ASSERT_FALSE(value.is_empty());
      EXPECT_FALSE(meet(value, posed_.declared[i]).is_empty());
      box[posed_.unknowns[i]] = value;
    }
    for (const Expr& relation : posed_.all) EXPECT_TRUE(oracle::value_at(relation, box)->contains(1.0));
    const auto objective = oracle::value_at(posed_.objective[0], box);
    if (!objective) return;  // sqrt(x - x) on a box
    EXPECT_GE(reused_.objective().hi(), objective->lo());
    EXPECT_LE(reused_.objective().lo(), objective->hi());
  }

  void check_afresh() {
    RandomPosed posed(seed_);
    CompiledProblem fresh = compile(posed.problem, posed.objective[0]);
    for (const auto& [id, value] : given_) set(fresh, id);
    const OnlineStatus status = fresh.solve();
    if (status == OnlineStatus::infeasible) {
      EXPECT_FALSE(reused_.has_solution());
    }
    if (status_ == OnlineStatus::infeasible) {
      EXPECT_FALSE(fresh.has_solution());
    }
    if (fresh.has_solution() && reused_.has_solution()) {
      EXPECT_FALSE(meet(fresh.objective(), reused_.objective()).is_empty())
          << to_string(fresh.objective()) << to_string(reused_.objective());
    }
  }

  // The general search, of the whole problem and of a box around the solution.
  void check_by_search() {
    if (is_wide_) return;
    const auto [result, has_solution] = searched({});
    if (status_ == OnlineStatus::infeasible) {
      EXPECT_FALSE(has_solution);
    }
    if (result.status == Status::infeasible) {
      EXPECT_FALSE(reused_.has_solution());
    }
    if (reused_.has_solution() && result.objective && result.status != Status::infeasible) {
      EXPECT_GE(reused_.objective().hi(), result.objective->lo());
      if (has_solution) {
        EXPECT_LE(reused_.objective().lo(), result.objective->hi());
      }
    }
    if (!reused_.has_solution()) return;
    std::map<std::string, Interval> box;
    for (const VariableId id : posed_.unknowns) box[name_of(id)] = reused_.value(RealVariable{id});
    EXPECT_NE(searched(box).first.status, Status::infeasible);
  }

  std::pair<Result, bool> searched(std::map<std::string, Interval> domains) {
    ++counts_.searched;
    for (const auto& [id, value] : given_) domains[name_of(id)] = value;
    RandomPosed again(seed_, domains);
    SearchOptions options;
    options.precision = 1e-6;
    options.time_limit = 300.0;
    options.clock = [now = 0.0]() mutable { return now += 1.0; };
    Result result = again.problem.minimize(again.objective[0], options);
    const bool has_solution =
        !result.search->solutions.empty() && result.search->solutions[0].certificate == Certificate::exists;
    return {std::move(result), has_solution};
  }

  std::uint64_t seed_;
  Random random_;
  RandomPosed posed_;
  Counts& counts_;
  CompiledProblem reused_;
  OnlineStatus status_ = OnlineStatus::undecided;
  Point given_;
  bool is_wide_ = false;
  std::string where_;
};

TEST(CompiledRandom, SaysNothingThatIsNotSo) {
  const bool is_full = std::getenv("HCSP_FULL") != nullptr;
  const char* first = std::getenv("HCSP_SEED");
  const std::uint64_t start = first == nullptr ? 1 : std::strtoull(first, nullptr, 10);
  Counts counts;
  for (std::uint64_t seed = start; seed < start + (is_full ? 50000U : 200U); ++seed) {
    std::optional<RandomSequence> sequence;
    try {
      sequence.emplace(seed, counts);
    } catch (const std::invalid_argument&) {
      continue;  // an equation between terms without a derivative, too many cases
    }
    sequence->run(8);
    if (HasFailure()) break;
  }
  RecordProperty("solved", counts.solved);
  fmt::print("{} draws, {} solved, {} infeasible, {} known solutions, {} searches\n", counts.draws,
             counts.solved, counts.infeasible, counts.known, counts.searched);
  if (first == nullptr) {
    EXPECT_GT(counts.solved, counts.draws / 4);
    EXPECT_GT(counts.infeasible, counts.draws / 50);
  }
}

}  // namespace
}  // namespace hcsp
