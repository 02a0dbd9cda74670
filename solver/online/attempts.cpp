// SPDX-License-Identifier: Apache-2.0
// Where a search looks for solutions: in the middle of a box, at its zeros, and where the last one was.
#include <algorithm>

#include "solver/online/middle.h"
#include "solver/online/play.h"
#include "solver/online/search.h"

namespace hcsp::online {

namespace {

constexpr double kMiddle = 0.5;

// Of data within their play: from 0 to 1.
double place_in(const Interval& domain, double x) {
  const double width = domain.hi() - domain.lo();
  return width > 0.0 ? std::min(std::max((x - domain.lo()) / width, 0.0), 1.0) : kMiddle;
}

}  // namespace

// Whether all that is given of a proof is certain; then its prelude is evaluated.
bool Search::is_provable(const CompiledCase& of) {
  const auto all_hold = [&](std::span<const Test> tests) {
    return std::all_of(tests.begin(), tests.end(), [&](const Test& test) { return machine_.holds(test); });
  };
  if (is_any_provable_ == Provable::unknown) {
    machine_.evaluate(givens_.proof);
    is_any_provable_ = all_hold(givens_.certain) ? Provable::yes : Provable::no;
  }
  if (is_any_provable_ == Provable::no) return false;
  if (provable_[case_] == Provable::unknown) {
    bool all = true;
    for (const Code::Part& part : of.proof.prelude) {
      machine_.evaluate(part.code);
      all = all && all_hold(part.conditions);
    }
    machine_.load_real(of.proof);
    const bool is_regular =
        std::none_of(of.proof.nonzero.begin(), of.proof.nonzero.end(),
                     [&](Register factor) { return machine_.value(factor).contains(0.0); });
    provable_[case_] = is_regular && all ? Provable::yes : Provable::no;
  }
  return provable_[case_] == Provable::yes;
}

// What the first case had found, as far as that is in its box: what follows from it and from the parameters
// is then near the solution, too. Where data had to be moved within their play they have to be now.
void Search::try_last() {
  if (waiting_.empty() || !last_[waiting_.owner()].is_known) return;
  case_ = waiting_.owner();
  const CompiledCase& of = cases_[case_];
  const Last& last = last_[case_];
  const std::span<const Interval> box = waiting_.box();
  for (std::size_t v = 0; v < of.search.core(); ++v) {
    const double x = std::min(std::max(last.search[v], box[v].lo()), box[v].hi());
    part_[v] = Interval::raw(x, x);
  }
  std::copy(last.places.begin(), last.places.end(), places_.begin());
  try_part(of, Proof::By::unknowns, last.proof);
}

// The middle of a box, and 0 where that is at an end: where all rests, equations are often singular, and hold
// exactly. Where kinks or inequalities meet exactly, data that are a little aside may be clear of them.
bool Search::try_box(const CompiledCase& of, std::span<const Interval> box, bool is_leaf) {
  const auto try_at = [&](double place, Proof::By by) {
    std::fill_n(places_.begin(), of.proof.core(), place);
    return try_part(of, by);
  };
  bool has_zero = false;
  for (std::size_t v = 0; v < box.size(); ++v) {
    const double x = middle(box[v]);
    part_[v] = Interval::raw(x, x);
    has_zero = has_zero || (x != 0.0 && (box[v].lo() == 0.0 || box[v].hi() == 0.0));
  }
  if (try_at(kMiddle, Proof::By::unknowns)) return true;
  for (const double place : {0.25, 0.75}) {
    if (is_leaf && try_at(place, Proof::By::unknowns)) return true;
  }
  if (is_leaf && try_at(kMiddle, Proof::By::data)) return true;
  if (!has_zero) return false;
  for (std::size_t v = 0; v < box.size(); ++v) {
    if (box[v].lo() == 0.0 || box[v].hi() == 0.0) part_[v] = Interval::raw(0.0, 0.0);
  }
  return try_at(kMiddle, Proof::By::unknowns);
}

// A point of the search's core in terms of the proof's, and a proof from there. What the former leaves open
// is taken to be as in `last`.
bool Search::try_part(const CompiledCase& of, Proof::By by, std::span<const double> last) {
  machine_.evaluate(of.search, {part_.data(), of.search.core()});
  machine_.evaluate_rest(of.search);
  for (std::size_t v = 0; v < of.candidate.size(); ++v) {
    const Source& source = of.candidate[v];
    const Interval& x = source.is_register ? machine_.value(source.reg) : source.value;
    if (x.is_empty()) return false;
    candidate_[v] = !last.empty() && x.contains(last[v]) ? last[v] : middle(x);
  }
  if (!is_provable(of)) return false;
  const std::size_t core = of.proof.core();
  if (!find_domains(of.proof, of.proof_domains, true, proof_domains_)) return false;
  for (std::size_t v = 0; v < core; ++v) {
    const Interval& x = proof_domains_[v];
    if (is_thin(x)) candidate_[v] = x.lo() + places_[v] * (x.hi() - x.lo());
  }
  if (!proof_.find(of.proof, {candidate_.data(), core}, {proof_domains_.data(), core}, by)) return false;
  const Interval value = has_objective_ ? machine_.value(of.proof.wanted[0]) : Interval::raw(0.0, 0.0);
  if (has_objective_ && !machine_.is_defined(of.proof.wanted[0])) return false;
  if (finding_.is_found && !(value.hi() < finding_.best.hi())) return true;
  finding_.is_found = true;
  finding_.best = value;
  finding_.best_case = case_;
  keep(of);
  return true;
}

// The solution that the machine is evaluated at.
void Search::keep(const CompiledCase& of) {
  Last& last = last_[case_];
  machine_.evaluate_rest(of.proof);
  machine_.keep(of.proof);
  for (std::size_t v = 0; v < of.found.size(); ++v) {
    const Source& source = of.found[v];
    last.search[v] = middle(source.is_register ? machine_.value(source.reg) : source.value);
  }
  for (std::size_t v = 0; v < of.proof.core(); ++v) {
    last.proof[v] = middle(machine_.value(of.proof.first() + static_cast<Register>(v)));
    last.places[v] = place_in(proof_domains_[v], last.proof[v]);
  }
  last.is_known = true;
}

}  // namespace hcsp::online
