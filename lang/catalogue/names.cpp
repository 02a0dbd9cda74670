// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "lang/catalogue/entries.h"

namespace hcsp::lang {

std::span<const CatalogueEntry> name_entries() {
  static constexpr std::array kEntries{
      CatalogueEntry{
          Code::unknown_name, "`{}` is not declared",
          "Every name is declared once, anywhere in the model, as a param, data, time, function, given, var\n"
          "or let; a, i and the like are bound by a set builder or a quantifier.",
          "var speed : real;\nconstraint sped == 1;", "var speed : real;\nconstraint speed == 1;"},
      CatalogueEntry{
          Code::declared_twice, "`{}` is already declared",
          "A name is declared once at the top level, in this file and those that it includes. Constraints\n"
          "have names too.",
          "var x : real;\nlet x = 1;", "var x : real;\nlet y = 1;"},
      CatalogueEntry{
          Code::unknown_function, "there is no function `{}`",
          "What is called is a function of the model, a built-in function, or a tube at an instant.",
          "var x : real;\nconstraint sqrd(x) == 1;", "var x : real;\nconstraint sqr(x) == 1;"},
      CatalogueEntry{Code::built_in_name, "`{}` is the name of a built-in function or constant",
                     "A function cannot take the name of a built-in one, and pi is pi.",
                     "function norm(x : real) : real = x;", "function my_norm(x : real) : real = x;"},
      CatalogueEntry{
          Code::cyclic_definition, "`{}` is defined by itself",
          "Parameters and lets are definitions: following them has to come to an end. An equation between\n"
          "unknowns is a constraint.",
          "let a = b + 1;\nlet b = a - 1;", "var a : real;\nvar b : real;\nconstraint a == b + 1;"},
      CatalogueEntry{
          Code::recursion, "the function `{}` calls itself",
          "Functions are formulas, put in place of their calls. They cannot call themselves, not even\n"
          "through others.",
          "function f(x : real) : real = f(x) + 1;", "function f(x : real) : real = x + 1;"},
      CatalogueEntry{Code::wrong_type, "expected {}, found {}",
                     "The value has another type than this place asks for.",
                     "var x : real[2];\nfunction f(x : real) : real = 2*x;\nconstraint f(x) == 1;",
                     "var x : real[2];\nfunction f(x : real) : real = 2*x;\nconstraint f(x[1]) == 1;"},
      CatalogueEntry{
          Code::wrong_operands, "`{}` does not apply to {} and {}",
          "Sums need operands of one size; a vector may be multiplied and divided by a number. The product\n"
          "of two vectors is dot(a, b).",
          "var x : real[2];\nconstraint x*x == 1;", "var x : real[2];\nconstraint dot(x, x) == 1;"},
      CatalogueEntry{Code::sizes_differ, "the sizes of {} and {} differ",
                     "A relation compares component by component, so both sides have as many.",
                     "var x : real[2];\nconstraint x == (1, 2, 3);",
                     "var x : real[2];\nconstraint x == (1, 2);"},
      CatalogueEntry{Code::index_outside, "the index {} is not between {} and {}",
                     "Components are counted from 1.", "var x : real[2];\nconstraint x[0] == 1;",
                     "var x : real[2];\nconstraint x[1] == 1;"},
      CatalogueEntry{Code::no_components, "{} has no components",
                     "Only vectors and columns of data have an index.",
                     "var x : real;\nconstraint x[1] == 1;", "var x : real[2];\nconstraint x[1] == 1;"},
      CatalogueEntry{Code::wrong_argument_count, "`{}` takes {}, {} given", "Count the arguments.",
                     "var x : real;\nconstraint atan2(x) == 1;",
                     "var x : real;\nconstraint atan2(x, 2) == 1;"},
      CatalogueEntry{
          Code::domain_in_expression, "a domain cannot stand in an expression",
          "[a, b] and m +- e are sets of values for an unknown, not values. They stand after `in`, as the\n"
          "value of a given, or as the value of a param. x == [1, 2] would ask a number to be a set.",
          "var x : real;\nconstraint x == [1, 2];", "var x : real;\nconstraint x in [1, 2];"},
      CatalogueEntry{
          Code::not_constant, "this has to be a constant",
          "Sizes, indices, exponents, precisions, stated domains and the time line are fixed before\n"
          "solving: they may use numbers, params with a value, and data.",
          "var n : real;\nvar x : real in [0, n];", "param n = 2;\nvar x : real in [0, n];"},
      CatalogueEntry{Code::not_callable, "`{}` cannot be called, it is {}",
                     "A name before parentheses is a function, or a tube at an instant.",
                     "var x : real;\nconstraint x(0) == 1;",
                     "time t in [0, 1] step 0.5;\nvar x : tube real;\nconstraint x(0) == 1;"},
      CatalogueEntry{Code::not_a_relation, "a constraint is a relation, this is {}",
                     "A constraint says that something holds: an equation, an inequality, a membership.",
                     "var x : real;\nconstraint x + 1;", "var x : real;\nconstraint x + 1 == 0;"},
      CatalogueEntry{Code::empty_interval, "this interval is empty: its first bound is above the second",
                     "An interval is written [lowest, highest].", "var x : real in [1, 0];",
                     "var x : real in [0, 1];"},
      CatalogueEntry{Code::undefined_constant, "this constant does not exist",
                     "A division by zero, or a function outside its domain of definition.", "param a = 1/0;",
                     "param a = 1/2;"},
      CatalogueEntry{Code::unknown_parameter, "the model has no param `{}`",
                     "--set NAME=VALUE replaces the value of a param of the model.",
                     "hcsp-solve slam.hcsp --set epsilon=0.1", "hcsp-solve slam.hcsp --set eps=0.1"},
      CatalogueEntry{Code::unknown_data, "the model has no data `{}`",
                     "--data NAME=FILE replaces the file of a data item of the model.",
                     "hcsp-solve slam.hcsp --data logs=run2.csv", "hcsp-solve slam.hcsp --data log=run2.csv"},
      CatalogueEntry{
          Code::unknown_dimension, "the dimension of `{}` is not known here",
          "The point of a set builder takes its dimension from the set beside it; where there is none, say\n"
          "{ a : real[2] | ... }.",
          "var M : set real[2] in [0, 1]^2 precision 0.1;\nlet disc = { a | norm(a) < 1 };\n"
          "constraint M == disc;",
          "var M : set real[2] in [0, 1]^2 precision 0.1;\nlet disc = { a : real[2] | norm(a) < 1 };\n"
          "constraint M == disc;"},
      CatalogueEntry{Code::bad_size, "a size is a whole number from 1 to {}, this is {}", "See the message.",
                     "var x : real[0];", "var x : real[1];"},
      CatalogueEntry{
          Code::not_the_time, "`{}` is not the time line of the model",
          "forall(t) and union(t) run over the time line: t is the name that the `time` item gave.",
          "time t in [0, 1] step 0.1;\nvar x : tube real;\nconstraint forall(s) (x > 0);",
          "time t in [0, 1] step 0.1;\nvar x : tube real;\nconstraint forall(t) (x > 0);"},
      CatalogueEntry{Code::misplaced_precision, "only a set has a precision, this is {}",
                     "The precision of a set is the edge of its cells. Reals and tubes are bounded as "
                     "tightly as they can.",
                     "var x : real in [0, 1] precision 0.1;", "var x : real in [0, 1];"},
      CatalogueEntry{Code::misplaced_infinity, "`oo` is only a bound: it stands in [a, oo] or [-oo, b]",
                     "Every real is finite.", "var x : real;\nconstraint x < oo;",
                     "var x : real in [-oo, 5];"},
      CatalogueEntry{Code::not_shown, "`{}` is no unknown of the model",
                     "`show` lists unknowns: var, given, and params that are intervals.",
                     "let a = 1;\nshow a;", "var a : real;\nshow a;"},
      CatalogueEntry{
          Code::not_paved, "`{}` is no unknown number or vector of the model",
          "`solve pave` finds the set of values that some unknowns can have: reals, ints, vectors and "
          "arrays of them, or elements. The other unknowns are parameters.",
          "var x : real in [0, 1];\nconstraint x^2 < 0.5;\nsolve pave(2*x) precision 0.1;",
          "var x : real in [0, 1];\nconstraint x^2 < 0.5;\nsolve pave(x) precision 0.1;"},
      CatalogueEntry{
          Code::paved_twice, "`{}` is paved already",
          "Every component that `solve pave` names is a coordinate of the boxes; name each once.",
          "var x : real[2] in [0, 1]^2;\nconstraint norm(x) < 1;\nsolve pave(x, x[1]) precision 0.1;",
          "var x : real[2] in [0, 1]^2;\nconstraint norm(x) < 1;\nsolve pave(x) precision 0.1;"},
  };
  return kEntries;
}

}  // namespace hcsp::lang
