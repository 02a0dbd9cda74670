// SPDX-License-Identifier: Apache-2.0
#include "solver/result.h"

#include <algorithm>
#include <stdexcept>

namespace hcsp {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::contracted:
      return "contracted";
    case Status::infeasible:
      return "infeasible";
    case Status::solved:
      return "solved";
    case Status::limit:
      return "limit";
  }
  return "";
}

std::string_view to_string(Certificate certificate) {
  constexpr std::string_view kNames[] = {"unique", "exists", "inner", "none"};
  return kNames[static_cast<std::size_t>(certificate)];
}

std::string_view to_string(Reason reason) {
  constexpr std::string_view kNames[] = {"", "overdetermined", "singular", "boundary", "manifold", "limit"};
  return kNames[static_cast<std::size_t>(reason)];
}

std::vector<const ResultVariable*> select(const std::vector<ResultVariable>& variables,
                                          const std::vector<std::string>& names) {
  std::vector<const ResultVariable*> selected;
  for (const std::string& name : names) {
    for (const ResultVariable& variable : variables) {
      if (variable.name == name || variable.shape.array == name) selected.push_back(&variable);
    }
  }
  if (names.empty()) {
    for (const ResultVariable& variable : variables) selected.push_back(&variable);
  }
  return selected;
}

bool ResultVariable::is_empty() const {
  return std::visit([](const auto& d) { return d.is_empty(); }, domain);
}

const std::vector<ResultVariable>& told_variables(const Result& result) {
  if (!result.search) return result.variables;
  for (const Solution& solution : result.search->solutions) {
    if (solution.certificate != Certificate::none) return solution.variables;
  }
  return result.variables;
}

const Domain& Result::operator[](std::string_view name) const {
  const auto found = std::find_if(variables.begin(), variables.end(),
                                  [&](const ResultVariable& v) { return v.name == name; });
  if (found == variables.end()) throw std::out_of_range("Result: no variable " + std::string(name));
  return found->domain;
}

}  // namespace hcsp
