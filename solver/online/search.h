// SPDX-License-Identifier: Apache-2.0
// Branch and bound over the cases of a compiled problem, each in terms of its core, on room that is allocated
// once: first the case of the last solution, from where that was; then all the others.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/online/contraction.h"
#include "solver/online/givens.h"
#include "solver/online/proof.h"
#include "solver/online/waiting_boxes.h"

namespace hcsp::online {

/// Where the value of an unknown is read: in a register, or it is what is known anyway.
struct Source {
  bool is_register;
  Register reg;
  Interval value;
};

/// A case as code, and where its solutions are read.
struct CompiledCase {
  Code search, proof;
  std::vector<Interval> search_domains, proof_domains;  ///< declared, by unknown of each core
  std::vector<Source> candidate;  ///< by unknown of the proof's core: what gives it in the search
  std::vector<Source> found;      ///< by unknown of the search's core: what gives it in the proof
};

/// The greatest size of some kind among the codes of all cases.
template <class SizeOf>
std::size_t most(const std::vector<CompiledCase>& cases, SizeOf size_of) {
  std::size_t result = 0;
  for (const CompiledCase& one : cases)
    result = std::max<std::size_t>({result, size_of(one.search), size_of(one.proof)});
  return result;
}

struct Limits {
  std::size_t boxes;  ///< that one solve looks at; a fifth of them where the objective is known well
  double precision;   ///< what cannot better the objective by more than this is left

  /// Whether an objective is known to half of the digits that are asked for.
  [[nodiscard]] bool is_known_well(const Interval& objective) const {
    return objective.width() <= std::sqrt(precision) * std::max(1.0, std::abs(objective.hi()));
  }
};

/// What is known of a problem after a solve.
struct Finding {
  bool is_found;             ///< a solution is proven
  std::size_t best_case;     ///< that it belongs to
  Interval best;             ///< the objective's value there
  double lower;              ///< of the objective of all solutions; +oo where there are none
  bool is_exhausted;         ///< the limit of boxes was met, or a case could not be looked at
  std::uint32_t refuted_by;  ///< a relation that refuted most
  bool is_decided;           ///< it refuted all cases, and is decisive
};

class Search {
 public:
  /// `is_decisive` by name: whether no solution is left where that is refuted, of the family or not.
  Search(Machine& machine, const std::vector<CompiledCase>& cases, const Givens& givens,
         const std::vector<bool>& is_decisive, bool has_objective, const Limits& limits);

  /// What was found, if anything: the machine keeps it, the registers of the proof of that case.
  /// PRECONDITION: the parameters are in the machine, and the thread rounds upward.
  const Finding& run();
  /// Of the last run.
  [[nodiscard]] const Finding& finding() const { return finding_; }
  [[nodiscard]] const Limits& limits() const { return limits_; }
  [[nodiscard]] std::size_t boxes() const { return boxes_; }
  /// Forgets where the last solutions were.
  void forget();

 private:
  void open(std::size_t number);
  void explore(std::size_t boxes = ~std::size_t{0});
  void look_at(std::span<Interval> box);
  bool is_refuted(std::span<const Test> tests);
  void sift();
  bool is_refuted_by_prelude(std::size_t number);
  bool is_out_of_reason();
  bool is_provable(const CompiledCase& of);
  bool find_domains(const Code& code, std::span<const Interval> declared, bool is_inner,
                    std::span<Interval> domains);
  void try_last();
  bool try_box(const CompiledCase& of, std::span<const Interval> box, bool is_leaf);
  bool try_part(const CompiledCase& of, Proof::By by, std::span<const double> last = {});
  void keep(const CompiledCase& of);
  std::uint64_t first_to_cut(const Code& code, std::span<const Interval> box);
  void split(const Code& code, std::span<const Interval> box, double lower);
  void note_size(std::span<const Interval> box);
  [[nodiscard]] bool is_worth_trying(bool is_last);
  [[nodiscard]] bool is_leaf(std::span<const Interval> box);
  [[nodiscard]] double cut_off() const;
  [[nodiscard]] bool is_good_enough(double lower) const;
  [[nodiscard]] bool has_looked_enough() const;

  Machine& machine_;
  Contraction contraction_;
  Proof proof_;
  const std::vector<CompiledCase>& cases_;
  const Givens& givens_;
  const std::vector<bool>& is_decisive_;
  bool has_objective_;
  Limits limits_;
  Finding finding_{};
  std::size_t case_ = 0, boxes_ = 0;
  std::vector<std::size_t> order_;          // of the cases
  std::vector<std::uint32_t> refutations_;  // by name
  struct Last {
    bool is_known = false;
    std::vector<double> search, proof;  // a point of its core
    std::vector<double> places;         // of data within their play, by unknown of the proof's core
  };
  std::vector<Last> last_;           // by case
  CaseSet left_, irregular_, none_;  // irregular: with a divisor that may be 0
  enum class Provable : std::uint8_t { unknown, no, yes };
  Provable is_any_provable_ = Provable::unknown;
  std::vector<Provable> provable_;  // by case
  struct Attempts {
    std::size_t count = 0, next = 0;  // of failed ones; how many boxes to wait for
  };
  struct Front {
    std::uint64_t active = 0;  // the unknowns of the core that are no data
    bool is_free = false;      // equations leave some of them free: solutions are not only where boxes end
    std::size_t boxes = 0, known = 0;  // known: those on which the objective is known well enough
    Attempts at_ends, on_the_way;
  };
  std::vector<Front> fronts_;  // by case
  std::vector<Interval> domains_, proof_domains_, box_, part_;
  WaitingBoxes waiting_;
  std::vector<double> candidate_, places_;
  std::vector<std::vector<double>> sizes_;  // by case, by unknown of the core: of the first box
};

}  // namespace hcsp::online
