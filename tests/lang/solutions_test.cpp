// SPDX-License-Identifier: Apache-2.0
// What models mean: a model of good/ that says, in comments at its top,
//   // solution: x = (1, sqrt(2))      a solution has these values; an expression of constants
//   // width: x <= 1e-6                the width of the answer, of its widest component
//   // solution: x(0.5) = exp(-0.5)    of a tube at a gate
//   // inside: A (1, 2)                the point is proven to be in the set
//   // outside: A (3, 3)               or not to be
//   // maybe: A (2, 2)                 neither
//   // volume: A 3.14 <= 0.5           the volume of the set is enclosed, within 0.5
//   // infeasible                      no solution exists, and that is found
//   // found: 4 unique                 of `solve all`: so many boxes have that certificate
//   // minimum: -17 +- 1e-6            of an optimisation: its bracket, no wider, meets -17 +- 1e-6
//   // minimum: none                   and nothing is feasible
//   // boundary: <= 0.018              of `solve pave`: the boundary's volume
//   // inside: 9.41 .. 9.43            of `solve pave`: what is proven to be inside has a volume between
//   these
// is solved, and its answer has to hold the solution and be no wider.
#include <gtest/gtest.h>

#include <regex>

#include "corpus.h"

namespace hcsp::lang {
namespace {

/// The tightest enclosures of a constant or a vector of constants.
std::vector<Interval> constants(const std::string& expression) {
  const bool is_vector = expression.starts_with("(");
  const std::size_t commas = static_cast<std::size_t>(std::count(expression.begin(), expression.end(), ','));
  for (std::size_t size = 1; size <= commas + 1; ++size) {
    const std::string type = size == 1 ? "real" : fmt::format("real[{}]", size);
    Compilation compilation = compile_text(
        {"solution",
         fmt::format("model m;\nvar v : {};\nconstraint v == {};\nsolve propagate;\n", type, expression)});
    if (!compilation.model) continue;
    const Result result = compilation.model->problem->propagate();
    if (const auto* real = std::get_if<Interval>(&result["v"])) return {*real};
    std::vector<Interval> values;
    const Box& box = std::get<Box>(result["v"]);
    for (Eigen::Index i = 0; i < box.dim(); ++i) values.push_back(box[i]);
    return values;
  }
  ADD_FAILURE() << "no constant: " << expression << (is_vector ? " (a vector)" : "");
  return {};
}

std::vector<Interval> answer(const Result& result, const std::string& name) {
  static const std::regex kAtInstant(R"(([^(]+)\(([^)]*)\))");
  std::smatch match;
  if (std::regex_match(name, match, kAtInstant)) {
    const auto& tube = std::get<Tube>(result[match[1].str()]);
    const auto gate = tube.line().gate_at(std::stod(match[2].str()));
    EXPECT_TRUE(gate.has_value()) << name;
    std::vector<Interval> values;
    for (std::size_t c = 0; gate && c < tube.dim(); ++c) values.push_back(tube.at(c, 2 * *gate));
    return values;
  }
  const Domain& domain = result[name];
  if (const auto* real = std::get_if<Interval>(&domain)) return {*real};
  std::vector<Interval> values;
  if (const auto* box = std::get_if<Box>(&domain)) {
    for (Eigen::Index i = 0; i < box->dim(); ++i) values.push_back((*box)[i]);
  } else if (const auto* tube = std::get_if<Tube>(&domain)) {
    for (std::size_t item = 0; item < tube->items(); ++item) {
      for (std::size_t c = 0; c < tube->dim(); ++c) values.push_back(tube->at(c, item));
    }
  }
  return values;
}

void expect_solution(const Result& result, const std::string& name, const std::string& value) {
  const std::vector<Interval> truth = constants(value), found = answer(result, name);
  ASSERT_EQ(truth.size(), found.size()) << name;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    // A constant that is no double lies within its enclosure, and may be outside of either end.
    const bool holds = truth[i].is_point() ? leq(truth[i], found[i]) : !meet(truth[i], found[i]).is_empty();
    EXPECT_TRUE(holds) << name << ", component " << i + 1 << ": " << to_string(truth[i]) << " is not in "
                       << to_string(found[i]);
  }
}

void expect_width(const Result& result, const std::string& name, double most) {
  for (const Interval& value : answer(result, name)) EXPECT_LE(value.width(), most) << name;
}

void expect_state(const Result& result, const std::string& set, const std::string& point, CellState state) {
  std::vector<double> at;
  for (const Interval& x : constants(point)) at.push_back(x.mid());
  EXPECT_EQ(std::get<SetInterval>(result[set]).at(at.data()), state) << set << " at " << point;
}

void expect_volume(const Result& result, const std::string& set, double volume, double width) {
  const auto& domain = std::get<SetInterval>(result[set]);
  EXPECT_LE(domain.lower_volume(), volume) << set;
  EXPECT_GE(domain.upper_volume(), volume) << set;
  EXPECT_LE(domain.upper_volume() - domain.lower_volume(), width) << set;
}

bool check_line(const Result& result, const std::string& line) {
  static const std::regex kSolution(R"(// solution: (.+?) = (.+))"), kWidth(R"(// width: (.+?) <= (\S+))"),
      kState(R"(// (inside|outside|maybe): (\S+) (.+))"), kVolume(R"(// volume: (\S+) (\S+) <= (\S+))");
  std::smatch match;
  if (std::regex_match(line, match, kSolution)) {
    expect_solution(result, match[1], match[2]);
  } else if (std::regex_match(line, match, kWidth)) {
    expect_width(result, match[1], std::stod(match[2]));
  } else if (std::regex_match(line, match, kState)) {
    expect_state(result, match[2], match[3],
                 match[1] == "inside"    ? CellState::inside
                 : match[1] == "outside" ? CellState::outside
                                         : CellState::unknown);
  } else if (std::regex_match(line, match, kVolume)) {
    expect_volume(result, match[1], std::stod(match[2]), std::stod(match[3]));
  } else if (line == "// infeasible") {
    EXPECT_EQ(result.status, Status::infeasible);
  } else {
    return false;
  }
  if (line != "// infeasible") {
    EXPECT_EQ(result.status, Status::contracted) << line;
  }
  return true;
}

// Contractors are inclusion-isotone: the fixed point is the same, bit for bit, in whatever order they run.
TEST(Solutions, AreTheSameInEveryOrder) {
  for (const auto& path : models_in(kLangTests / "good")) {
    SCOPED_TRACE(path.filename().string());
    const std::string text = read_text(path);
    Compilation compilation = compile_as("good/" + path.filename().string(), text, options_in(text));
    ASSERT_TRUE(compilation.model.has_value());
    PropagationOptions options;
    const Result declared = compilation.model->problem->propagate(options);
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      options.order = seed == 0 ? Order::reversed : Order::shuffled;
      options.seed = seed;
      const Result other = compilation.model->problem->propagate(options);
      ASSERT_EQ(other.status, declared.status);
      if (declared.status == Status::infeasible) continue;
      for (std::size_t v = 0; v < declared.variables.size(); ++v) {
        EXPECT_TRUE(other.variables[v].domain == declared.variables[v].domain)
            << declared.variables[v].name << ", order " << seed;
      }
    }
  }
}

TEST(Solutions, AreInTheAnswersOfGoodModels) {
  std::size_t checked = 0;
  for (const auto& path : models_in(kLangTests / "good")) {
    SCOPED_TRACE(path.filename().string());
    const std::string text = read_text(path);
    if (text.find("// solution: ") == std::string::npos && text.find("// infeasible") == std::string::npos &&
        text.find("// volume: ") == std::string::npos)
      continue;
    const Compilation compilation = compile_as("good/" + path.filename().string(), text, options_in(text));
    ASSERT_TRUE(compilation.model.has_value());
    const Result result = compilation.model->problem->propagate();
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line) && line.starts_with("//");)
      checked += check_line(result, line) ? 1 : 0;
  }
  EXPECT_GE(checked, 10U);
}

// The models that ask for all solutions, those of the gallery among them; `found` counts all that are
// certified.
TEST(Solutions, AreAllFoundAndCertified) {
  static const std::regex kFound(R"(// found: (\d+) (\w+))");
  std::size_t checked = 0;
  for (const char* folder : {"tests/lang/good", "models/gallery"}) {
    for (const auto& path : models_in(std::filesystem::path(HCSP_SOURCE_DIR) / folder)) {
      SCOPED_TRACE(path.filename().string());
      const std::string text = read_text(path);
      if (text.find("\n// found: ") == std::string::npos && !text.starts_with("// found: ")) continue;
      const Compilation compilation = compile_text({path.string(), text});
      ASSERT_TRUE(compilation.model.has_value()) << compilation.diagnostics.text();
      ASSERT_EQ(compilation.model->goal, SolveItem::Goal::all);
      SearchOptions options;
      options.precision = compilation.model->precision;
      options.threads = 2;
      const Result result = compilation.model->problem->solve_all(options);
      EXPECT_EQ(result.status, result.search->solutions.empty() ? Status::infeasible : Status::solved);
      std::map<std::string, std::size_t> found, stated;
      for (const Solution& solution : result.search->solutions)
        ++found[std::string(to_string(solution.certificate))];
      std::istringstream lines(text);
      std::smatch match;
      for (std::string line; std::getline(lines, line);) {
        if (std::regex_match(line, match, kFound)) stated[match[2]] = std::stoul(match[1]);
      }
      for (const auto& [certificate, count] : stated) EXPECT_EQ(found[certificate], count) << certificate;
      ++checked;
    }
  }
  EXPECT_GE(checked, 46U);
}

// The models that ask for a paving.
TEST(Solutions, ArePaved) {
  static const std::regex kBoundary(R"(// boundary: <= (\S+))"), kInside(R"(// inside: (\S+) \.\. (\S+))");
  std::size_t checked = 0;
  for (const char* folder : {"tests/lang/good", "models/gallery"}) {
    for (const auto& path : models_in(std::filesystem::path(HCSP_SOURCE_DIR) / folder)) {
      const std::string text = read_text(path);
      if (text.find("// boundary: ") == std::string::npos) continue;
      SCOPED_TRACE(path.filename().string());
      const Compilation compilation = compile_text({path.string(), text});
      ASSERT_TRUE(compilation.model.has_value()) << compilation.diagnostics.text();
      ASSERT_EQ(compilation.model->goal, SolveItem::Goal::pave);
      SearchOptions options;
      options.precision = compilation.model->precision;
      options.threads = 2;
      const Result result = compilation.model->problem->pave(compilation.model->paved, options);
      EXPECT_EQ(result.status, Status::solved);
      std::istringstream lines(text);
      std::smatch match;
      for (std::string line; std::getline(lines, line);) {
        if (std::regex_match(line, match, kBoundary)) {
          EXPECT_LE(result.paving->boundary_volume, std::stod(match[1]));
          ++checked;
        } else if (std::regex_match(line, match, kInside)) {
          EXPECT_GE(result.paving->inside_volume, std::stod(match[1]));
          EXPECT_LE(result.paving->inside_volume, std::stod(match[2]));
        }
      }
    }
  }
  EXPECT_GE(checked, 5U);
}

void expect_optimum(const CompiledModel& model, const std::string& middle, const std::string& radius) {
  SearchOptions options;
  options.precision = model.precision;
  options.threads = 2;
  const Result result = model.goal == SolveItem::Goal::minimize
                            ? model.problem->minimize(*model.objective, options)
                            : model.problem->maximize(*model.objective, options);
  if (middle == "none") {
    EXPECT_EQ(result.status, Status::infeasible);
    return;
  }
  EXPECT_EQ(result.status, Status::solved);
  const double optimum = std::stod(middle), most = std::stod(radius);
  EXPECT_FALSE(meet(*result.objective, Interval(optimum) + Interval(-most, most)).is_empty())
      << to_string(*result.objective);
  EXPECT_LE(result.objective->width(), 2 * most);
  EXPECT_EQ(result.search->solutions.front().certificate, Certificate::exists);
}

TEST(Solutions, OptimaAreBracketed) {
  static const std::regex kOptimum(R"(// (?:minimum|maximum): (\S+)(?: \+- (\S+))?)");
  std::size_t checked = 0;
  for (const char* folder : {"tests/lang/good", "models/gallery"}) {
    for (const auto& path : models_in(std::filesystem::path(HCSP_SOURCE_DIR) / folder)) {
      SCOPED_TRACE(path.filename().string());
      const std::string text = read_text(path);
      std::istringstream lines(text);
      std::smatch match;
      for (std::string line; std::getline(lines, line);) {
        if (!std::regex_match(line, match, kOptimum)) continue;
        const Compilation compilation = compile_text({path.string(), text});
        ASSERT_TRUE(compilation.model.has_value()) << compilation.diagnostics.text();
        ASSERT_TRUE(is_optimisation(compilation.model->goal));
        expect_optimum(*compilation.model, match[1], match[2]);
        ++checked;
        break;
      }
    }
  }
  EXPECT_GE(checked, 24U);
}

}  // namespace
}  // namespace hcsp::lang
