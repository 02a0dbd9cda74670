// SPDX-License-Identifier: Apache-2.0
// Minibex: what IBEX's language means here, by the solutions of small systems; golden corpora of good and bad
// files; and sizes that have to be read soon.
#include "lang/minibex/minibex.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "corpus.h"

namespace hcsp::lang {
namespace {

const std::filesystem::path kFiles = kLangTests / "minibex";
const std::vector<std::string> kEndings{".bch", ".mbx", ".txt"};

Compilation read(const std::string& text, const CompileOptions& options = {}) {
  return compile_text({"folder/system.bch", text}, options);
}

Result solved(const Compilation& compilation) {
  EXPECT_EQ(compilation.diagnostics.text(), "");
  if (!compilation.model) return {};
  SearchOptions options;
  options.precision = compilation.model->precision;
  return compilation.model->problem->solve_all(options);
}

Result solved(const std::string& text) { return solved(read(text)); }

std::size_t count(const Result& result, Certificate certificate) {
  const auto& solutions = result.search->solutions;
  return static_cast<std::size_t>(
      std::count_if(solutions.begin(), solutions.end(),
                    [&](const Solution& solution) { return solution.certificate == certificate; }));
}

// The values of a scalar in the solutions.
std::vector<Interval> values_of(const Result& result, const std::string& name) {
  std::vector<Interval> values;
  for (const Solution& solution : result.search->solutions) {
    for (const ResultVariable& variable : solution.variables) {
      if (variable.name == name) values.push_back(std::get<Interval>(variable.domain));
    }
  }
  return values;
}

// y = text has the one solution.
void expect_value(const std::string& text, double expected, const std::string& before = "") {
  SCOPED_TRACE(text);
  const Result result = solved(
      before + "Variables y in [-1e6, 1e6]; one in [0, 2];\nConstraints\none = 1; y = " + text + ";\nend");
  if (!result.search) return;
  const auto values = values_of(result, "y");
  ASSERT_EQ(values.size(), 1U);
  EXPECT_TRUE((values[0] - Interval(expected)).contains(0.0) || std::abs(values[0].mid() - expected) < 1e-9)
      << to_string(values[0]);
  EXPECT_LT(values[0].width(), 1e-3);
}

TEST(Minibex, Precedence) {
  expect_value("-2^2", -4);
  expect_value("2^3^2", 64);
  expect_value("6/2*3", 9);
  expect_value("7 - 2 - 1", 4);
  expect_value("-2 + 5", 3);
  expect_value("+-+2", -2);
  expect_value("2*-3 + 1", -5);
  // A sign takes the whole product behind it, as in IBEX.
  expect_value("2^-1*3", 0.125);
  expect_value("6/-2*3", -1);
  expect_value("(1; 2)'*(3; 4)", 11);
  expect_value("2*(1, 2)'(1)", 2);
}

// The same of numbers and of expressions.
TEST(Minibex, Functions) {
  const std::vector<std::pair<std::string, double>> cases{
      {"abs(-3*one)", 3},
      {"sign(-3*one)", -1},
      {"sqr(3*one)", 9},
      {"sqrt(2*one)", std::sqrt(2)},
      {"exp(one)", std::exp(1)},
      {"ln(2*one)", std::log(2)},
      {"log(2*one)", std::log(2)},
      {"sin(one)", std::sin(1)},
      {"cos(one)", std::cos(1)},
      {"tan(one)", std::tan(1)},
      {"asin(one/2)", std::asin(0.5)},
      {"arccos(one/2)", std::acos(0.5)},
      {"atan(one)", std::atan(1)},
      {"arctan(one)", std::atan(1)},
      {"sinh(one)", std::sinh(1)},
      {"cosh(one)", std::cosh(1)},
      {"tanh(one)", std::tanh(1)},
      {"asinh(-2*one)", std::asinh(-2)},
      {"acosh(2*one)", std::acosh(2)},
      {"atanh(-one/2)", std::atanh(-0.5)},
      {"atan2(one, -2)", std::atan2(1, -2)},
      {"max(one, 2, 3*one)", 3},
      {"min(one, 2, -3*one)", -3},
      {"floor(2.5*one)", 2},
      {"ceil(2.5*one)", 3},
      {"chi(-one, 2, 3)", 2},
      {"chi(one, 2, 3)", 3},
      {"sinc(one)", std::sin(1)},
      {"sinc(0)", 1},
      {"pow(one + 1, 3)", 8},
      {"pow(one + 1, 0.5)", std::sqrt(2)},
      {"(-2*one)^(4/2)", 4},
      {"(-2*one)^-3", -0.125},
      {"(2*one)^-0.5", std::sqrt(0.5)},
      {"2^(3*one)", 8},
      {"(2*one)^0", 1},
      {"cross((one; 0; 0), (0; 1; 0))(3)", 1},
      {"trace(((1, 2); (3, 4)))(2)*one", 4},
  };
  for (const auto& [text, expected] : cases) {
    expect_value(text, expected);
    std::string known = text;
    for (auto at = known.find("one"); at != std::string::npos; at = known.find("one"))
      known.replace(at, 3, "1");
    expect_value(known, expected);
  }
}

TEST(Minibex, Numbers) {
  expect_value("60.", 60);
  expect_value(".5", 0.5);
  expect_value("1.e-3", 1e-3);
  expect_value("1e+2", 100);
  expect_value("#3ff8000000000000", 1.5);
  expect_value("pi", std::acos(-1));
  // A decimal is the real number that is written.
  const auto compilation =
      read("Variables x in [0, 1]; Constraints 10*0.1 = 1; 1e22 + 0.1 - 1e22 = 0.1; end");
  EXPECT_EQ(compilation.diagnostics.text(), "");
  EXPECT_EQ(compilation.model->problem->graph().contractors().size(), 0U);
}

TEST(Minibex, RangesOfNumbers) {
  expect_value("sum(i = 1:4, i^2*one)", 30);
  expect_value("prod(i = 1:4, i)", 24);
  expect_value("sum(i = 1:3, sum(j = 1:i, j))", 10);
  expect_value("sum(i = 2:1, i)", 0);
  expect_value("sum(i = 1:2, (i; 2*i))(2)", 6);
}

TEST(Minibex, VectorsAndMatrices) {
  const std::string constants =
      "Constants v[3] = (1; 2; 3); r[1][3] = (4, 5, 6); M[2][3] = ((1, 2, 3); (4, 5, 6)); s = 7; n = 2;\n";
  const std::vector<std::pair<std::string, double>> cases{
      {"v(2)", 2},           {"v[2]", 3},
      {"r(1)", 4},           {"r(1, 3)", 6},
      {"M(2, 3)", 6},        {"M(2)(1)", 4},
      {"M[0][1]", 2},        {"M(:, 2)(2)", 5},
      {"M(1, 2:3)(2)", 3},   {"M(1:n, 1)(n)", 4},
      {"M(:, :)(2, 2)", 5},  {"v(2:3)(1)", 2},
      {"s(1)", 7},           {"s[0]", 7},
      {"(r*v)", 32},         {"(M*v)(2)", 32},
      {"(v*r)(3, 3)", 18},   {"(v*v)", 14},
      {"(2*v - v/2)(2)", 3}, {"(M')(3, 2)", 6},
      {"-v(1)", -1},         {"(v; s)(4)", 7},
      {"(r, s)(4)", 7},      {"(v, v)(3, 2)", 3},
      {"(M; r)(3, 1)", 4},   {"(M, (s; s))(2, 4)", 7},
  };
  for (const auto& [text, expected] : cases) expect_value(text, expected, constants);
}

TEST(Minibex, Functions_OfTheFile) {
  const std::string functions =
      "Constants c = 10;\n"
      "function f(a, b[2]) return a*b; end\n"
      "function g(a) half = a/2; half2 = half/2; return (half; half2; f(a, (1; c))) end\n"
      "function h(c) c = c + 1; return c; end\n";
  expect_value("f(2*one, (3; 4))(2)", 8, functions);
  expect_value("g(8)(1)", 4, functions);
  expect_value("g(8)(2)", 2, functions);
  expect_value("g(8)(4)", 80, functions);
  expect_value("h(1) + c", 12, functions);
  // In the argument a function can stand that it calls itself.
  expect_value("h(h(h(one)))", 4, functions);
}

TEST(Minibex, VariablesAndTheirDomains) {
  const auto compilation = read(
      "Constants n = 3; d[3] in ([0, 1]; [1, 2]; 5);\n"
      "Variables x, y in [0, 1]; z; v[n] in d; M[2][n] in [-oo, 4], r[1][2] in ([0, 1], 2); a in [0, 2*pi];\n"
      "i integer in [0.5, 3];\nConstraints end");
  ASSERT_EQ(compilation.diagnostics.text(), "");
  EXPECT_EQ(compilation.types,
            "n : constant real\nd : constant interval[3]\nx : real\ny : real\nz : real\nv : real[3]\n"
            "M : real[2, 3]\nr : real[1, 2]\na : real\ni : int\n");
  const std::string unknowns = unknowns_of(*compilation.model);
  // Of x, y in [0, 1] the domain is that of y alone.
  EXPECT_THAT(unknowns, testing::HasSubstr("x: [-inf, inf]\ny: [0, 1]\nz: [-inf, inf]\n")) << unknowns;
  EXPECT_EQ(compilation.model->name, "system");
  EXPECT_EQ(compilation.model->precision, 1e-3);
  EXPECT_EQ(compilation.model->goal, SolveItem::Goal::all);
}

TEST(Minibex, VectorsAreVectorsInResults) {
  const Result result = solved(
      "Variables v[2] in [0, 9]; M[2][2] in [0, 9]; Constraints v = (1; 2); M = ((1, 2); (3, 4)); end");
  ASSERT_EQ(result.search->solutions.size(), 1U);
  const auto& variables = result.search->solutions[0].variables;
  ASSERT_EQ(variables.size(), 2U);
  EXPECT_EQ(std::get<Box>(variables[0].domain).dim(), 2);
  EXPECT_EQ(variables[1].shape.columns, 2U);
  EXPECT_TRUE(std::get<Box>(variables[1].domain)[2].contains(3.0));
}

TEST(Minibex, WholeNumbers) {
  const Result result = solved(
      "Variables i in [0, 3]; k int in [0, 9]; v[3] in [0, 9];\nConstraints\n"
      "integer(i); k = 3*i; for j = 1:2; integer(v(j)); end; v(1) = i; v(2) = 2*v(1); v(3) = v(2)/4; end");
  ASSERT_EQ(result.search->solutions.size(), 4U);
  EXPECT_EQ(values_of(result, "k")[3], Interval(9.0));
  EXPECT_EQ(values_of(result, "v[3]").size(), 4U);
  const Result sums = solved(
      "Variables x in [0, 1]; y in [0, 1]; Constraints x - y = 1/3; integer(x + y); x + y >= 0.9; end");
  ASSERT_GE(sums.search->solutions.size(), 1U);
  for (const Interval& x : values_of(sums, "x")) EXPECT_NEAR(x.mid(), 2.0 / 3, 1e-2);
}

TEST(Minibex, LoopsDefinitionsAndMemberships) {
  const Result result = solved(
      "Variables x[4] in [-10, 10];\nConstraints\n  x(1) = 1;\n  for i = 2:3;\n    step = i;\n"
      "    x(i) = x(i - 1) + step;\n  end;\n  step = 4;\n  (x(4) in [step, 4]);\nend");
  ASSERT_EQ(result.search->solutions.size(), 1U);
  EXPECT_EQ(count(result, Certificate::unique), 1U);
  const Box& x = std::get<Box>(result.search->solutions[0].variables[0].domain);
  EXPECT_TRUE(x[1].contains(3.0) && x[2].contains(6.0) && x[3].contains(4.0));
  // A name that is known on the left is compared.
  EXPECT_EQ(solved("Variables x in [0, 9]; Constraints a = x; a = 2; a = 3; end").status, Status::infeasible);
}

// An interval constant stands for any of its values; a certificate says more than that only if it holds for
// all of them.
TEST(Minibex, IntervalConstants) {
  const Result covered = solved("Variables x in [0, 10]; Constraints [1, 2]*x = 2; end");
  Interval all = Interval::empty();
  for (const Interval& x : values_of(covered, "x")) all = join(all, x);
  EXPECT_TRUE(all.contains(1.0) && all.contains(2.0));
  EXPECT_EQ(count(covered, Certificate::unique), 0U);
  // Each interval that is written is an unknown of its own, a name always the same.
  EXPECT_NE(solved("Variables x in [0.5, 2]; Constraints ([-1, 1]*x)*([-1, 1]*x) = -1; end").status,
            Status::infeasible);
  EXPECT_EQ(
      solved("Constants c in [-1, 1]; Variables x in [0.5, 2]; Constraints (c*x)*(c*x) = -1; end").status,
      Status::infeasible);
  EXPECT_NE(
      solved("Constants c[2] in [-1, 1]; Variables x in [0.5, 2]; Constraints (c(1)*x)*(c(2)*x) = -1; end")
          .status,
      Status::infeasible);
  const Result narrow = solved("Variables x in [0, 10]; Constraints x^2 = [2, 2.0000001]; end");
  ASSERT_EQ(narrow.search->solutions.size(), 1U);
  EXPECT_TRUE(values_of(narrow, "x")[0].contains(std::sqrt(2.00000005)));
  // A point is a number, and may be an exponent.
  expect_value("(-2)^[3, 3]", -8);
  expect_value("inf([1, 2]) + 10*mid([1, 2]) + 100*sup([1, 2])", 216);
}

TEST(Minibex, Goals) {
  const auto compilation =
      read("Variables x[2] in [0, 1]; Minimize x(1)^2 + x(2) Constraints x(1) = x(2); end");
  ASSERT_EQ(compilation.diagnostics.text(), "");
  EXPECT_EQ(compilation.model->goal, SolveItem::Goal::minimize);
  EXPECT_TRUE(compilation.model->objective.has_value());
}

TEST(Minibex, ConstantsAreReplaced) {
  CompileOptions options;
  options.parameters = {{"n", "2 + 1"}, {"c", "[2, 3]"}};
  const auto compilation =
      read("Constants n = 2; c in [0, 1]; Variables x[n] in c; Constraints x(n) = n; end", options);
  const Result result = solved(compilation);
  ASSERT_EQ(result.search->solutions.size(), 1U);
  EXPECT_EQ(std::get<Box>(result.search->solutions[0].variables[0].domain).dim(), 3);
}

TEST(Minibex, EndingsSayTheLanguage) {
  for (const std::string name : {"a.bch", "a.MBX", "b.c/a.txt"})
    EXPECT_TRUE(minibex::is_minibex(name)) << name;
  for (const std::string name : {"a.hcsp", "bch", "a.bch.hcsp"})
    EXPECT_FALSE(minibex::is_minibex(name)) << name;
}

// ---- Corpora.

TEST(Corpus, BadMinibexFilesGiveTheirDiagnostics) {
  for (const auto& file : models_in(kFiles / "bad", kEndings)) {
    SCOPED_TRACE(file.filename().string());
    const std::string text = read_text(file);
    const Compilation compilation = compile_text({file.filename().string(), text}, options_in(text));
    EXPECT_FALSE(compilation.model.has_value());
    compare(file, compilation.diagnostics.text());
    EXPECT_LE(compilation.diagnostics.count(), 3 * mistakes_in(text));
  }
}

TEST(Corpus, GoodMinibexFilesCompile) {
  for (const auto& file : models_in(kFiles / "good", kEndings)) {
    SCOPED_TRACE(file.filename().string());
    const std::string text = read_text(file);
    const Compilation compilation = compile_text({file.filename().string(), text}, options_in(text));
    EXPECT_EQ(compilation.diagnostics.text(), "");
    ASSERT_TRUE(compilation.model.has_value());
    std::string found = compilation.types + unknowns_of(*compilation.model);
    for (const auto& contractor : compilation.model->problem->graph().contractors())
      found += std::string(contractor->name()) + "\n";
    compare(file, found);
  }
}

// ---- Sizes.

double seconds_of(const std::string& text, bool compiles) {
  const auto start = std::chrono::steady_clock::now();
  const Compilation compilation = read(text);
  EXPECT_EQ(compilation.model.has_value(), compiles) << compilation.diagnostics.text().substr(0, 1000);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(Minibex, LargeFilesAreReadSoon) {
  constexpr double kSoon = 10.0;  // on a loaded machine; some 0.5 s alone
  constexpr std::size_t kMegabyte = 1'000'000;
  std::string many = "Variables x[1000] in [-10, 10];\nConstraints\n";
  for (int i = 0; many.size() < kMegabyte; ++i)
    many += fmt::format("x({}) + 2*x({})^2 - exp(x({})) = {};\n", i % 1000 + 1, i % 997 + 1, i % 991 + 1, i);
  EXPECT_LT(seconds_of(many + "end", true), kSoon);
  std::string one = "Variables x[1000] in [-10, 10];\nConstraints\n0";
  for (int i = 0; one.size() < kMegabyte; ++i) one += fmt::format(" + {}*x({})", i, i % 1000 + 1);
  EXPECT_LT(seconds_of(one + " = 1;\nend", true), kSoon);
  std::string locals = "Variables x in [-10, 10];\nConstraints\nt0 = x;\n";
  for (int i = 1; i < 20'000; ++i) locals += fmt::format("t{} = t{} + x*{};\n", i, i - 1, i);
  EXPECT_LT(seconds_of(locals + "t19999 = 1;\nend", true), kSoon);
}

TEST(Minibex, NothingMakesItHang) {
  constexpr double kSoon = 20.0;
  for (const char c : {'a', '(', '[', '-', '<', '\'', ';', '"', '\0', '\xFF', '1', '#', '/'})
    EXPECT_LT(seconds_of("Variables x;\nConstraints\n" + std::string(1'000'000, c), false), kSoon) << c;
  std::string chain = "function f0(x) return x; end\n";
  for (int i = 1; i < 5000; ++i) chain += fmt::format("function f{}(x) return f{}(x) + 1; end\n", i, i - 1);
  EXPECT_LT(seconds_of(chain + "Variables x; Constraints f4999(x) = 0; end", false), kSoon);
  std::string doubling = "function f0(x) return x; end\n";
  for (int i = 1; i < 40; ++i)
    doubling += fmt::format("function f{0}(x) return f{1}(x) + f{1}(x + 1); end\n", i, i - 1);
  EXPECT_LT(seconds_of(doubling + "Variables x; Constraints f39(x) = 0; end", false), kSoon);
  std::string unknown = "Variables x; Constraints\n";
  for (int i = 0; i < 10'000; ++i) unknown += fmt::format("local{0} = x + {0};\n", i);
  for (int i = 0; i < 10'000; ++i) unknown += fmt::format("x = nobody{};\n", i);
  EXPECT_LT(seconds_of(unknown + "end", false), kSoon);
  EXPECT_LT(seconds_of("Variables x[1000000]; y[1000000]; Constraints x*y' = 0; end", false), kSoon);
  EXPECT_LT(seconds_of("Variables x[100000]; Constraints sum(i = 1:1000, x)(1) = 0; end", false), kSoon);
}

}  // namespace
}  // namespace hcsp::lang
