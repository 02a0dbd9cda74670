// SPDX-License-Identifier: Apache-2.0
// That a view's constraints have an exact solution near a point. Equations, and inequalities that are
// violated or undecided there, are solved for as many unknowns by Newton's method in floating point; that the
// solution exists is Krawczyk's test (Krawczyk 1969; Neumaier 1990, chapter 5), the other unknowns being
// fixed, and all other constraints hold on all of the box around it.
#pragma once

#include "solver/online/machine.h"
#include "solver/online/pivoting.h"

namespace hcsp::online {

class Proof {
 public:
  Proof(Machine& machine, std::size_t most_tests, std::size_t most_core);

  /// What is solved for: unknowns, and data where these do not do; or data alone, the unknowns being as they
  /// are. The latter where equations are singular in the unknowns: many solutions, one of them near enough.
  enum class By : std::uint8_t { unknowns, data };
  /// Looks for one near `near`, with every unknown of the core in `domains`. Then the machine is
  /// evaluated on a box that holds it. PRECONDITION: the thread rounds upward.
  bool find(const Code& code, std::span<const double> near, std::span<const Interval> domains, By by);

 private:
  void keep_within_domains();
  [[nodiscard]] double room(std::size_t v) const;
  void collect_rows();
  bool fill_matrix(std::uint64_t active);
  void keep_matrix();
  struct Step {
    double now, of_late;
  };
  bool find_step(bool is_chord);
  Step take_step();
  bool correct();
  bool is_closer();
  double change_of(std::size_t k);
  bool holds_at_point();
  bool solve_exactly();
  bool precondition();
  bool expand();
  void join_slopes(std::uint64_t active);
  bool take_middle();
  bool contract_to_solution();
  bool all_hold();
  bool activate_open();
  [[nodiscard]] double excess(std::size_t k) const;

  static constexpr int kAttempts = 4;
  static constexpr double kMore = 8.0;  // room in the next attempt
  static constexpr std::size_t kMostSurfaces = 4;

  Machine& machine_;
  const Code* code_ = nullptr;
  std::span<const Interval> domains_;
  std::size_t size_ = 0;
  Code::Stage stage_ = Code::all;  // that has all rows
  std::uint64_t all_ = 0, free_ = 0,
                active_ = 0;             // unknowns: all, those that are no data, those of the matrix
  std::vector<std::uint32_t> unknowns_;  // by column of the matrix
  bool is_kinked_ = false;               // kinks are within reach
  bool is_exact_ = false;                // in floating point all rows are 0
  std::vector<double> point_;
  std::vector<double> changes_, greatest_;  // by unknown: what a step made of it last; how great it was
  std::vector<double> rooms_;               // by unknown: that the matrix is scaled by
  std::vector<std::uint8_t> is_active_, is_solved_;  // by test
  std::vector<std::uint32_t> rows_;                  // tests that are to be 0, or a little less
  std::vector<std::uint32_t> open_;                  // tests that do not hold, or may not
  std::vector<double> aims_;                         // by test: what it is to be
  std::vector<double> least_;                        // by row: how near to 0 it was
  std::size_t row_count_ = 0, open_count_ = 0;
  Pivoting pivoting_;
  std::size_t rank_ = 0;
  std::vector<std::uint32_t> solved_rows_, columns_;  // the first rank_
  std::vector<double> jacobian_, inverse_, radius_;
  std::vector<Interval> box_, reach_, slopes_, residual_, step_, image_;
};

}  // namespace hcsp::online
