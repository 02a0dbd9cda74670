// SPDX-License-Identifier: Apache-2.0
// A search that is killed at any moment goes on from its checkpoint, and gives the answer of one that was
// not. HCSP_FULL=1 kills 50 times a model, otherwise 5.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "corpus.h"

namespace hcsp::lang {
namespace {

namespace fs = std::filesystem;

class Resume : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("hcsp_resume_{}", getpid());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  // Runs the model; kills it after a while, unless that is 0. The exit status, or -1.
  int run(std::vector<std::string> further, std::chrono::microseconds killed_after = {}) const {
    const std::string program = (fs::path(HCSP_BINARY_DIR) / "lang" / "hcsp-solve").string();
    std::vector<std::string> words{program, (fs::path(HCSP_SOURCE_DIR) / "models" / GetParam()).string(),
                                   "--quiet"};
    words.insert(words.end(), further.begin(), further.end());
    const pid_t child = fork();
    if (child == 0) {
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      execv(program.c_str(), arguments.data());
      _exit(127);
    }
    if (killed_after.count() > 0) {
      std::this_thread::sleep_for(killed_after);
      kill(child, SIGKILL);
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  [[nodiscard]] nlohmann::json answer(const std::string& file) const {
    nlohmann::json result = nlohmann::json::parse(read_text(folder_ / file));
    for (const char* of_the_run : {"statistics", "hcsp"}) result.erase(of_the_run);
    return result;
  }
  [[nodiscard]] std::string path(const std::string& file) const { return (folder_ / file).string(); }

  fs::path folder_;
};

TEST_P(Resume, AfterAKillTheAnswerIsThatOfAWholeRun) {
  const auto started = std::chrono::steady_clock::now();
  ASSERT_EQ(run({"-o", path("whole.json")}), 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - started;
  const unsigned seed = 1;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.02, 1.0);
  const int kills = std::getenv("HCSP_FULL") != nullptr ? 50 : 5;
  for (int k = 0; k < kills; ++k) {
    std::ofstream(path("state")).close();  // as the run itself makes it, before anything else
    const auto moment = std::chrono::microseconds(static_cast<long>(1e6 * part(random) * whole.count()));
    run({"--checkpoint", path("state"), "--threads", k % 2 == 0 ? "1" : "2"}, moment);
    ASSERT_EQ(run({"--resume", path("state"), "-o", path("resumed.json")}), 0)
        << "seed " << seed << ", kill " << k;
    EXPECT_EQ(answer("resumed.json"), answer("whole.json")) << "seed " << seed << ", kill " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Models, Resume,
                         testing::Values("gallery/neurophysiology.hcsp", "gallery/robust_control.hcsp"));

}  // namespace
}  // namespace hcsp::lang
