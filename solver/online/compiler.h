// SPDX-License-Identifier: Apache-2.0
// From the relations of a problem to code: cases, each seen twice, for search and for proof.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "domains/polynomial_tube.h"
#include "solver/online/followers.h"
#include "solver/online/search.h"
#include "solver/problem.h"

namespace hcsp::online {

struct Named {
  std::size_t first, size;
};

/// A tube on phases, and where what tells all of it begins among what is wanted.
struct WantedTube {
  std::string name;
  PolynomialTube tube;
  std::size_t first;
  bool is_asked_for = false;
};

/// What is asked of a problem: all that compilation needs to know of it.
struct Question {
  const Dag* dag;
  std::vector<Statement> statements;
  std::vector<NodeId> wanted;  ///< the objective, if there is one, and further expressions
  bool has_objective;
  Unknowns unknowns;
  std::vector<std::string> names;          ///< of statements, then of unknowns' domains
  std::set<std::uint32_t> family;          ///< names of statements that solutions outside the family break
  std::map<Input, std::uint32_t> name_of;  ///< of an unknown's domain
  std::vector<Input> parameters;           ///< in the order of declaration
  std::map<VariableId, NodeId> followed;   ///< by parameter: what its value is unless it is set
  std::vector<Interval> parameter_values;
  std::vector<std::string> parameter_names;  ///< of each; of the vector that it belongs to
  std::map<std::string, Named> parameter_places, variable_places;
  std::size_t variables;  ///< of the problem
  std::vector<WantedTube> tubes;
};
/// std::invalid_argument unless the problem is a system, and the objective a number.
Question question_of(Problem& problem, const std::optional<Expr>& objective,
                     const std::vector<Expr>& outputs);

struct Compiled {
  explicit Compiled(const Question& question);

  Prefix prefix;
  Givens givens;
  Followers followers;
  std::vector<CompiledCase> cases;
  std::vector<std::vector<Source>> sources;  ///< by case, by variable
  bool has_objective;
  std::vector<std::string> names, parameter_names;
  bool has_family;
  std::vector<bool> is_decisive;  ///< by name: whether no solution is left where it is refuted, of no family
  std::vector<Interval> parameter_values;
  std::map<std::string, Named> parameter_places, variable_places;
  std::size_t variables;
  std::vector<WantedTube> tubes;

  [[nodiscard]] std::size_t most_registers() const;
  [[nodiscard]] std::size_t most_core() const;
  [[nodiscard]] std::size_t most_surfaces() const;
};

Compiled compile_cases(const Question& question, std::size_t most_cases);

}  // namespace hcsp::online
