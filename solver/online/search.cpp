// SPDX-License-Identifier: Apache-2.0
#include "solver/online/search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "domains/interval/kernel.h"
#include "solver/online/middle.h"
#include "solver/online/play.h"

namespace hcsp::online {

namespace {

constexpr std::size_t kMostWaiting = 4096;
constexpr double kNarrow = 1e-3;  // relatively: Newton's method does the rest

std::size_t most_tests(const std::vector<CompiledCase>& cases) {
  return most(cases, [](const Code& code) { return code.tests.size(); });
}
std::size_t most_core(const std::vector<CompiledCase>& cases) {
  return most(cases, [](const Code& code) { return code.core(); });
}

// Where to cut: a wide domain by orders of magnitude.
double cut_of(const Interval& x) {
  constexpr double kWide = 16.0, kFar = 1024.0;
  if (x.lo() < 0.0 && x.hi() > 0.0) {
    const bool is_lopsided = -x.lo() > kWide * x.hi() || x.hi() > -kWide * x.lo();
    return is_lopsided || !x.is_bounded() ? 0.0 : middle(x);
  }
  if (x.hi() <= 0.0) return -cut_of(-x);
  if (x.hi() == kInfinity) return std::max(1.0, kFar * x.lo());
  return x.hi() > kWide * x.lo() ? std::max(x.hi() / kWide, std::sqrt(x.lo()) * std::sqrt(x.hi()))
                                 : middle(x);
}

double relative_width(const Interval& x) {
  const double magnitude = std::max(std::abs(x.lo()), std::abs(x.hi()));
  return magnitude < kInfinity ? (x.hi() - x.lo()) / std::max(1.0, magnitude) : kInfinity;
}

}  // namespace

Search::Search(Machine& machine, const std::vector<CompiledCase>& cases, const Givens& givens,
               const std::vector<bool>& is_decisive, bool has_objective, const Limits& limits)
    : machine_(machine),
      contraction_(machine, most_tests(cases), most_core(cases)),
      proof_(machine, most_tests(cases), most_core(cases)),
      cases_(cases),
      givens_(givens),
      is_decisive_(is_decisive),
      has_objective_(has_objective),
      limits_(limits),
      order_(cases.size()),
      refutations_(is_decisive.size()),
      last_(cases.size()),
      left_(cases.size()),
      irregular_(cases.size()),
      none_(cases.size()),
      provable_(cases.size()),
      fronts_(cases.size()),
      domains_(most_core(cases)),
      proof_domains_(most_core(cases)),
      box_(most_core(cases)),
      part_(most_core(cases)),
      waiting_(kMostWaiting, most_core(cases)),
      candidate_(most_core(cases)),
      places_(most_core(cases)) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    last_[i].search.resize(cases[i].search.core());
    last_[i].proof.resize(cases[i].proof.core());
    last_[i].places.resize(cases[i].proof.core());
    sizes_.emplace_back(cases[i].search.core());
  }
}

void Search::forget() {
  for (Last& last : last_) last.is_known = false;
}

const Finding& Search::run() {
  finding_ = {false, 0, Interval::raw(kInfinity, kInfinity), kInfinity, false, 0, false};
  std::fill(refutations_.begin(), refutations_.end(), 0U);
  std::fill(provable_.begin(), provable_.end(), Provable::unknown);
  is_any_provable_ = Provable::unknown;
  boxes_ = 0;
  machine_.evaluate(givens_.always);
  if (is_refuted(givens_.required)) {
    if (!finding_.is_decided) is_out_of_reason();
    return finding_;
  }
  waiting_.clear();
  sift();
  // Of boxes of which nothing is known yet the last that came is the first to be looked at.
  for (std::size_t i = order_.size(); i-- > 0;) {
    if (left_.contains(order_[i])) open(order_[i]);
  }
  // What tells at once that there is no solution takes a while to evaluate, and mostly there is one.
  constexpr std::size_t kPatience = 4;
  try_last();
  explore(kPatience);
  if (!finding_.is_found && is_out_of_reason()) return finding_;
  explore();
  if (!finding_.is_found) {
    finding_.refuted_by = static_cast<std::uint32_t>(
        std::max_element(refutations_.begin(), refutations_.end()) - refutations_.begin());
    return finding_;
  }
  const auto place = std::find(order_.begin(), order_.end(), finding_.best_case);
  std::rotate(order_.begin(), place, place + 1);
  finding_.lower = std::min(finding_.lower, finding_.best.lo());
  return finding_;
}

// What has an objective above this is of no interest.
double Search::cut_off() const { return has_objective_ ? finding_.best.hi() : kInfinity; }

// Whether what is there could be no better than what is known, to the precision.
bool Search::is_good_enough(double lower) const {
  return finding_.is_found && lower >= finding_.best.hi() - limits_.precision;
}

// Lets the domains of a case that is left wait, unless parameters refute it.
void Search::open(std::size_t number) {
  const CompiledCase& of = cases_[number];
  const Code& code = of.search;
  if (is_refuted_by_prelude(number)) return;
  case_ = number;
  if (irregular_.contains(number) || !waiting_.has_room_for(1)) {
    finding_.is_exhausted = true;  // nothing is known of what is defined by a division by 0
    finding_.lower = -kInfinity;
    return;
  }
  if (!find_domains(code, of.search_domains, false, domains_)) return;
  Front& front = fronts_[number];
  front = {};
  for (std::size_t v = 0; v < code.core(); ++v) {
    if (!is_thin(domains_[v])) front.active |= std::uint64_t{1} << v;
  }
  const auto equations =
      std::count_if(code.tests.begin(), code.tests.end(), [](const Test& test) { return test.is_equation; });
  front.is_free = has_objective_ && equations < __builtin_popcountll(front.active);
  waiting_.push({domains_.data(), code.core()}, static_cast<std::uint32_t>(number), -kInfinity);
}

// Domains as declared and as parameters bound them: of all that could be, or of what certainly is.
bool Search::find_domains(const Code& code, std::span<const Interval> declared, bool is_inner,
                          std::span<Interval> domains) {
  std::copy(declared.begin(), declared.end(), domains.begin());
  for (const CoreBound& bound : code.bounds) {
    const Interval& value = machine_.value(bound.reg);
    if (value.is_empty()) return false;
    const double end = bound.is_upper == is_inner ? value.lo() : value.hi();
    Interval& domain = domains[bound.v];
    domain = meet(domain, bound.is_upper ? Interval::raw(-kInfinity, end) : Interval::raw(end, kInfinity));
    if (domain.is_empty()) return false;
  }
  return true;
}

void Search::note_size(std::span<const Interval> box) {
  for (std::size_t v = 0; v < box.size(); ++v)
    sizes_[case_][v] = box[v].is_bounded() ? std::max(std::abs(box[v].lo()), std::abs(box[v].hi())) : 1.0;
}

// Whether to cut a box would tell no more: it is settled, or the objective is known well enough on it, and it
// is a speck, or one of many: along a continuum of solutions that are equally good no cut tells anything.
bool Search::is_leaf(std::span<const Interval> box) {
  constexpr double kSpeck = 1e-6, kKnown = 0.25;
  constexpr std::size_t kMany = 64;  // more than the halvings down to a speck
  const std::uint64_t active = fronts_[case_].active;
  if (contraction_.is_settled() || active == 0) return true;
  if (!has_objective_ || !(contraction_.upper() - contraction_.lower() <= kKnown * limits_.precision))
    return false;
  if (++fronts_[case_].known > kMany) return true;
  for (std::size_t v = 0; v < box.size(); ++v) {
    if (((active >> v) & 1U) != 0 && !(box[v].hi() - box[v].lo() <= kSpeck * sizes_[case_][v])) return false;
  }
  return true;
}

// Proofs that fail time and again are tried less often; at the ends of the search later than on the way.
bool Search::is_worth_trying(bool is_last) {
  constexpr std::size_t kOften = 8, kAtEnds = 64, kSeldom = 4;
  Front& front = fronts_[case_];
  const bool is_promising = front.is_free && !is_good_enough(contraction_.expected());
  if (!(is_last || is_promising || !finding_.is_found)) return false;
  Attempts& attempts = is_last ? front.at_ends : front.on_the_way;
  if (front.boxes < attempts.next) return false;
  const bool is_often = ++attempts.count < (is_last ? kAtEnds : kOften);
  attempts.next = is_often ? 0 : front.boxes + front.boxes / kSeldom;
  return true;
}

// The rest of the digits is worth less: near the end of a motion they may be out of reach.
bool Search::has_looked_enough() const {
  constexpr std::size_t kFifth = 5;
  if (boxes_ >= limits_.boxes) return true;
  if (!finding_.is_found || boxes_ < limits_.boxes / kFifth) return false;
  const double lower = std::min(finding_.lower, waiting_.lower());
  return limits_.is_known_well(Interval::raw(std::min(lower, finding_.best.hi()), finding_.best.hi()));
}

// Until all are looked at that have to be, or so many.
void Search::explore(std::size_t boxes) {
  while (boxes_ < boxes && !waiting_.empty() && !(finding_.is_found && !has_objective_)) {
    if (has_looked_enough()) {
      finding_.is_exhausted = true;
      finding_.lower = std::min(finding_.lower, has_objective_ ? waiting_.lower() : 0.0);
      return;
    }
    ++boxes_;
    case_ = waiting_.owner();
    const std::span<Interval> box{box_.data(), cases_[case_].search.core()};
    waiting_.pop(box);
    look_at(box);
  }
}

// A box of the case at hand.
void Search::look_at(std::span<Interval> box) {
  const CompiledCase& of = cases_[case_];
  Front& front = fronts_[case_];
  const bool is_near = finding_.is_found && finding_.best_case == case_;
  const std::span<const double> near =
      is_near ? std::span<const double>(last_[case_].search) : std::span<const double>{};
  const auto refuted = [&] {
    if (contraction_.refuted_by() != Contraction::kBound) ++refutations_[contraction_.refuted_by()];
  };
  if (!contraction_.contract(of.search, box, front.active, cut_off(), near)) return refuted();
  if (front.boxes++ == 0) note_size(box);
  const bool is_last = is_leaf(box);
  if (is_last && !contraction_.is_tested_whole() && !contraction_.test_whole()) return refuted();
  const double lower = has_objective_ ? contraction_.lower() : 0.0;
  if (!is_good_enough(lower) && is_worth_trying(is_last)) {
    if (try_box(of, box, is_last)) front.at_ends = front.on_the_way = {};
  }
  if (is_last || is_good_enough(lower)) {
    if (lower <= cut_off()) finding_.lower = std::min(finding_.lower, lower);
    return;
  }
  split(of.search, box, lower);
}

// The active unknowns of that equation which has the fewest of those that are not narrow: equations that
// others wait for come first, as in a triangular system. What holds in the middle may be an identity, and
// does not count. Before all that what has no bounds, of which no slopes are known.
std::uint64_t Search::first_to_cut(const Code& code, std::span<const Interval> box) {
  std::uint64_t wide = 0, endless = 0;
  for (std::size_t v = 0; v < box.size(); ++v) {
    const double x = middle(box[v]), width = relative_width(box[v]);
    part_[v] = Interval::raw(x, x);
    if (width > kNarrow) wide |= std::uint64_t{1} << v;
    if (width == kInfinity) endless |= std::uint64_t{1} << v;
  }
  const std::uint64_t active = fronts_[case_].active;
  wide &= active;
  if ((endless & active) != 0) return endless & active;
  if (__builtin_popcountll(wide) < 2) return wide == 0 ? active : wide;
  machine_.evaluate(code, {part_.data(), box.size()}, Code::main);
  std::uint64_t fewest = wide;
  for (std::size_t i = 0; i < code.ends[Code::main].tests; ++i) {
    const Test& test = code.tests[i];
    if (!test.is_equation || test.is_truth || test.reg < code.first()) continue;
    const Interval& value = machine_.value(test.reg);
    const std::uint64_t own = code.depends[test.reg - code.first()] & wide;
    const bool is_violated = !value.is_empty() && !value.contains(0.0);
    const bool is_smaller = own != 0 && __builtin_popcountll(own) < __builtin_popcountll(fewest);
    if (is_violated && is_smaller) fewest = own;
  }
  return fewest;
}

// Cuts the widest side, relative to how large it is.
void Search::split(const Code& code, std::span<const Interval> box, double lower) {
  std::size_t widest = code.core();
  const std::uint64_t among = first_to_cut(code, box);
  for (std::size_t v = 0; v < code.core(); ++v) {
    if (((among >> v) & 1U) == 0) continue;
    if (widest == code.core() || relative_width(box[v]) > relative_width(box[widest])) widest = v;
  }
  const double cut = cut_of(box[widest]);
  if (!waiting_.has_room_for(2) || !(box[widest].lo() < cut && cut < box[widest].hi())) {
    finding_.lower = std::min(finding_.lower, lower);
    return;
  }
  std::copy(box.begin(), box.end(), part_.begin());
  const std::span<Interval> part{part_.data(), box.size()};
  part[widest] = Interval::raw(cut, box[widest].hi());
  waiting_.push(part, static_cast<std::uint32_t>(case_), lower);
  part[widest] = Interval::raw(box[widest].lo(), cut);
  waiting_.push(part, static_cast<std::uint32_t>(case_), lower);
}

}  // namespace hcsp::online
