// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "lang/catalogue/entries.h"

namespace hcsp::lang {

std::span<const CatalogueEntry> relation_entries() {
  static constexpr std::array kEntries{
      CatalogueEntry{
          Code::der_misplaced, "`der` stands alone on one side of `==` in a constraint",
          "A differential equation is written der(x) == f. It cannot stand within another relation.",
          "time t in [0, 1] step 0.1;\nvar x : tube real;\nconstraint der(x) < 1;",
          "time t in [0, 1] step 0.1;\nvar x : tube real;\nvar v : tube real in [-oo, 1];\nconstraint der(x) "
          "== v;"},
      CatalogueEntry{Code::der_of_what, "`der` takes the name of a tube",
                     "Name what is differentiated: a var or a given that is a tube.",
                     "time t in [0, 1] step 0.1;\nvar x : tube real;\nconstraint der(2*x) == 1;",
                     "time t in [0, 1] step 0.1;\nvar x : tube real;\nvar y : tube real;\n"
                     "constraint y == 2*x;\nconstraint der(y) == 1;"},
      CatalogueEntry{
          Code::zone_over_time, "this set varies with time: put `union({})` before it",
          "A set equals one set. The union over the time line of the zones at each instant is one.",
          "time t in [0, 1] step 0.1;\nvar x : tube real[2];\nvar D : set real[2] precision 0.1;\n"
          "constraint D == { a | norm(a - x(t)) < 1 };",
          "time t in [0, 1] step 0.1;\nvar x : tube real[2];\nvar D : set real[2] precision 0.1;\n"
          "constraint D == union(t) { a | norm(a - x(t)) < 1 };"},
  };
  return kEntries;
}

}  // namespace hcsp::lang
