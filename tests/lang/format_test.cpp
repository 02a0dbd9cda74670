// SPDX-License-Identifier: Apache-2.0
// The canonical layout: every model that can be read keeps its tokens and comments, and a second formatting
// changes nothing.
#include "lang/syntax/format.h"

#include <gtest/gtest.h>

#include "corpus.h"
#include "lang/syntax/parser.h"

namespace hcsp::lang {
namespace {

std::string formatted(const std::string& text) {
  const Source source("model.hcsp", text);
  Diagnostics diagnostics;
  const auto result = format(source, diagnostics);
  EXPECT_TRUE(result.has_value()) << diagnostics.text();
  return result.value_or("");
}

std::string tree_of(const std::string& text) {
  SyntaxTree tree;
  Diagnostics diagnostics;
  parse_items(tree.add_source("model.hcsp", text), tree, diagnostics);
  EXPECT_FALSE(diagnostics.any()) << diagnostics.text();
  return dump(tree);
}

std::string without_space(std::string text) {
  std::erase_if(text, [](unsigned char c) { return std::isspace(c) != 0; });
  return text;
}

void expect_layout(const std::string& text) {
  const std::string once = formatted(text);
  EXPECT_EQ(formatted(once), once);
  EXPECT_EQ(tree_of(once), tree_of(text));
  EXPECT_EQ(without_space(once), without_space(text));
}

TEST(Format, KeepsTheTreeOfEveryModel) {
  std::size_t models = 0;
  for (const auto& folder :
       {kLangTests / "good", kLangTests / "bad", kLangTests.parent_path().parent_path() / "models"}) {
    for (const auto& path : models_in(folder)) {
      const std::string text = read_text(path);
      const Source source(path.string(), text);
      Diagnostics diagnostics;
      if (!format(source, diagnostics)) continue;
      SCOPED_TRACE(path);
      expect_layout(text);
      ++models;
    }
  }
  EXPECT_GT(models, 100U);
}

TEST(Format, LaysOut) {
  EXPECT_EQ(formatted("model  m ;\n\n\n\n// about x\nvar x:real  in[ -1 ,2 ]; // m\nconstraint c :x ^2+ - 3 "
                      "*x==-1 ;solve propagate;"),
            "model m;\n\n// about x\nvar x : real in [-1, 2];  // m\nconstraint c: x^2 + -3*x == -1;\nsolve "
            "propagate;\n");
  EXPECT_EQ(formatted("constraint forall(i in 1 .. n)sum(j in 1..i+1)(x[ i,j ])<=f (a)( t ) and "
                      "not D==union(t){b:real[2]|b==c}and A union(B inter C)subset E;"),
            "constraint forall(i in 1..n) sum(j in 1..i + 1) (x[i, j]) <= f(a)(t)\n"
            "    and not D == union(t) { b : real[2] | b == c } and A union (B inter C) subset E;\n");
  EXPECT_EQ(formatted("param e:real=1/* half */+/* two\nlines */2;\nlet y = // why\n  3\n  // own\n  +4;\n"),
            "param e : real = 1 /* half */ + /* two\nlines */\n    2;\nlet y = // why\n    3\n    // own\n   "
            " + 4;\n");
  EXPECT_EQ(formatted("constraint atleast(2,i in 1..3)(x[i]>0);constraint atleast(1,(a,b));constraint min(a "
                      "in M)(d)==if c then 1 else - 2 endif;"),
            "constraint atleast(2, i in 1..3) (x[i] > 0);\nconstraint atleast(1, (a, b));\n"
            "constraint min(a in M) (d) == if c then 1 else -2 endif;\n");
  EXPECT_EQ(formatted("\n\n/* head */ model m; /* a */ // b\n\n\n// end\n\n"),
            "/* head */\nmodel m;  /* a */  // b\n\n// end\n");
  EXPECT_EQ(formatted(""), "");
  EXPECT_EQ(formatted("var x:real;//a\nvar yy : real; // b\nlet z=min(x,yy)-1+sum(x)-x; //c\n"),
            "var x : real;                         //a\nvar yy : real;                        // b\n"
            "let z = min(x, yy) - 1 + sum(x) - x;  //c\n");
  EXPECT_EQ(formatted("constraint forall(t)-x<1;"), "constraint forall(t) -x < 1;\n");
}

TEST(Format, BreaksLongItemsWhereTheyHoldTogetherLeast) {
  std::string constraint = "constraint long: x[1] == 1";
  for (int i = 2; i < 20; ++i)
    constraint += " and f(x[" + std::to_string(i) + "], 2*y) == " + std::to_string(i);
  const std::string text = formatted(constraint + ";\n");
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 100U) << line;
    EXPECT_TRUE(line.starts_with("constraint long: ") || line.starts_with("    and ")) << line;
  }
  expect_layout(constraint + ";");
  expect_layout("let y = " + std::string(200, 'a') + " + " + std::string(200, 'b') + ";");
}

TEST(Format, RefusesWhatCannotBeRead) {
  const Source source("model.hcsp", "var x real;");
  Diagnostics diagnostics;
  EXPECT_FALSE(format(source, diagnostics).has_value());
  EXPECT_TRUE(diagnostics.any());
}

}  // namespace
}  // namespace hcsp::lang
