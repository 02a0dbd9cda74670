// SPDX-License-Identifier: Apache-2.0
// The models of motion along a line: each with a goal compiles, and is solved as its header says, with the
// values that its parameters come with and with others.
#include <gtest/gtest.h>

#include <regex>

#include "corpus.h"
#include "lang/online.h"

namespace hcsp::lang {
namespace {

const std::filesystem::path kStraightLine =
    std::filesystem::path(HCSP_SOURCE_DIR) / "models" / "straight_line";

std::string path_of(const std::string& name) { return (kStraightLine / (name + ".hcsp")).string(); }

// The motion that is found takes so long, and none is proven to be much faster.
void expect_bracket(CompiledProblem& problem, double optimum, double most) {
  EXPECT_EQ(problem.solve(), OnlineStatus::solved) << problem.reason();
  ASSERT_TRUE(problem.has_solution());
  EXPECT_LE(problem.objective().lo(), optimum + most) << to_string(problem.objective());
  EXPECT_NEAR(problem.objective().hi(), optimum, most) << to_string(problem.objective());
  EXPECT_LE(problem.objective().width(), 2 * most);
}

TEST(StraightLineModels, AreSolvedAsTheirHeadersSay) {
  static const std::regex kOptimum(R"(// minimum: (\S+) \+- (\S+))");
  std::size_t checked = 0;
  for (const auto& path : models_in(kStraightLine)) {
    SCOPED_TRACE(path.filename().string());
    std::istringstream lines(read_text(path));
    std::smatch match;
    for (std::string line; std::getline(lines, line);) {
      if (!std::regex_match(line, match, kOptimum)) continue;
      CompiledProblem problem = hcsp::compile(path.string());
      expect_bracket(problem, std::stod(match[1]), std::stod(match[2]));
      ++checked;
    }
  }
  EXPECT_GE(checked, 9U);
}

// The general search, of which the compiled problem gives the first solution, proves the same bracket.
TEST(StraightLineModels, AreSolvedBySearchToo) {
  for (const auto& [name, optimum] :
       {std::pair("type1", 2.5), {"type2", 2.5}, {"type3", 2.6}, {"type4", 2.6}, {"type5", 2.6}}) {
    SCOPED_TRACE(name);
    const Compilation compilation = compile_file(path_of(name));
    ASSERT_TRUE(compilation.model.has_value()) << compilation.diagnostics.text();
    SearchOptions options;
    options.precision = compilation.model->precision;
    const Result result = compilation.model->problem->minimize(*compilation.model->objective, options);
    EXPECT_EQ(result.status, Status::solved);
    EXPECT_TRUE(result.objective->contains(optimum)) << to_string(*result.objective);
    EXPECT_LE(result.objective->width(), 1e-9);
  }
}

TEST(StraightLineModels, AreRefutedBySearchToo) {
  for (const std::string crooked : {"v0=(.5,.5,.5)", "vmax=(1,-1,1)", "vmax=(1,0,1)", "tol=-1"}) {
    SCOPED_TRACE(crooked);
    CompileOptions options;
    const std::size_t sign = crooked.find('=');
    options.parameters[crooked.substr(0, sign)] = crooked.substr(sign + 1);
    const Compilation compilation = compile_file(path_of("type5"), options);
    ASSERT_TRUE(compilation.model.has_value()) << compilation.diagnostics.text();
    EXPECT_EQ(compilation.model->problem->minimize(*compilation.model->objective).status, Status::infeasible);
  }
}

using Numbers = std::vector<double>;

class Motion {
 public:
  explicit Motion(const std::string& type, std::size_t joints)
      : problem_(compile(path_of(type), options(joints))) {}
  Motion& with(const std::string& name, const Numbers& values) {
    EXPECT_TRUE(problem_.set(problem_.parameter(name), values)) << name;
    return *this;
  }
  CompiledProblem& problem() { return problem_; }
  void expect(double optimum) { expect_bracket(problem_, optimum, 1e-9); }
  void expect_infeasible(const std::string& reason) {
    EXPECT_EQ(problem_.solve(), OnlineStatus::infeasible);
    EXPECT_EQ(problem_.reason().substr(0, reason.size()), reason);
  }

 private:
  static CompileOptions options(std::size_t joints) {
    CompileOptions options;
    options.parameters = {{"K", std::to_string(joints)}, {"p1", "zeros(K)"}};
    return options;
  }
  CompiledProblem problem_;
};

TEST(StraightLineModels, KnownOptima) {
  Motion motion("type3", 2);
  motion.with("p1", {1, 1})
      .with("vmax", {1, 10})
      .with("amax", {50, 50})
      .with("jmax", {1000, 20})
      .expect(1.4472135955);
  // Nothing to do.
  motion.with("p1", {0, 0}).expect(0);
  // A joint that does not move bounds nothing.
  motion.with("p1", {1, 0})
      .with("jmax", {1000, 1e-3})
      .with("amax", {50, 1e-3})
      .expect(1 + 2 * std::sqrt(1e-3));
}

// In the last phase of jerk a motion is told in many ways, all of them as fast; what the state's last bits
// make of it is within its play.
TEST(StraightLineModels, PlansInTheLastPhaseAreTheFastest) {
  Motion motion("type3", 3);
  CompiledProblem& problem = motion.problem();
  const std::vector<Numbers> ways{{0.7, -0.9, 0.4}, {-0.31, 0.2, 1.1}, {0.05, 0.013, -0.08}};
  for (const Numbers& way : ways) {
    for (int i = 1; i < 12; ++i) {
      motion.with("p0", {0, 0, 0}).with("v0", {0, 0, 0}).with("a0", {0, 0, 0}).with("p1", way);
      ASSERT_EQ(problem.solve(), OnlineStatus::solved);
      const double end = problem.objective().hi(), last = problem.value(problem.variable("tau"))[9].lo();
      const double left = last * i / 12.0;
      const auto at = [&](const char* tube, std::size_t k) {
        return problem.value(problem.tube(tube)).at(k, Interval(end - left)).mid();
      };
      Numbers p0, v0, a0;
      for (std::size_t k = 0; k < 3; ++k) {
        const double rho = problem.value(problem.variable("rho"))[k].mid();
        p0.push_back(at("p", k));
        v0.push_back(rho * at("w", 0));
        a0.push_back(rho * at("b", 0));
      }
      motion.with("p0", p0).with("v0", v0).with("a0", a0);
      EXPECT_EQ(problem.solve(), OnlineStatus::solved) << left;
      EXPECT_LT(problem.boxes(), 300U);
      EXPECT_LE(problem.objective().width(), 1e-8);
      EXPECT_NEAR(problem.objective().hi(), left, 1e-6);
    }
  }
}

// From -0.5, at the limit, and accelerating, back to -0.5 and braking: the halves of a motion without a peak
// of velocity would be of no length.
TEST(StraightLineModels, ReturnsToTheLimitOfVelocity) {
  Motion motion("type5", 1);
  motion.with("vmax", {0.5}).with("amax", {0.5}).with("jmax", {7.75}).with("v0", {-0.5}).with("v1", {-0.5});
  motion.with("a0", {0.25}).with("a1", {-0.25}).with("p1", {-1.75});
  CompiledProblem& problem = motion.problem();
  EXPECT_EQ(problem.solve(), OnlineStatus::solved);
  EXPECT_LE(problem.objective().width(), 1e-9);
  EXPECT_NEAR(problem.objective().hi(), 3.50071476245993, 1e-9);
}

// From w = 3 with limits of 1: to 1 in 0.5 s and 1 m, by an acceleration of 4; the rest of 3 m at 1, and to
// rest.
TEST(StraightLineModels, BrakeFromBeyondTheLimits) {
  Motion motion("type1", 1);
  motion.with("v0", {3}).with("vmax", {1}).with("amax", {4}).with("p1", {3}).expect(0.5 + 1.875 + 0.25);
  // Past the target: 1.125 m to rest, and back 0.125 m.
  motion.with("p1", {1}).expect(0.75 + 2 * std::sqrt(0.125 / 4));
}

TEST(StraightLineModels, LimitsHaveADirection) {
  Motion motion("type2", 1);
  motion.with("vmin", {-0.5}).with("vmax", {2}).with("amin", {-1}).with("amax", {4}).with("p1", {-1});
  motion.expect(0.5 + (1 - 0.125 - 0.03125) / 0.5 + 0.125);
  motion.with("v1", {-0.6}).expect_infeasible("target");
  motion.with("v1", {-0.5}).expect(0.5 + (1 - 0.125) / 0.5);
}

// From 0.5 with limits of 1 and 2: 0.25 s and 0.1875 m less than from rest; a joint that waits takes as long
// as it is told.
TEST(StraightLineModels, OneJointWaitsForTheOthers) {
  CompiledProblem joint = hcsp::compile(path_of("one_joint"));
  joint.set(joint.parameter("jmax"), 1e6);  // as good as none
  joint.set(joint.parameter("v0"), 0.5);
  expect_bracket(joint, 2 + 0.25 + 0.5 - 0.25 - 0.1875, 1e-5);
  const std::vector<double> least{4.0, 40.0};
  for (const double T : least) {
    joint.set(joint.parameter("least"), T);
    expect_bracket(joint, T, 1e-9);
    const PolynomialTube& p = joint.value(joint.tube("p"));
    EXPECT_NEAR(p.at(0, Interval(T)).mid(), 2.0, 1e-9);
  }
  joint.set(joint.parameter("a0"), 3.0);
  EXPECT_EQ(joint.solve(), OnlineStatus::infeasible);
  EXPECT_EQ(joint.reason(), "acceleration");
}

// The optimum with limits of jerk only is a lower bound, and what is told comes close to it.
TEST(StraightLineModels, ALowerBoundOfEveryMotionIsTold) {
  Motion motion("type8", 2), relaxed("type5", 2);
  for (const double way : {0.02, 0.3, 4.0}) {
    for (const double start : {-0.4, 0.0, 0.5}) {
      for (const double acceleration : {-0.3, 0.0, 0.3}) {
        for (Motion* of : {&motion, &relaxed}) {
          of->with("p1", {way, -2 * way}).with("vmax", {1, 1}).with("amax", {2, 3}).with("jmax", {20, 15});
          of->with("v0", {0.5 * start, -start}).with("a0", {0.5 * acceleration, -acceleration});
          of->problem().solve();
        }
        CompiledProblem &own = motion.problem(), &other = relaxed.problem();
        ASSERT_TRUE(own.has_solution() && other.has_solution());
        const Interval bound = own.value(own.variable("T_lower"))[0];
        EXPECT_LE(bound.lo(), other.objective().hi()) << way << ' ' << start << ' ' << acceleration;
        EXPECT_LE(bound.lo(), own.objective().hi());
        if (start == 0.0 && acceleration == 0.0) {
          EXPECT_GE(bound.lo(), 0.999 * other.objective().hi());
        }
      }
    }
  }
  motion.with("v0", {1, -2}).problem().solve();
  EXPECT_EQ(motion.problem().value(motion.problem().variable("T_lower"))[0], Interval(0));
}

TEST(StraightLineModels, TellWhatBreaksTheLine) {
  Motion motion("type5", 3);
  motion.with("p1", {1, 2, 0.5}).with("v0", {0.1, 0.2, 0.05}).with("a1", {0.1, 0.2, 0.05001});
  motion.problem().solve();
  EXPECT_EQ(motion.problem().status(), OnlineStatus::infeasible);
  EXPECT_EQ(motion.problem().reason().substr(0, 4), "d_a1") << motion.problem().reason();
}

}  // namespace
}  // namespace hcsp::lang
