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
    case Status::limit:
      return "limit";
  }
  return "";
}

bool ResultVariable::is_empty() const {
  return std::visit([](const auto& d) { return d.is_empty(); }, domain);
}

const Domain& Result::operator[](std::string_view name) const {
  const auto found = std::find_if(variables.begin(), variables.end(),
                                  [&](const ResultVariable& v) { return v.name == name; });
  if (found == variables.end()) throw std::out_of_range("Result: no variable " + std::string(name));
  return found->domain;
}

}  // namespace hcsp
