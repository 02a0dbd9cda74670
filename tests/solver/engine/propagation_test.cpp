// SPDX-License-Identifier: Apache-2.0
#include "solver/engine/propagation.h"

#include <gtest/gtest.h>

#include <atomic>

#include "domains/tube.h"
#include "tests/solver/engine/probe.h"
#include "tests/support/oracle.h"

namespace hcsp {
namespace {

using Names = std::vector<std::string>;

// Contractors that log their name when they run.
struct Log {
  ContractorGraph graph;
  Names runs;

  ContractorId add(
      const std::string& name, Cost cost, std::vector<VariableId> reads, std::vector<VariableId> writes,
      const ProbeContractor::Body& body = [](Access&) {}) {
    return add_probe(graph, name, cost, std::move(reads), std::move(writes),
                     [this, name, body](Access& access) {
                       runs.push_back(name);
                       body(access);
                     });
  }
};

TEST(Propagation, WakesWhatReadsAChangedVariableAndNothingElse) {
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 10)),
                   y = log.graph.add_variable("y", Interval(0, 10));
  log.add("reads x", Cost::constant, {x}, {});
  log.add("reads y", Cost::constant, {y}, {});
  log.add("writes x", Cost::linear, {y}, {x}, [x](Access& access) { narrow(access, x, {2, 3}); });
  log.add("writes y, in vain", Cost::linear, {x}, {y}, [y](Access& access) { narrow(access, y, {-1, 20}); });
  Propagation run(log.graph, {});
  EXPECT_EQ(run.run(), Ending::fixed_point);
  EXPECT_EQ(log.runs, (Names{"reads x", "reads y", "writes x", "reads x", "writes y, in vain"}));
  EXPECT_EQ(run.domain<Interval>(x), Interval(2, 3));
}

TEST(Propagation, ShowsAContractorTheDeltaSinceItsLastRun) {
  const auto line = std::make_shared<const TimeLine>(std::vector{0.0, 1.0, 2.0, 3.0});
  Log log;
  const VariableId x = log.graph.add_variable("x", Tube(line, 1)),
                   y = log.graph.add_variable("y", Interval());
  std::vector<std::vector<std::size_t>> seen;
  log.add("looks", Cost::search, {x}, {}, [&](Access& access) {
    seen.emplace_back();
    access.delta<Tube>(x).for_each([&](std::size_t item) { seen.back().push_back(item); });
  });
  int step = 0;
  log.add("writes", Cost::linear, {y}, {x, y}, [&](Access& access) {
    ItemSet changed;
    const auto item = static_cast<std::size_t>(step);
    if (access.edit<Tube>(x).meet_at(0, item, Interval(0, 1))) changed.insert(item);
    access.report<Tube>(x, changed);
    if (++step < 3) narrow(access, y, {0, 100.0 - step});
  });
  log.add("writes after the look", Cost::search, {y}, {x}, [&](Access& access) {
    ItemSet changed;
    if (access.edit<Tube>(x).meet_at(0, 5, Interval(0, 1))) changed.insert(5);
    access.report<Tube>(x, changed);
  });
  Propagation run(log.graph, {});
  EXPECT_EQ(run.run(), Ending::fixed_point);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0], (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6})) << "everything, the first time";
  EXPECT_EQ(seen[1], (std::vector<std::size_t>{5})) << "what it has seen already is not shown again";
}

TEST(Propagation, OwnChangesWakeUnlessSettled) {
  for (const bool settled : {false, true}) {
    Log log;
    const VariableId x = log.graph.add_variable("x", Interval(0, 10));
    log.add("halves", Cost::constant, {x}, {x}, [&](Access& access) {
      if (access.domain<Interval>(x).hi() > 3) narrow(access, x, {0, access.domain<Interval>(x).hi() / 2});
      if (settled) access.settled();
    });
    Propagation run(log.graph, {});
    EXPECT_EQ(run.run(), Ending::fixed_point);
    EXPECT_EQ(log.runs.size(), settled ? 1U : 3U);
  }
}

TEST(Propagation, ASettledContractorStillHearsOfOthers) {
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 10)),
                   y = log.graph.add_variable("y", Interval(0, 10));
  log.add("settled", Cost::constant, {x, y}, {x}, [&](Access& access) {
    narrow(access, x, {0, access.domain<Interval>(y).hi()});
    access.settled();
  });
  log.add("other", Cost::search, {x}, {y}, [&](Access& access) { narrow(access, y, {0, 4}); });
  Propagation run(log.graph, {});
  EXPECT_EQ(run.run(), Ending::fixed_point);
  EXPECT_EQ(run.domain<Interval>(x), Interval(0, 4));
}

TEST(Propagation, RunsCheapBeforeDearInEveryOrder) {
  for (const Order order : {Order::declared, Order::reversed, Order::shuffled}) {
    Log log;
    const VariableId x = log.graph.add_variable("x", Interval(0, 10));
    log.add("dear", Cost::search, {x}, {x}, [x](Access& access) { narrow(access, x, {0, 5}); });
    log.add("cheap", Cost::constant, {x}, {});
    log.add("middling", Cost::linear, {x}, {});
    PropagationOptions options;
    options.order = order;
    Propagation run(log.graph, options);
    EXPECT_EQ(run.run(), Ending::fixed_point);
    EXPECT_EQ(log.runs, (Names{"cheap", "middling", "dear", "cheap", "middling", "dear"}));
  }
}

TEST(Propagation, OrderTurnsAroundWithinACost) {
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 10));
  for (const char* name : {"a", "b", "c"}) log.add(name, Cost::constant, {x}, {});
  PropagationOptions options;
  options.order = Order::reversed;
  Propagation run(log.graph, options);
  EXPECT_EQ(run.run(), Ending::fixed_point);
  EXPECT_EQ(log.runs, (Names{"c", "b", "a"}));
}

class PassCounter final : public Propagation::Observer {
 public:
  explicit PassCounter(ContractorId watched) : watched_(watched) {}
  void after_contractor(const Propagation&, ContractorId id) override { runs_ += id == watched_ ? 1 : 0; }
  void after_pass(const Propagation& run) override {
    EXPECT_LE(runs_, 1) << "one of the dearest contractors ran twice in a pass";
    EXPECT_EQ(run.passes(), ++passes_);
    runs_ = 0;
  }
  [[nodiscard]] std::uint64_t passes() const { return passes_; }

 private:
  ContractorId watched_;
  int runs_ = 0;
  std::uint64_t passes_ = 0;
};

TEST(Propagation, NoneOfTheDearestContractorsRunsTwiceInAPass) {
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 64)),
                   y = log.graph.add_variable("y", Interval(0, 64));
  log.add("x below y", Cost::constant, {x, y}, {x}, [=](Access& access) {
    narrow(access, x, {0, access.domain<Interval>(y).hi()});
  });
  const ContractorId dear = log.add("y below x / 2", Cost::linear, {x}, {y}, [=](Access& access) {
    if (access.domain<Interval>(x).hi() > 1) narrow(access, y, {0, access.domain<Interval>(x).hi() / 2});
  });
  PassCounter counter(dear);
  Propagation run(log.graph, {});
  EXPECT_EQ(run.run(&counter), Ending::fixed_point);
  EXPECT_EQ(run.domain<Interval>(x), Interval(0, 1));
  EXPECT_EQ(counter.passes(), run.passes());
  EXPECT_EQ(run.passes(), 7U);
}

TEST(Propagation, CountsCallsAndSecondsOfTheInjectedClock) {
  double now = 100.0;
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 10));
  const ContractorId slow = log.add("slow", Cost::constant, {x}, {x}, [&](Access& access) {
    now += 0.25;
    narrow(access, x, {1, 4});
  });
  const ContractorId quick = log.add("quick", Cost::linear, {x}, {}, [&](Access&) { now += 0.125; });
  std::vector<double> progress;
  PropagationOptions options;
  options.clock = [&] { return now; };
  options.progress = [&](std::uint64_t, double seconds) { progress.push_back(seconds); };
  Propagation run(log.graph, options);
  EXPECT_EQ(run.run(), Ending::fixed_point);
  EXPECT_EQ(run.counts()[slow].calls, 2U);
  EXPECT_EQ(run.counts()[slow].seconds, 0.5);
  EXPECT_EQ(run.counts()[quick].calls, 1U);
  EXPECT_EQ(run.counts()[quick].seconds, 0.125);
  EXPECT_EQ(run.elapsed(), 0.625);
  ASSERT_FALSE(progress.empty());
  EXPECT_EQ(progress.back(), 0.625);
}

// A contractor that shrinks x for ever.
VariableId add_endless(
    Log& log, const std::function<void()>& during = [] {}) {
  const VariableId x = log.graph.add_variable("x", Interval(0, 1));
  log.add("endless", Cost::constant, {x}, {x}, [x, during](Access& access) {
    during();
    narrow(access, x, {0, access.domain<Interval>(x).hi() * (1 - 0x1p-10)});
  });
  return x;
}

TEST(Propagation, EndsAtTheTimeLimitWithAGuaranteedDomain) {
  double now = 0.0;
  Log log;
  const VariableId x = add_endless(log, [&] { now += 1.0; });
  PropagationOptions options;
  options.clock = [&] { return now; };
  options.time_limit = 10.0;
  Propagation run(log.graph, options);
  EXPECT_EQ(run.run(), Ending::limit);
  EXPECT_EQ(log.runs.size(), 10U);
  EXPECT_TRUE(run.domain<Interval>(x).contains(0.0));
}

TEST(Propagation, TheCancelFlagEndsTheRun) {
  std::atomic<bool> cancel{false};
  Log log;
  add_endless(log, [&] { cancel = log.runs.size() >= 5; });
  PropagationOptions options;
  options.cancel = &cancel;
  Propagation run(log.graph, options);
  EXPECT_EQ(run.run(), Ending::limit);
  EXPECT_EQ(log.runs.size(), 5U);
}

TEST(Propagation, AContractorIsToldToStop) {
  std::atomic<bool> cancel{true};
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 10));
  std::vector<bool> told;
  log.add("asks", Cost::constant, {x}, {x}, [&](Access& access) {
    cancel = false;
    told.push_back(access.should_stop());
    cancel = true;
    told.push_back(access.should_stop());
  });
  cancel = false;
  PropagationOptions options;
  options.cancel = &cancel;
  Propagation run(log.graph, options);
  EXPECT_EQ(run.run(), Ending::limit);
  EXPECT_EQ(told, (std::vector{false, true}));
}

TEST(Propagation, TheThresholdMayOnlyEndARun) {
  Log exact;
  const VariableId x = add_endless(exact);
  PropagationOptions options;
  options.threshold = 0.01;
  Propagation run(exact.graph, options);
  EXPECT_EQ(run.run(), Ending::limit) << "a run that the threshold ended is no fixed point";
  EXPECT_LT(exact.runs.size(), 10U);
  EXPECT_GT(run.domain<Interval>(x).hi(), 0.99);

  Log coarse;  // every pass is worth more than the threshold until nothing changes
  const VariableId y = coarse.graph.add_variable("y", Interval(0, 1024));
  coarse.add("halves", Cost::constant, {y}, {y}, [y](Access& access) {
    if (access.domain<Interval>(y).hi() > 1) narrow(access, y, {0, access.domain<Interval>(y).hi() / 2});
  });
  Propagation halving(coarse.graph, options);
  halving.run();
  EXPECT_EQ(halving.domain<Interval>(y), Interval(0, 1));
}

TEST(Propagation, TellsWhoFoundWhatEmpty) {
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 10)),
                   y = log.graph.add_variable("y", Interval(0, 10));
  log.add("harmless", Cost::constant, {x}, {});
  const ContractorId culprit = log.add("empties", Cost::linear, {x}, {y}, [y](Access& access) {
    access.report<Interval>(y, contract(access.edit<Interval>(y), Interval(20, 30)), std::array{1.0, 2.0});
  });
  log.add("never runs", Cost::search, {x}, {});
  Propagation run(log.graph, {});
  EXPECT_EQ(run.run(), Ending::empty);
  ASSERT_TRUE(run.failure().has_value());
  EXPECT_EQ(run.failure()->contractor, culprit);
  EXPECT_EQ(run.failure()->variable, y);
  EXPECT_EQ(run.failure()->time, (std::array{1.0, 2.0}));
  EXPECT_EQ(log.runs, (Names{"harmless", "empties"}));
}

TEST(Propagation, AContractorMayFailWithoutEmptyingADomain) {
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 10));
  log.add("fails", Cost::constant, {x}, {x}, [x](Access& access) {
    access.fail(x);
    access.fail(x, std::array{3.0, 4.0});
  });
  Propagation run(log.graph, {});
  EXPECT_EQ(run.run(), Ending::empty);
  EXPECT_FALSE(run.failure()->time.has_value()) << "the first failure counts";
}

TEST(Propagation, StartsFromTheGraphsDomainsOrFromAReplacement) {
  Log log;
  const VariableId x = log.graph.add_variable("x", Interval(0, 10));
  log.add("halves", Cost::constant, {x}, {x}, [x](Access& access) { narrow(access, x, {2, 20}); });
  Propagation replaced(log.graph, {});
  replaced.set_domain(x, Interval(0, 50));
  EXPECT_EQ(replaced.run(), Ending::fixed_point);
  EXPECT_EQ(replaced.domain<Interval>(x), Interval(2, 20));
  Propagation plain(log.graph, {});
  EXPECT_EQ(plain.run(), Ending::fixed_point);
  EXPECT_EQ(plain.domain<Interval>(x), Interval(2, 10)) << "the graph is not changed by a run";
}

// A random system of x_i <= x_j + c: in every order the same fixed point, the one of a plain loop.
TEST(Propagation, EveryOrderGivesTheSameFixedPoint) {
  oracle::for_seeds(100, [](oracle::Dice& dice) {
    constexpr int kVariables = 6;
    Log log;
    struct Difference {
      VariableId i, j;
      double c;
    };
    std::vector<Interval> plain;
    std::vector<Difference> system;
    for (int v = 0; v < kVariables; ++v) {
      plain.emplace_back(dice.below(10), 20 + dice.below(40));
      log.graph.add_variable("x" + std::to_string(v), plain.back());
    }
    for (int k = 0; k < 10; ++k) {
      const Difference d{static_cast<VariableId>(dice.below(kVariables)),
                         static_cast<VariableId>(dice.below(kVariables)),
                         static_cast<double>(dice.below(12) - 2)};
      system.push_back(d);
      log.add(std::to_string(k), static_cast<Cost>(dice.below(3)), {d.i, d.j}, {d.i, d.j},
              [d](Access& access) {
                narrow(access, d.i, Interval::raw(-kInfinity, access.domain<Interval>(d.j).hi() + d.c));
                narrow(access, d.j, Interval::raw(access.domain<Interval>(d.i).lo() - d.c, kInfinity));
              });
    }
    bool empty = false;
    for (bool changed = true; changed && !empty;) {
      changed = false;
      for (const Difference& d : system) {
        changed |= contract(plain[d.i], Interval::raw(-kInfinity, plain[d.j].hi() + d.c)).changed;
        changed |= contract(plain[d.j], Interval::raw(plain[d.i].lo() - d.c, kInfinity)).changed;
      }
      for (const Interval& x : plain) empty = empty || x.is_empty();
    }
    for (const auto& [order, seed] :
         {std::pair{Order::declared, 0}, {Order::reversed, 0}, {Order::shuffled, 1}, {Order::shuffled, 2}}) {
      PropagationOptions options;
      options.order = order;
      options.seed = static_cast<std::uint64_t>(seed);
      Propagation run(log.graph, options);
      ASSERT_EQ(run.run(), empty ? Ending::empty : Ending::fixed_point);
      for (VariableId v = 0; !empty && v < kVariables; ++v) EXPECT_EQ(run.domain<Interval>(v), plain[v]);
    }
  });
}

}  // namespace
}  // namespace hcsp
