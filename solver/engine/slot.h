// SPDX-License-Identifier: Apache-2.0
// A variable's domain during a run, whatever its lattice: the value, and for each contractor that reads it
// the Delta since that contractor last looked. The engine handles slots through their base and so knows no
// concrete domain.
#pragma once

#include <memory>
#include <vector>

#include "domains/lattice.h"

namespace hcsp {

class Slot {
 public:
  virtual ~Slot() = default;
  [[nodiscard]] virtual std::unique_ptr<Slot> clone() const = 0;
  [[nodiscard]] virtual bool is_empty() const = 0;
  /// How much the domain leaves open; 0 where its lattice has no measure.
  [[nodiscard]] virtual double open() const = 0;
  /// Gives every reader the Delta "everything".
  virtual void wake_all(std::size_t readers) = 0;
  /// The meet, or the join, with a domain of the same lattice and shape.
  virtual void meet_with(const Slot& other) = 0;
  virtual void join_with(const Slot& other) = 0;
  /// meet_with(), with the Delta of the change handed to every reader; whether there was any.
  virtual bool narrow(const Slot& bound) = 0;
  /// A reader is about to run: what came in since its last run is what it is shown.
  virtual void hand_over(std::size_t reader) = 0;
  /// Forgets what came in for a reader.
  virtual void drop(std::size_t reader) = 0;
  /// Whether the run at hand of a reader is shown any change.
  [[nodiscard]] virtual bool changed(std::size_t reader) const = 0;
};

template <Lattice D>
class TypedSlot : public Slot {
 public:
  explicit TypedSlot(D initial) : domain(std::move(initial)) {}

  [[nodiscard]] std::unique_ptr<Slot> clone() const override { return std::make_unique<TypedSlot>(domain); }
  [[nodiscard]] bool is_empty() const override { return domain.is_empty(); }
  [[nodiscard]] double open() const override {
    if constexpr (requires { measure(domain); }) return measure(domain);
    return 0.0;
  }
  void wake_all(std::size_t readers) override {
    incoming.assign(readers, everything(domain));
    pending.assign(readers, {});
  }
  void meet_with(const Slot& other) override { domain = meet(domain, of(other)); }
  void join_with(const Slot& other) override { domain = join(domain, of(other)); }
  bool narrow(const Slot& bound) override {
    const typename D::Delta change = contract(domain, of(bound));
    if (change.is_none()) return false;
    for (auto& delta : incoming) delta.join(change);
    return true;
  }
  void hand_over(std::size_t reader) override {
    pending[reader] = std::move(incoming[reader]);
    incoming[reader] = {};
  }
  void drop(std::size_t reader) override { incoming[reader] = {}; }
  [[nodiscard]] bool changed(std::size_t reader) const override { return !pending[reader].is_none(); }

  D domain;
  // By reader: the changes since its last run, and those that the run at hand is shown. Two, because a
  // contractor may change a variable that it also reads.
  std::vector<typename D::Delta> incoming, pending;

 private:
  static const D& of(const Slot& slot) { return dynamic_cast<const TypedSlot&>(slot).domain; }
};

}  // namespace hcsp
