// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/set_algebra.h"

#include <algorithm>
#include <array>
#include <vector>

#include "domains/set_interval.h"
#include "solver/engine/propagation.h"

namespace hcsp {

namespace {

Planes within(Planes target, Planes source) { return {target.lower, target.upper & source.upper}; }
Planes holding(Planes target, Planes source) { return {target.lower | source.lower, target.upper}; }

std::vector<VariableId> variables_of(const std::vector<SetTerm>& terms) {
  std::vector<VariableId> distinct;
  for (const SetTerm& term : terms) {
    if (std::find(distinct.begin(), distinct.end(), term.set) == distinct.end()) distinct.push_back(term.set);
  }
  return distinct;
}

class SetContractor : public Contractor {
 public:
  SetContractor(std::string name, std::string constraint, const std::vector<SetTerm>& terms)
      : Contractor(std::move(name), std::move(constraint), Cost::linear, variables_of(terms),
                   variables_of(terms)) {}

 protected:
  static SetInterval value(Access& access, const SetTerm& term) {
    const auto& set = access.domain<SetInterval>(term.set);
    return term.complemented ? set_complement(set) : set;
  }
  // Each false when nothing is left of the target.
  static bool put_within(Access& access, const SetTerm& target, const SetInterval& bound) {
    return target.complemented ? apply(access, target.set, set_complement(bound), holding)
                               : apply(access, target.set, bound, within);
  }
  static bool make_hold(Access& access, const SetTerm& target, const SetInterval& part) {
    return target.complemented ? apply(access, target.set, set_complement(part), within)
                               : apply(access, target.set, part, holding);
  }

 private:
  static bool apply(Access& access, VariableId target, const SetInterval& source,
                    SetInterval::WordOperation op) {
    auto& set = access.edit<SetInterval>(target);
    access.report<SetInterval>(target, combine(set, source, op, SetInterval::everywhere()));
    return !set.is_empty();
  }
};

class SubsetContractor final : public SetContractor {
 public:
  SubsetContractor(std::string name, std::string constraint, SetTerm a, SetTerm b)
      : SetContractor(std::move(name), std::move(constraint), {a, b}), a_(a), b_(b) {}

  void contract(Access& access) override {
    if (put_within(access, a_, value(access, b_))) make_hold(access, b_, value(access, a_));
    access.settled();  // B+ and A- alone decide, and they did not change
  }

 private:
  SetTerm a_, b_;
};

class IntersectionContractor final : public SetContractor {
 public:
  IntersectionContractor(std::string name, std::string constraint, SetTerm whole, SetTerm a, SetTerm b)
      : SetContractor(std::move(name), std::move(constraint), {whole, a, b}), whole_(whole), a_(a), b_(b) {}

  void contract(Access& access) override {
    const SetInterval common = set_intersection(value(access, a_), value(access, b_));
    if (put_within(access, whole_, common) && make_hold(access, whole_, common) && narrow(access, a_, b_))
      narrow(access, b_, a_);
  }

 private:
  // The whole is part of each, and what is in the other alone is not in this one.
  bool narrow(Access& access, const SetTerm& one, const SetTerm& other) {
    const SetInterval whole = value(access, whole_);
    return make_hold(access, one, whole) &&
           put_within(access, one, set_union(whole, set_complement(value(access, other))));
  }
  SetTerm whole_, a_, b_;
};

class SymmetricDifferenceContractor final : public SetContractor {
 public:
  SymmetricDifferenceContractor(std::string name, std::string constraint, SetTerm whole, SetTerm a, SetTerm b)
      : SetContractor(std::move(name), std::move(constraint), {whole, a, b}), terms_{whole, a, b} {}

  // Each of the three is the symmetric difference of the others.
  void contract(Access& access) override {
    for (std::size_t i = 0; i < 3; ++i) {
      const SetInterval made =
          set_symmetric_difference(value(access, terms_[(i + 1) % 3]), value(access, terms_[(i + 2) % 3]));
      if (!put_within(access, terms_[i], made) || !make_hold(access, terms_[i], made)) return;
    }
  }

 private:
  std::array<SetTerm, 3> terms_;
};

class CommonPointContractor final : public SetContractor {
 public:
  CommonPointContractor(std::string name, std::string constraint, SetTerm a, SetTerm b)
      : SetContractor(std::move(name), std::move(constraint), {a, b}), a_(a), b_(b) {}

  // A cell that both have to share need not lie in either as a whole: nothing can be included.
  void contract(Access& access) override {
    const SetInterval common = set_intersection(value(access, a_), value(access, b_));
    const bool is_possible = common.background() != CellState::outside || common.root().any_upper;
    if (!is_possible) access.fail(a_.set);
    access.settled();
  }

 private:
  SetTerm a_, b_;
};

}  // namespace

std::unique_ptr<Contractor> make_subset_contractor(std::string name, std::string constraint, SetTerm a,
                                                   SetTerm b) {
  return std::make_unique<SubsetContractor>(std::move(name), std::move(constraint), a, b);
}

std::unique_ptr<Contractor> make_intersection_contractor(std::string name, std::string constraint,
                                                         SetTerm whole, SetTerm a, SetTerm b) {
  return std::make_unique<IntersectionContractor>(std::move(name), std::move(constraint), whole, a, b);
}

std::unique_ptr<Contractor> make_symmetric_difference_contractor(std::string name, std::string constraint,
                                                                 SetTerm whole, SetTerm a, SetTerm b) {
  return std::make_unique<SymmetricDifferenceContractor>(std::move(name), std::move(constraint), whole, a, b);
}

std::unique_ptr<Contractor> make_common_point_contractor(std::string name, std::string constraint, SetTerm a,
                                                         SetTerm b) {
  return std::make_unique<CommonPointContractor>(std::move(name), std::move(constraint), a, b);
}

}  // namespace hcsp
