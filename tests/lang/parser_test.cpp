// SPDX-License-Identifier: Apache-2.0
#include "lang/syntax/parser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corpus.h"

namespace hcsp::lang {
namespace {

std::string parsed(const std::string& text) {
  SyntaxTree tree;
  Diagnostics diagnostics;
  const Source& source = tree.add_source("text", text);
  const Expr* expr = parse_expression(source, tree, diagnostics);
  return expr == nullptr ? diagnostics.text() : dump(*expr);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

TEST(Parser, KnowsWhatBindsTighter) {
  EXPECT_EQ(parsed("1 + 2*3 - 4"), "(- (+ 1 (* 2 3)) 4)");
  EXPECT_EQ(parsed("-x^2"), "(- (^ x 2))");
  EXPECT_EQ(parsed("2^-x"), "(^ 2 (- x))");
  EXPECT_EQ(parsed("2^3^4"), "(^ 2 (^ 3 4))");
  EXPECT_EQ(parsed("a/b/c"), "(/ (/ a b) c)");
  EXPECT_EQ(parsed("-a*b"), "(* (- a) b)");
  EXPECT_EQ(parsed("a - -b"), "(- a (- b))");
  EXPECT_EQ(parsed("not a == b and c"), "(and (not (== a b)) c)");
  EXPECT_EQ(parsed("a or b and c implies d iff e"), "(iff (implies (or a (and b c)) d) e)");
  EXPECT_EQ(parsed("a implies b implies c"), "(implies a (implies b c))");
  EXPECT_EQ(parsed("a xor b or c"), "(or (xor a b) c)");
  EXPECT_EQ(parsed("m + 1 +- e*2"), "(+- (+ m 1) (* e 2))");
  EXPECT_EQ(parsed("x in m +- e"), "(in x (+- m e))");
  EXPECT_EQ(parsed("D == A union B inter C"), "(== D (union A (inter B C)))");
  EXPECT_EQ(parsed("A \\ B union C"), "(union (\\ A B) C)");
}

TEST(Parser, ReadsOperands) {
  EXPECT_EQ(parsed("(a)"), "a");
  EXPECT_EQ(parsed("(a, b, c)"), "(tuple a b c)");
  EXPECT_EQ(parsed("[a, b]^2"), "(^ (interval a b) 2)");
  EXPECT_EQ(parsed("u[1]"), "(index u 1)");
  EXPECT_EQ(parsed("A[1, 2]"), "(index A 1 2)");
  EXPECT_EQ(parsed("log.t[2]"), "(index (. log \"t\") 2)");
  EXPECT_EQ(parsed("log.\"speed (m/s)\""), "(. log \"speed (m/s)\")");
  EXPECT_EQ(parsed("log.time"), "(. log \"time\")");
  EXPECT_EQ(parsed("f(a)(b)[1]"), "(index (call (call f a) b) 1)");
  EXPECT_EQ(parsed("f()"), "(call f)");
  EXPECT_EQ(parsed("if a then b else c endif + 1"), "(+ (if a b c) 1)");
  EXPECT_EQ(parsed("[-oo, oo]"), "(interval (- oo) oo)");
  EXPECT_EQ(parsed("true or false"), "(or true false)");
}

TEST(Parser, ReadsQuantifiers) {
  EXPECT_EQ(parsed("forall(t) a and b"), "(forall (t) (and a b))");
  EXPECT_EQ(parsed("forall(i in 1..3, j in 1..n) a"), "(forall (i in (.. 1 3) j in (.. 1 n)) a)");
  EXPECT_EQ(parsed("exists(t in [0, 1]) a"), "(exists (t in (interval 0 1)) a)");
  EXPECT_EQ(parsed("{ a | a == b }"), "(set (a) (== a b))");
  EXPECT_EQ(parsed("{ a : real[2] | c }"), "(set (a : real[2]) c)");
  EXPECT_EQ(parsed("D == union(t) { a | c }"), "(== D (union (t) (set (a) c)))");
  EXPECT_EQ(parsed("sum(i in 1..3) (x[i]) + 1"), "(+ (sum (i in (.. 1 3)) (index x i)) 1)");
  EXPECT_EQ(parsed("min(a in M) (d(a))"), "(min (a in M) (call d a))");
  EXPECT_EQ(parsed("min(a, b)"), "(call min a b)");
  EXPECT_EQ(parsed("max(x) - min(x)"), "(- (call max x) (call min x))");
  EXPECT_EQ(parsed("subset(A, B)"), "(call subset A B)");
}

TEST(Parser, ReadsNumbers) {
  for (const char* text : {"0", "12", "0.5", ".5", "1.", "1e3", "1.5E-3", "1e+3"})
    EXPECT_EQ(parsed(text), text);
  EXPECT_EQ(parsed("1..3"), "(.. 1 3)");
  for (const char* text : {"1e", "2x", "1.2.3", "1.5.", "0x10"}) {
    EXPECT_THAT(parsed(text), testing::HasSubstr("error[E0")) << text;
  }
}

TEST(Parser, SaysWhatItExpected) {
  EXPECT_EQ(first_line(parsed("1 +")),
            "text:1:4: error[E001]: expected an expression, found the end of the file");
  EXPECT_EQ(first_line(parsed("(1, 2")), "text:1:6: error[E001]: expected `)`, found the end of the file");
  EXPECT_EQ(first_line(parsed("a b")), "text:1:3: error[E001]: expected the end of the file, found `b`");
  EXPECT_EQ(first_line(parsed("a < b < c")), "text:1:7: error[E008]: `<` does not chain");
  EXPECT_EQ(first_line(parsed("")),
            "text:1:1: error[E001]: expected an expression, found the end of the file");
}

TEST(Parser, BoundsTheDepth) {
  const auto repeated = [](const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
  };
  constexpr int kDeep = 100'000;
  for (const std::string& text :
       {repeated("(", kDeep), repeated("-", kDeep) + "1", repeated("not ", kDeep) + "a",
        repeated("f(", kDeep), repeated("[1,", kDeep), repeated("{a|", kDeep),
        repeated("forall(t) ", kDeep) + "a", repeated("if ", kDeep), "1" + repeated("^2", kDeep),
        "1" + repeated("+1", kDeep), "a" + repeated(".b", kDeep), "a" + repeated("[1]", kDeep),
        "a" + repeated(" implies a", kDeep), repeated("union(t) (", kDeep)}) {
    EXPECT_THAT(parsed(text), testing::HasSubstr("error[E006]")) << text.substr(0, 20);
  }
  EXPECT_THAT(parsed(repeated("(", 90) + "1" + repeated(")", 90)), "1");
  EXPECT_THAT(parsed("1" + repeated("+1", 900)), testing::StartsWith("(+ "));
}

TEST(Parser, GoesOnAfterAnError) {
  SyntaxTree tree;
  Diagnostics diagnostics;
  const Source& source =
      tree.add_source("m.hcsp", "var x : ;\nvar y : real;\nlet = 3;\nvar z : real\nsolve propagate;");
  parse_items(source, tree, diagnostics);
  EXPECT_EQ(diagnostics.count(), 3);
  EXPECT_EQ(dump(tree), "(var y real in _ precision _)\n(solve propagate)\n");
}

TEST(Parser, ReadsItems) {
  SyntaxTree tree;
  Diagnostics diagnostics;
  const Source& source = tree.add_source("m.hcsp",
                                         "time t in [0, T] phases tau; time t at log.t; var A : array[1..3, "
                                         "1..2] of tube real[2]; solve all precision "
                                         "1e-8; solve pave(x, y) precision 0.1; solve minimize sum(tau) "
                                         "precision 1; var b : bool; var k : int in [1, 2];");
  parse_items(source, tree, diagnostics);
  EXPECT_EQ(diagnostics.text(), "");
  EXPECT_EQ(tree.items.size(), 8);
}

}  // namespace
}  // namespace hcsp::lang
