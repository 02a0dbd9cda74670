// SPDX-License-Identifier: Apache-2.0
// Propagation: wakes contractors by Delta, cheap before dear, until nothing changes: the fixed point. The
// contractors are inclusion-isotone, so it is the same for every order. A limit ends a run early; what was
// computed is still guaranteed.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "solver/engine/agenda.h"
#include "solver/engine/graph.h"

namespace hcsp {

/// The one clock that limits and statistics read; seconds from any origin.
using Clock = std::function<double()>;
Clock steady_clock();

/// In which order awake contractors of one cost run. The fixed point does not depend on it.
enum class Order : std::uint8_t { declared, reversed, shuffled };

struct PropagationOptions {
  unsigned threads = 1;       ///< accepted; propagation runs on the calling thread
  double time_limit = 0.0;    ///< seconds; 0 is none
  double spent_before = 0.0;  ///< seconds that preparing the data took, for Statistics::seconds
  double threshold = 0.0;  ///< a pass that lowers no variable's measure by more than this share ends the run
  Order order = Order::declared;
  std::uint64_t seed = 0;                     ///< of Order::shuffled
  bool keep_snapshots = false;                ///< Result::snapshots
  bool keep_trace = false;                    ///< Result::trace
  bool explain = true;                        ///< look for a small support when infeasible
  const std::atomic<bool>* cancel = nullptr;  ///< set it (Ctrl-C) to stop the run
  Clock clock = steady_clock();
  std::function<void(std::uint64_t pass, double seconds)> progress = {};  ///< after every pass
};

/// Which contractor found which variable empty, and over which span of time, where the variable has one.
struct Failure {
  std::optional<ContractorId> contractor;  ///< none when the variable was empty from the start
  VariableId variable;
  std::optional<std::array<double, 2>> time;
};

enum class Ending : std::uint8_t { fixed_point, empty, limit };

class Propagation;

/// What a contractor sees of a run: domains, what changed in them, and where to report its own changes.
class Access {
 public:
  template <Lattice D>
  [[nodiscard]] const D& domain(VariableId id) const;
  /// What changed in a variable since this contractor last ran. Only for a variable that it reads.
  template <Lattice D>
  [[nodiscard]] const typename D::Delta& delta(VariableId id) const;
  /// The domain, to be contracted in place; every change is to be reported.
  template <Lattice D>
  [[nodiscard]] D& edit(VariableId id);
  /// Reports a change of a variable: wakes its readers, and ends the run where the domain is empty. `time`
  /// says when, for a variable that has a time.
  template <Lattice D>
  void report(VariableId id, const typename D::Delta& change, std::optional<std::array<double, 2>> time = {});
  /// A domain, whatever its lattice.
  [[nodiscard]] const Slot& slot(VariableId id) const;
  /// Whether anything changed in a variable since this contractor last ran. Only for one that it reads.
  [[nodiscard]] bool changed(VariableId id) const;
  /// Meets a domain with another of its lattice, and reports that.
  void narrow(VariableId id, const Slot& bound);
  /// Tells that another run right away would change nothing: the contractor's own changes then do not wake
  /// it.
  void settled();
  /// The constraint has no solution within the domains; `variable` is the one to blame.
  void fail(VariableId variable, std::optional<std::array<double, 2>> time = {});
  /// True when a limit was reached: a long contraction may return early, for the run is going to end.
  [[nodiscard]] bool should_stop() const;
  /// The limits that are left, for a propagation within this one.
  [[nodiscard]] PropagationOptions limits() const;

 private:
  friend class Propagation;
  Access(Propagation& run, ContractorId contractor) : run_(run), contractor_(contractor) {}
  Propagation& run_;
  ContractorId contractor_;
  bool settled_ = false;
  /// Of this contractor among the readers of a variable that it reads.
  [[nodiscard]] std::size_t place_in(VariableId id) const;
  std::vector<std::pair<VariableId, std::size_t>> places_;  // by variable
};

class Propagation {
 public:
  struct ContractorCount {
    std::uint64_t calls = 0;
    double seconds = 0.0;
  };
  /// Watches a run, for pictures and traces.
  class Observer {
   public:
    virtual ~Observer() = default;
    virtual void before_contractor(const Propagation&, ContractorId) {}
    virtual void after_contractor(const Propagation&, ContractorId) {}
    virtual void after_pass(const Propagation&) {}
  };

  /// Starts from the graph's initial domains. The graph must outlive the propagation.
  Propagation(const ContractorGraph& graph, PropagationOptions options);

  /// Replaces a domain before the run.
  template <Lattice D>
  void set_domain(VariableId id, D domain) {
    slot<D>(id).domain = std::move(domain);
  }

  /// The same, whatever the lattice.
  void set_domain(VariableId id, const Slot& domain) { slots_[id] = domain.clone(); }

  Ending run(Observer* observer = nullptr);

  template <Lattice D>
  [[nodiscard]] const D& domain(VariableId id) const {
    return static_cast<const TypedSlot<D>&>(*slots_[id]).domain;
  }
  [[nodiscard]] const Slot& slot(VariableId id) const { return *slots_[id]; }
  [[nodiscard]] const ContractorGraph& graph() const { return graph_; }
  [[nodiscard]] std::uint64_t passes() const { return pass_; }
  [[nodiscard]] const std::vector<ContractorCount>& counts() const { return counts_; }
  [[nodiscard]] const std::optional<Failure>& failure() const { return failure_; }
  [[nodiscard]] double elapsed() const { return options_.clock() - started_; }

 private:
  friend class Access;

  template <Lattice D>
  TypedSlot<D>& slot(VariableId id) {
    return dynamic_cast<TypedSlot<D>&>(*slots_[id]);
  }
  void run_contractor(ContractorId id, Observer* observer);
  [[nodiscard]] bool end_pass(Observer* observer);
  [[nodiscard]] bool out_of_limits() const;

  const ContractorGraph& graph_;
  PropagationOptions options_;
  double started_;
  std::vector<std::unique_ptr<Slot>> slots_;
  std::vector<Access> access_;          // by contractor
  std::vector<ContractorId> schedule_;  // all contractors, in the order in which awake ones run
  std::vector<std::size_t> turn_;       // by contractor: its place in the schedule
  Agenda agenda_;
  std::vector<bool> ran_this_pass_;  // of the contractors that passes are counted by
  Cost counted_ = Cost::constant;    // their least cost: those of a few operations do not make a pass
  std::vector<double> open_;  // the variables' measures at the last pass's end, when there is a threshold
  std::vector<ContractorCount> counts_;
  std::optional<Failure> failure_;
  std::uint64_t pass_ = 0;
};

template <Lattice D>
const D& Access::domain(VariableId id) const {
  return run_.domain<D>(id);
}

template <Lattice D>
const typename D::Delta& Access::delta(VariableId id) const {
  return static_cast<const TypedSlot<D>&>(*run_.slots_[id]).pending[place_in(id)];
}

template <Lattice D>
D& Access::edit(VariableId id) {
  return run_.slot<D>(id).domain;
}

template <Lattice D>
void Access::report(VariableId id, const typename D::Delta& change,
                    std::optional<std::array<double, 2>> time) {
  TypedSlot<D>& slot = run_.slot<D>(id);
  if (slot.domain.is_empty()) return fail(id, time);
  if (change.is_none()) return;
  const std::vector<ContractorId>& readers = run_.graph_.variable(id).readers();
  for (std::size_t place = 0; place < readers.size(); ++place) {
    run_.agenda_.wake(run_.turn_[readers[place]]);
    slot.incoming[place].join(change);
  }
}

}  // namespace hcsp
