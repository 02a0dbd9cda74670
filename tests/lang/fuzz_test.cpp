// SPDX-License-Identifier: Apache-2.0
// Mutations of the corpora: whatever the text, an answer or diagnostics, soon. The seed is fixed; a failure
// prints it.
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <regex>

#include "corpus.h"

namespace hcsp::lang {
namespace {

// HCSP_FUZZ_SEED=100000 lang_tests --gtest_filter=Fuzz.* starts from another seed.
unsigned first_seed() {
  const char* asked = std::getenv("HCSP_FUZZ_SEED");
  return asked == nullptr ? 0 : static_cast<unsigned>(std::strtoul(asked, nullptr, 10));
}

constexpr double kLongestSeconds = 20.0;  // of one text, on a loaded machine

std::size_t below(std::size_t n, std::mt19937& random) {
  return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
}

// Puts a word, a number or an operator of the text in the place of another: most of it still parses.
std::string exchanged(const std::string& text, std::mt19937& random) {
  const std::regex pattern("[A-Za-z_]+[A-Za-z_0-9]*|[0-9.]+|[-+*/^<>=!]+");
  const std::vector<std::smatch> tokens(std::sregex_iterator(text.begin(), text.end(), pattern), {});
  if (tokens.empty()) return text;
  const std::smatch& place = tokens[below(tokens.size(), random)];
  for (int attempt = 0; attempt < 100; ++attempt) {
    const std::string other = tokens[below(tokens.size(), random)].str();
    const bool same_sort = (std::isalpha(other[0]) != 0) == (std::isalpha(place.str()[0]) != 0) &&
                           (std::isdigit(other[0]) != 0) == (std::isdigit(place.str()[0]) != 0);
    if (same_sort && other != place.str()) {
      const auto at = static_cast<std::size_t>(place.position());
      return text.substr(0, at) + other + text.substr(at + place.str().size());
    }
  }
  return text;
}

std::string mutated(std::string text, std::mt19937& random, const std::vector<std::string>& others) {
  if (below(2, random) == 0) return exchanged(text, random);
  const std::size_t count = 1 + below(4, random);
  for (std::size_t i = 0; i < count && !text.empty(); ++i) {
    const std::size_t at = below(text.size(), random);
    switch (below(7, random)) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text[at] = static_cast<char>(below(256, random));
        break;
      case 2:
        text.erase(at, 1 + below(20, random));
        break;
      case 3:
        text.insert(at, text.substr(below(text.size(), random), 1 + below(40, random)));
        break;
      case 4: {
        const std::string& other = others[below(others.size(), random)];
        if (!other.empty()) text.insert(at, other.substr(below(other.size(), random), 1 + below(60, random)));
        break;
      }
      case 5:
        text.insert(at, std::string(1, "(){}[];:,|=+-*/^<>.\"\0\xFF"[below(23, random)]));
        break;
      default:
        text[at] = text[below(text.size(), random)];
        break;
    }
  }
  return text;
}

// Whether a mutant compiles; it does, or is told what is wrong, and in good time.
bool compiles_or_tells(ModelSource mutant) {
  const auto start = std::chrono::steady_clock::now();
  const Compilation compilation = compile_text(std::move(mutant));
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  EXPECT_EQ(compilation.model.has_value(), !compilation.diagnostics.any());
  EXPECT_EQ(compilation.diagnostics.text().empty(), compilation.model.has_value());
  EXPECT_LT(taken.count(), kLongestSeconds);
  return compilation.model.has_value();
}

TEST(Fuzz, MutatedModelsGiveAnAnswerOrDiagnostics) {
  std::vector<std::string> good;
  std::vector<std::string> texts;
  for (const auto& model : models_in(kLangTests / "good")) good.push_back(read_text(model));
  for (const auto& model : models_in(kLangTests / "bad")) texts.push_back(read_text(model));
  texts.insert(texts.end(), good.begin(), good.end());
  constexpr unsigned kRounds = 4000;
  unsigned compiled = 0;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(kLangTests);
  for (unsigned seed = first_seed(); seed < first_seed() + kRounds; ++seed) {
    std::mt19937 random(seed);
    const auto& origins = seed % 4 == 0 ? texts : good;
    const std::string text = mutated(origins[below(origins.size(), random)], random, texts);
    SCOPED_TRACE(fmt::format("seed {}:\n{}", seed, text));
    compiled += compiles_or_tells({"good/mutant.hcsp", text}) ? 1 : 0;
  }
  std::filesystem::current_path(before);
  // Mutants that are all broken at once would test the first line of the parser only.
  EXPECT_GT(compiled, kRounds / 20);
}

TEST(Fuzz, MutatedMinibexFilesGiveAnAnswerOrDiagnostics) {
  const std::vector<std::string> endings{".bch", ".mbx", ".txt"};
  std::vector<std::string> good;
  std::vector<std::string> texts;
  for (const auto& file : models_in(kLangTests / "minibex" / "good", endings))
    good.push_back(read_text(file));
  for (const auto& file : models_in(kLangTests / "minibex" / "bad", endings))
    texts.push_back(read_text(file));
  texts.insert(texts.end(), good.begin(), good.end());
  constexpr unsigned kRounds = 3000;
  unsigned compiled = 0;
  for (unsigned seed = first_seed(); seed < first_seed() + kRounds; ++seed) {
    std::mt19937 random(seed);
    const auto& origins = seed % 4 == 0 ? texts : good;
    const std::string text = mutated(origins[below(origins.size(), random)], random, texts);
    SCOPED_TRACE(fmt::format("seed {}:\n{}", seed, text));
    compiled += compiles_or_tells({"mutant.bch", text}) ? 1 : 0;
  }
  EXPECT_GT(compiled, kRounds / 20);
}

// What a fuzzer found that took new paths.
TEST(Fuzz, KeptInputsGiveAnAnswerOrDiagnostics) {
  std::size_t read = 0;
  for (const auto& file : std::filesystem::directory_iterator(kLangTests / "../fuzz/corpus")) {
    SCOPED_TRACE(file.path().filename().string());
    const Compilation compilation = compile_text({"model.hcsp", read_text(file.path())});
    EXPECT_EQ(compilation.diagnostics.text().empty(), compilation.model.has_value());
    ++read;
  }
  EXPECT_GE(read, 200U);
}

TEST(Fuzz, MutatedDataGiveAnAnswerOrDiagnostics) {
  std::vector<std::string> texts;
  for (const auto& file : std::filesystem::directory_iterator(kLangTests / "data")) {
    if (file.path().extension() == ".csv") texts.push_back(read_text(file.path()));
  }
  std::sort(texts.begin(), texts.end());
  const auto path = std::filesystem::temp_directory_path() / "hcsp_fuzz_data.csv";
  CompileOptions options;
  options.data_files["log"] = path.string();
  const std::string model = whole_model(
      "data log = csv(\"log.csv\");\ntime t in [0, 1] step 0.25;\n"
      "given z : tube real = sampled(log.t, log.range, 9) +- 0.1;\ngiven u : tube real = hold(log.t, "
      "2*log.range);");
  for (unsigned seed = first_seed(); seed < first_seed() + 3000; ++seed) {
    std::mt19937 random(seed);
    const std::string text = mutated(texts[seed % texts.size()], random, texts);
    SCOPED_TRACE(fmt::format("seed {}:\n{}", seed, text));
    std::ofstream(path, std::ios::binary) << text;
    const Compilation compilation = compile_text({"model.hcsp", model}, options);
    EXPECT_EQ(compilation.diagnostics.text().empty(), compilation.model.has_value());
  }
  std::filesystem::remove(path);
}

double seconds_of(const ModelSource& source, bool compiles) {
  const auto start = std::chrono::steady_clock::now();
  const Compilation compilation = compile_text(source);
  EXPECT_EQ(compilation.model.has_value(), compiles) << compilation.diagnostics.text().substr(0, 1000);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string model_of(int constraints) {
  std::string text = "model m;\nsolve propagate;\n";
  for (int i = 0; i < constraints; ++i) text += fmt::format("var x{} : real in [0, {}];\n", i, i + 1);
  for (int i = 1; i < constraints; ++i) {
    text += fmt::format("constraint x{} + 2*x{}^2 <= {} and x{} >= 0;\n", i, i - 1, i, i);
  }
  return text;
}

TEST(Fuzz, HugeTextsAreReadSoon) {
  EXPECT_LT(seconds_of({"some.hcsp", model_of(1000)}, true), kLongestSeconds);
  // The last constraint stops it before the Problem is built.
  const std::string many = model_of(10'000) + "constraint nobody == 1;\n";
  EXPECT_LT(seconds_of({"many.hcsp", many}, false), kLongestSeconds);
  for (const std::string& line :
       {std::string(10'000'000, 'a'), std::string(10'000'000, '('), std::string(10'000'000, '"'),
        std::string(10'000'000, '\0'), std::string(10'000'000, '\xFF'), std::string(10'000'000, '1'),
        "/*" + std::string(10'000'000, '*')}) {
    EXPECT_LT(seconds_of({"line.hcsp", line}, false), kLongestSeconds) << line.front();
  }
}

// A chain of definitions in either order, long enough to be no recursion.
TEST(Fuzz, LongChainsOfDefinitions) {
  std::string forward = "model m;\nlet a0 = 1;\n";
  for (int i = 1; i < 20'000; ++i) forward += fmt::format("let a{} = a{} + 1;\n", i, i - 1);
  EXPECT_EQ(compile_text({"forward.hcsp", forward + "solve propagate;"}).diagnostics.text(), "");
  std::string backward = "model m;\n";
  for (int i = 20'000; i > 0; --i) backward += fmt::format("let a{} = a{} + 1;\n", i, i - 1);
  EXPECT_TRUE(compile_text({"backward.hcsp", backward + "let a0 = 1;\nsolve propagate;"}).diagnostics.any());
}

}  // namespace
}  // namespace hcsp::lang
