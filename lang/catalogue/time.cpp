// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "lang/catalogue/entries.h"

namespace hcsp::lang {

std::span<const CatalogueEntry> time_entries() {
  static constexpr std::array kEntries{
      CatalogueEntry{Code::no_time_line, "a tube needs a time line, and the model has no `time`",
                     "Tubes are functions of the time that the `time` item declares.", "var x : tube real;",
                     "time t in [0, 1] step 0.1;\nvar x : tube real;"},
      CatalogueEntry{
          Code::off_the_time_line, "the instant {} is outside the time line [{}, {}]",
          "A tube has values on its time line only. When stamps have an offset, say x(first(log.t)).",
          "time t in [0, 1] step 0.1;\nvar x : tube real;\nconstraint x(1000) == 0;",
          "time t in [0, 1] step 0.1;\nvar x : tube real;\nconstraint x(1) == 0;"},
      CatalogueEntry{Code::bad_time_span, "a time line runs from an instant to a later one, both finite",
                     "Write [start, end] with start < end, or give two stamps or more.",
                     "time t in [1, 1] step 0.1;", "time t in [0, 1] step 0.1;"},
      CatalogueEntry{Code::bad_step, "the step of a time line is a positive number", "Write `step 0.1`.",
                     "time t in [0, 1] step 0;", "time t in [0, 1] step 0.1;"},
      CatalogueEntry{Code::too_many_instants, "[{}, {}] in steps of {} are over ten million instants",
                     "Either the step is too small, or the span starts far from the data.",
                     "time t in [0, 1700000000] step 0.1;", "time t in [1700000000, 1700000100] step 0.1;"},
      CatalogueEntry{
          Code::bad_precision, "a precision is a positive number, this is {}",
          "The precision of a set is the edge of its cells, that of `solve all` the width of what it "
          "does not cut finer.",
          "var M : set real[2] in [0, 1]^2 precision 0;", "var M : set real[2] in [0, 1]^2 precision 0.1;"},
      CatalogueEntry{
          Code::flat_frame, "this frame has no extent along axis {}",
          "The bound of a set is a box with an inside: a frame of zero area would leave nothing of the set.",
          "var M : set real[2] in ([0, 1], [2, 2]) precision 0.1;",
          "var M : set real[2] in ([0, 1], [2, 3]) precision 0.1;"},
      CatalogueEntry{Code::no_precision, "the set `{}` has no precision",
                     "A set is known on a grid of cells; `precision` is their edge.",
                     "var M : set real[2] in [0, 1]^2;", "var M : set real[2] in [0, 1]^2 precision 0.1;"},
      CatalogueEntry{Code::negative_error, "an error bound cannot be negative",
                     "m +- e is the interval [m - e, m + e].", "var x : real in 1 +- -0.1;",
                     "var x : real in 1 +- 0.1;"},
      CatalogueEntry{
          Code::precisions_differ, "the precisions of `{}` ({}) and `{}` ({}) differ",
          "Sets that meet in a relation stand on one grid, or on grids of which one refines the other: the\n"
          "ratio of their precisions is then 2, 4, 8 or another power of two.",
          "var A : set real[2] in [0, 1]^2 precision 0.1;\nvar B : set real[2] in [0, 1]^2 precision 0.3;\n"
          "constraint disjoint(A, B);",
          "var A : set real[2] in [0, 1]^2 precision 0.1;\nvar B : set real[2] in [0, 1]^2 precision 0.2;\n"
          "constraint disjoint(A, B);"},
      CatalogueEntry{Code::bad_set_dimension, "sets have points of 1 to 3 components, this is {}",
                     "Write set real[2] or set real[3].", "var M : set real[4] precision 0.1;",
                     "var M : set real[3] precision 0.1;"},
      CatalogueEntry{
          Code::out_of_range, "this is beyond what can be solved: {}",
          "A number is too large, or too small beside another, for the computation that the model asks for.",
          "var M : set real[2] in [-1e30, 1e30]^2 precision 0.1;",
          "var M : set real[2] in [-100, 100]^2 precision 0.1;"},
      CatalogueEntry{Code::unbounded_frame, "the bound of a set has to be finite",
                     "Leave out `in` where no bound is known: the whole space is then unknown.",
                     "var M : set real[2] in [-oo, oo]^2 precision 0.1;",
                     "var M : set real[2] precision 0.1;"},
      CatalogueEntry{Code::data_outside, "no row of the data lies within the time line [{}, {}]",
                     "Rows outside the time line are not used; here, none is left.",
                     "data log = csv(\"log.csv\");\ntime t in [100, 101] step 0.1;\n"
                     "given z : tube real = sampled(log.t, log.range);",
                     "data log = csv(\"log.csv\");\ntime t in [first(log.t), last(log.t)] step 0.1;\n"
                     "given z : tube real = sampled(log.t, log.range);"},
      CatalogueEntry{Code::no_grid, "no set has a name in this relation, so there is no grid for it",
                     "Sets are known on the cells of a grid, which is that of a set that the relation names.",
                     "var r : real;\nconstraint {a : real[2] | norm(a) < r} subset {a : real[2] | a[1] < 1};",
                     "var r : real;\nvar D : set real[2] precision 0.1;\n"
                     "constraint D == {a | norm(a) < r};\nconstraint D subset {a | a[1] < 1};"},
      CatalogueEntry{Code::no_gate, "this is no gate of a time line with phases: {}",
                     "The instants of `time t in [0, T] phases tau` are unknown; they are called 0, gate(1), "
                     "gate(2), ..., T.",
                     "var T : real;\nvar tau : real[2];\ntime t in [0, T] phases tau;\nvar x : tube real;\n"
                     "constraint der(x) == 1 and x(0) == 0 and x(0.5) == 1;",
                     "var T : real;\nvar tau : real[2];\ntime t in [0, T] phases tau;\nvar x : tube real;\n"
                     "constraint der(x) == 1 and x(0) == 0 and x(gate(1)) == 1;"},
      CatalogueEntry{
          Code::no_polynomial, "this cannot be said of polynomials: {}",
          "On a time line with phases a tube is a polynomial on each phase, in the coefficients that are "
          "found:\n"
          "sums and products of tubes are, other functions of them are not. An inequality between tubes is\n"
          "decided for every t where the sides differ by a polynomial of degree 3 at most.",
          "var T : real;\nvar tau : real[2];\ntime t in [0, T] phases tau;\nvar x : tube real;\n"
          "constraint der(x) == 1 and x(0) == 0 and sin(x) <= 0.5;",
          "var T : real;\nvar tau : real[2];\ntime t in [0, T] phases tau;\nvar x : tube real;\n"
          "constraint der(x) == 1 and x(0) == 0 and x^2 <= 0.5;"},
      CatalogueEntry{
          Code::undefined_tube, "the tube `{}` has no definition",
          "On a time line with phases a tube is what `der(x) == f` or `x == f` makes of tubes that have a\n"
          "definition, of numbers and of `hold(f)`, which is f[i] during phase i.",
          "var T : real;\nvar tau : real[2];\ntime t in [0, T] phases tau;\nvar x : tube real;\n"
          "constraint x <= 1;",
          "var T : real;\nvar tau, v : real[2];\ntime t in [0, T] phases tau;\nvar x : tube real;\n"
          "constraint der(x) == hold(v) and x <= 1;"},
  };
  return kEntries;
}

}  // namespace hcsp::lang
