// SPDX-License-Identifier: Apache-2.0
// hcsp-solve as a person meets it: what it prints, what it writes, and its exit status.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "corpus.h"

namespace hcsp::lang {
namespace {

using testing::HasSubstr;

struct Finished {
  int status;
  std::string text;  // of both outputs
};

class Tool : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(std::filesystem::exists(program_)) << "build hcsp-solve first: " << program_;
    folder_ = std::filesystem::temp_directory_path() / fmt::format("hcsp_tool_{}", getpid());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Finished run(const std::string& arguments) const {
    const std::string command =
        fmt::format("cd '{}' && '{}' {} 2>&1", folder_.string(), program_.string(), arguments);
    FILE* pipe = popen(command.c_str(), "r");
    Finished result{-1, ""};
    char buffer[4096];
    for (std::size_t n = 0; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) result.text.append(buffer, n);
    const int status = pclose(pipe);
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return result;
  }
  std::string model(const std::string& items) const {
    std::ofstream(folder_ / "model.hcsp") << whole_model(items);
    return "model.hcsp";
  }
  [[nodiscard]] std::string text_of(const std::string& name) const { return read_text(folder_ / name); }

  const std::filesystem::path program_ = std::filesystem::path(HCSP_BINARY_DIR) / "lang" / "hcsp-solve";
  std::filesystem::path folder_;
};

const char* const kCircle =
    "param r = 1;\nvar x, y : real in [0, 10];\nconstraint circle: x^2 + y^2 == r^2;\nshow y;";

TEST_F(Tool, SolvesAndSummarises) {
  const Finished result = run(model(kCircle));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.text, HasSubstr("m: contracted in "));
  EXPECT_THAT(result.text, HasSubstr("\n  y  [0, 1]\n"));
  EXPECT_THAT(result.text, testing::Not(HasSubstr("\n  x")));
}

TEST_F(Tool, QuietPrintsNothing) { EXPECT_EQ(run(model(kCircle) + " --quiet").text, ""); }

TEST_F(Tool, WritesEveryFormat) {
  const Finished result = run(model("time t in [0, 1] step 0.5;\nvar x : tube real in [0, 1];\n"
                                    "var M : set real[2] in [-1, 1]^2 precision 0.5;") +
                              " -o a.json -o b.csv -o c.svg -o d.html --trace e.json --graph f.dot --quiet");
  EXPECT_EQ(result.status, 0) << result.text;
  EXPECT_EQ(nlohmann::json::parse(text_of("a.json"))["model"], "m");
  EXPECT_THAT(text_of("b.csv"), testing::StartsWith("t_lo,t_hi"));
  EXPECT_THAT(text_of("c.svg"), HasSubstr("<svg"));
  EXPECT_THAT(text_of("d.html"), HasSubstr("<html"));
  EXPECT_TRUE(nlohmann::json::accept(text_of("e.json")));
  EXPECT_THAT(text_of("f.dot"), HasSubstr("graph"));
}

TEST_F(Tool, ReplacesParameters) {
  EXPECT_THAT(run(model(kCircle) + " --set r=0.5").text, HasSubstr("\n  y  [0, 0.5]\n"));
  EXPECT_THAT(run(model(kCircle) + " --set 'r=[1, 2]'").text, HasSubstr("\n  y  [0, 2]\n"));
  const Finished wrong = run(model(kCircle) + " --set radius=0.5");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_THAT(wrong.text, HasSubstr("--set radius:1:1: error[E119]: the model has no param `radius`"));
}

TEST_F(Tool, SaysWhatIsWrongWithTheModel) {
  const Finished result = run(model("var speed : real;\nconstraint sped == 1;"));
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(
      result.text,
      "model.hcsp:3:12: error[E101]: `sped` is not declared\n  constraint sped == 1;\n             ^~~~\n"
      "  did you mean `speed`?\n");
  EXPECT_EQ(run("none.hcsp").text, "error[E011]: cannot read `none.hcsp`: no such file\n");
  EXPECT_EQ(run("none.hcsp").status, 1);
}

TEST_F(Tool, ReadsFilesOfIbex) {
  std::ofstream(folder_ / "pair.bch") << "Constants n = 2;\nVariables x[n] in [-9, 9];\n"
                                         "Constraints\n  x(1) + x(2) = 3; x(1) - x(2) = 1;\nend\n";
  const Finished solved = run("pair.bch -o pair.json");
  EXPECT_EQ(solved.status, 0);
  EXPECT_THAT(solved.text, HasSubstr("pair: solved in "));
  EXPECT_THAT(solved.text, HasSubstr("1 box: 1 unique"));
  EXPECT_EQ(nlohmann::json::parse(text_of("pair.json"))["solutions"].size(), 1U);
  EXPECT_EQ(run("pair.bch --check").text, "");
  EXPECT_EQ(run("pair.bch --dump types").text, "n : constant real\nx : real[2]\n");
  EXPECT_THAT(run("pair.bch --dump graph").text, HasSubstr("label=\"line 4\""));
  EXPECT_THAT(run("pair.bch --set n=3").text, HasSubstr("1 box: 1 exists"));
  EXPECT_EQ(run("pair.bch --set n=1").status, 1);
  EXPECT_EQ(run("pair.bch --format").status, 2);
  EXPECT_EQ(run("pair.bch --dump ast").status, 2);
}

TEST_F(Tool, ExplainsInfeasibility) {
  const Finished result = run(model("var x : real in [0, 1];\nconstraint far: x >= 2;") + " -o a.json");
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.text, HasSubstr("infeasible"));
  EXPECT_THAT(result.text, HasSubstr("no solution: `far` leaves nothing of `x`"));
  EXPECT_EQ(nlohmann::json::parse(text_of("a.json"))["status"], "infeasible");
}

TEST_F(Tool, StopsAtALimitWithWhatItHas) {
  const auto slam = std::filesystem::path(HCSP_SOURCE_DIR) / "models" / "slam" / "slam.hcsp";
  const Finished result = run(slam.string() + " --time-limit 1e-9 -o a.json");
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(nlohmann::json::parse(text_of("a.json"))["status"], "limit");
}

TEST_F(Tool, NamesTheReadingsInConflict) {
  std::ofstream(folder_ / "log.csv") << "t,range\n0,1\n0.5,9\n1,1\n";
  const Finished result =
      run(model("data log = csv(\"log.csv\");\ntime t in [0, 1] step 0.5;\nvar x : tube real;\n"
                "given z : tube real = sampled(log.t, log.range) +- 0.1;\n"
                "var v : tube real in [-1, 1];\n"
                "constraint motion: der(x) == v;\nconstraint seen: x == z;"));
  EXPECT_EQ(result.status, 0);
  EXPECT_THAT(result.text, HasSubstr("jointly inconsistent: 2 readings"));
  EXPECT_THAT(result.text, HasSubstr("z(0.5)  log.csv:3 column range"));
}

TEST_F(Tool, ChecksWithoutSolving) {
  const Finished good = run(model(kCircle) + " --check");
  EXPECT_EQ(good.status, 0);
  EXPECT_EQ(good.text, "");
  EXPECT_EQ(run(model("var x : real") + " --check").status, 1);
}

TEST_F(Tool, DumpsPhases) {
  EXPECT_THAT(run(model(kCircle) + " --dump ast").text,
              HasSubstr("(constraint circle (== (+ (^ x 2) (^ y 2)) (^ r 2)))"));
  EXPECT_THAT(run(model(kCircle) + " --dump graph").text, HasSubstr("circle"));
  EXPECT_EQ(run(model(kCircle) + " --dump types").text, "r : real\nx : real\ny : real\n");
}

TEST_F(Tool, RefusesOptionsThatAPavingHasNoUseFor) {
  const std::string name = model("var x : real in [0, 2];\nconstraint x <= 1;\nsolve pave(x) precision 0.5;");
  EXPECT_EQ(run(name + " --precision 0.25").status, 0);
  for (const char* const option : {" --order best", " --bisector round-robin"}) {
    const Finished result = run(name + option);
    EXPECT_EQ(result.status, 2) << option;
    EXPECT_THAT(result.text, HasSubstr("`solve pave` cuts all boxes")) << option;
  }
}

TEST_F(Tool, RefusesWrongUsage) {
  const std::string name = model(kCircle);
  for (const std::string& arguments : {std::string(),
                                       std::string("--no-such-option"),
                                       name + " --threads 0",
                                       name + " --threads two",
                                       name + " --time-limit -1",
                                       name + " --time-limit nan",
                                       name + " --memory-limit inf",
                                       name + " -o result",
                                       name + " -o result.txt",
                                       name + " --set r",
                                       name + " --set =1",
                                       name + " --graph g.png",
                                       name + " --format -o x.json",
                                       name + " --precision 0.1",
                                       name + " --memory-limit 0",
                                       name + " --checkpoint c",
                                       name + " --resume c",
                                       name + " --bisector largest",
                                       name + " --order depth",
                                       name + " " + name,
                                       std::string("--explain E999")}) {
    const Finished result = run(arguments);
    EXPECT_EQ(result.status, 2) << arguments;
    EXPECT_THAT(result.text, testing::StartsWith("hcsp-solve: ")) << arguments;
  }
}

// A covering of the sphere, which has no end in reasonable time.
const char* const kSphere = "var x, y, z : real in [-1, 1];\nconstraint s: x^2 + y^2 + z^2 == 1;\n";

TEST_F(Tool, StopsASearchAtALimitWithWhatItHas) {
  const std::string name = model(std::string(kSphere) + "solve all precision 1e-4;");
  for (const char* limit : {" --memory-limit 30", " --time-limit 0.05"}) {
    const Finished result = run(name + limit + " -o limit.json");
    EXPECT_EQ(result.status, 3) << limit;
    EXPECT_THAT(result.text, HasSubstr("unexplored: "));
    const auto answer = nlohmann::json::parse(text_of("limit.json"));
    EXPECT_EQ(answer["status"], "limit");
    EXPECT_FALSE(answer["unexplored"].empty());
  }
}

TEST_F(Tool, GoesOnFromACheckpoint) {
  const std::string name = model(std::string(kSphere) + "solve all precision 0.3;");
  const Finished whole = run(name);
  ASSERT_EQ(run(name + " --checkpoint c --resume c").status, 0);  // there is none yet
  const Finished resumed = run(name + " --resume c");
  const auto without_time = [](const std::string& text) { return text.substr(text.find('\n')); };
  EXPECT_EQ(without_time(resumed.text), without_time(whole.text));
  const Finished other = run(name + " --precision 0.2 --resume c");
  EXPECT_EQ(other.status, 1);
  EXPECT_THAT(other.text, HasSubstr("--resume c: the checkpoint is of another model"));
  EXPECT_EQ(run(name + " --resume no_such_file").status, 1);
}

TEST_F(Tool, SaysThatItCannotWrite) {
  const Finished result = run(model(kCircle) + " -o no/such/folder/a.json");
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.text, "hcsp-solve: cannot write no/such/folder/a.json\n");
}

TEST_F(Tool, PrintsPages) {
  EXPECT_THAT(run("--help").text, HasSubstr("--time-limit S"));
  EXPECT_EQ(run("--help").status, 0);
  EXPECT_THAT(run("--version").text, testing::StartsWith("hcsp-solve "));
  EXPECT_THAT(run("--explain E101").text, testing::StartsWith("E101: "));
}

TEST_F(Tool, PlansStraightLines) {
  const std::string folder = (std::filesystem::path(HCSP_SOURCE_DIR) / "models" / "straight_line").string();
  const Finished plan = run(folder + "/type3.hcsp --set K=2 --set 'p1=(1,1)' --set 'vmax=(1,10)' " +
                            "--set 'amax=(50,50)' --set 'jmax=(1000,20)' -o plan.csv -o plan.json");
  EXPECT_EQ(plan.status, 0);
  EXPECT_THAT(plan.text, HasSubstr("objective in [1.44721359549"));
  const std::string csv = text_of("plan.csv");
  EXPECT_THAT(csv, testing::StartsWith("segment,joint,start,end,p0,p1,p2,p3,v0,v1,v2,a0,a1,j0,start.lo"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 10 * 2);
  EXPECT_THAT(csv, testing::Not(HasSubstr(",-0,")));
  const auto json = nlohmann::json::parse(text_of("plan.json"));
  EXPECT_EQ(json["status"], "solved");
  EXPECT_EQ(json["segments"].size(), 10U * 2U);
  const Finished crooked = run(folder + "/type3.hcsp --set 'v0=(0.5,0.5,0.5)'");
  EXPECT_THAT(crooked.text, HasSubstr("refuted by `d_v0[1, 2]`"));
  const Finished beyond = run(folder + "/type5.hcsp --set 'v1=(1.2,2.4,0.6)'");
  EXPECT_THAT(beyond.text, HasSubstr("refuted by `target`"));
  EXPECT_EQ(run(folder + "/type3.hcsp --set 'vmax=(1,1)'").status, 1) << "of another size";
  for (const char* limits : {"vmax=(0,1)", "amax=(-1,1)", "jmax=(0,1)"}) {
    const Finished stuck = run(folder + "/time_synchronised.hcsp --set '" + limits + "'");
    EXPECT_THAT(stuck.text, HasSubstr("refuted by `limits[1]`")) << limits;
  }
}

TEST_F(Tool, ReadsATruth) {
  std::ofstream(folder_ / "truth.csv") << "t,x\n0,0\n1,1\n";
  std::ofstream(folder_ / "bad.csv") << "t,x\n0,zero\n";
  const std::string name = model("time t in [0, 1] step 0.5;\nvar x : tube real in [0, 1];");
  EXPECT_EQ(run(name + " -o a.svg --truth truth.csv").status, 0);
  EXPECT_EQ(run(name + " -o a.svg --truth bad.csv").status, 1);
  EXPECT_EQ(run(name + " -o a.svg --truth none.csv").status, 1);
}

}  // namespace
}  // namespace hcsp::lang
