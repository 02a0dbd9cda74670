// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "lang/catalogue/entries.h"

namespace hcsp::lang {

std::span<const CatalogueEntry> syntax_entries() {
  static constexpr std::array kEntries{
      CatalogueEntry{
          Code::unexpected, "expected {}, found {}",
          "The text does not follow the grammar here. Every item ends with a semicolon; the grammar is in\n"
          "docs/language.md.",
          "var x : real in [0, 1]\nvar y : real;", "var x : real in [0, 1];\nvar y : real;"},
      CatalogueEntry{
          Code::bad_character, "the character {} has no meaning here",
          "The language is written in ASCII: names are letters, digits and underscores. Other characters\n"
          "may stand in comments and strings only.",
          "var x : real;\nconstraint x >= 0 & x <= 1;", "var x : real;\nconstraint x >= 0 and x <= 1;"},
      CatalogueEntry{Code::broken_utf8, "this byte is not valid UTF-8",
                     "Model files are UTF-8 text. An editor can save the file anew with that encoding.",
                     "// 21 \xB0"
                     "C\nvar x : real;",
                     "// 21 \xC2\xB0"
                     "C\nvar x : real;"},
      CatalogueEntry{
          Code::unterminated_string, "this string has no closing quote on its line",
          "A string runs from one double quote to the next on the same line. There are no escapes.",
          "data log = csv(\"log.csv);", "data log = csv(\"log.csv\");"},
      CatalogueEntry{Code::unterminated_comment, "this comment has no closing `*/`",
                     "A comment that starts with /* runs to the next */. Comments do not nest.",
                     "var x : real; /* the abscissa", "var x : real; /* the abscissa */"},
      CatalogueEntry{
          Code::too_deep, "this is nested too deeply (at most {} levels, and {} operators on one path)",
          "Brackets, quantifiers, conditionals and prefixes may nest 100 levels deep, and a chain of\n"
          "operators may be 1000 long. Name parts of a long expression with `let`.",
          "let a = ------------------------------------------------------------------------------------"
          "-------------------1;",
          "let a = -1;"},
      CatalogueEntry{Code::malformed_number, "`{}` is not a number",
                     "A number is written 12, 0.5, .5 or 1.5e-3. A product needs its `*`.", "param a = 2pi;",
                     "let a = 2*pi;"},
      CatalogueEntry{
          Code::does_not_chain, "`{}` does not chain",
          "Comparisons, `+-`, `..` and `iff` take two operands. A double comparison is two comparisons.",
          "var x : real;\nconstraint 0 < x < 1;", "var x : real;\nconstraint 0 < x and x < 1;"},
      CatalogueEntry{Code::reserved_word, "`{}` is a reserved word and cannot be a name",
                     "The words of the language are reserved, except after a dot (`log.time` is a column).",
                     "var step : real;", "var dt : real;"},
      CatalogueEntry{
          Code::not_supported, "{} is not supported yet",
          "The language has this, and the model may well be right, but this version of hcsp cannot solve\n"
          "it. docs/language.md lists what works.",
          "var M : set real[2] in [-1, 1]^2 precision 0.5;\nconstraint volume(M) >= 1;",
          "var M : set real[2] in [-1, 1]^2 precision 0.5;\nconstraint (0, 0) in M;"},
      CatalogueEntry{
          Code::unreadable_file, "cannot read `{}`: {}",
          "The file of an `include` does not exist, may not be read, or is too large. Paths are relative to\n"
          "the file that names them.",
          "include \"no_such_file.hcsp\";", "include \"library.hcsp\";"},
      CatalogueEntry{
          Code::include_cycle, "`{}` includes itself",
          "A file that is being read includes a file that includes it again. Take what both need into a\n"
          "third file.",
          "include \"cycle.hcsp\";", "include \"library.hcsp\";"},
      CatalogueEntry{Code::item_twice, "the model has a second `{}`",
                     "A model has one name, one time line and one goal.",
                     "solve propagate;\nsolve propagate;", "solve propagate;"},
      CatalogueEntry{Code::item_missing, "the model has no `{}`",
                     "A model says what it is called and what to do: `model name;` and `solve propagate;`.",
                     "// model-less\nmodel m;\nvar x : real;", "model m;\nvar x : real;\nsolve propagate;"},
      CatalogueEntry{
          Code::too_large, "this grows to more than {} operations",
          "Functions are put in place of their names. Where each uses another several times, the model\n"
          "multiplies at every level.",
          "function f1(x : real) : real = x + x*x;\n"
          "function f2(x : real) : real = f1(x) + f1(x) + f1(x) + f1(x) + f1(x) + f1(x) + f1(x) + f1(x);\n"
          "function f3(x : real) : real = f2(x) + f2(x) + f2(x) + f2(x) + f2(x) + f2(x) + f2(x) + f2(x);\n"
          "function f4(x : real) : real = f3(x) + f3(x) + f3(x) + f3(x) + f3(x) + f3(x) + f3(x) + f3(x);\n"
          "function f5(x : real) : real = f4(x) + f4(x) + f4(x) + f4(x) + f4(x) + f4(x) + f4(x) + f4(x);\n"
          "function f6(x : real) : real = f5(x) + f5(x) + f5(x) + f5(x) + f5(x) + f5(x) + f5(x) + f5(x);\n"
          "function f7(x : real) : real = f6(x) + f6(x) + f6(x) + f6(x) + f6(x) + f6(x) + f6(x) + f6(x);\n"
          "function f8(x : real) : real = f7(x) + f7(x) + f7(x) + f7(x) + f7(x) + f7(x) + f7(x) + f7(x);\n"
          "var x : real;\n"
          "constraint f8(x) == 1;",
          "function f(x : real) : real = x + x*x;\nvar x : real;\nconstraint f(f(x)) == 1;"},
  };
  return kEntries;
}

}  // namespace hcsp::lang
