// SPDX-License-Identifier: Apache-2.0
// Golden corpora: every model of bad/ gives exactly the text of its .expected, every model of good/ compiles
// to what its .expected lists. tests/lang/accept.sh writes the files anew.
#include <gtest/gtest.h>

#include <cstdlib>

#include "corpus.h"
#include "solver/engine/slot.h"

namespace hcsp::lang {
namespace {

void compare(const std::filesystem::path& model, const std::string& found) {
  std::filesystem::path expected = model;
  expected.replace_extension(".expected");
  if (std::getenv("HCSP_ACCEPT") != nullptr) {
    std::ofstream(expected, std::ios::binary) << found;
    return;
  }
  EXPECT_EQ(read_text(expected), found) << "after a look at it, tests/lang/accept.sh accepts the change";
}

std::string describe(const Interval& domain) { return to_string(domain); }
std::string describe(const Box& domain) { return to_string(domain); }
std::string describe(const SetInterval& domain) {
  return fmt::format("set, precision {}, volume at most {}", domain.precision(), domain.upper_volume());
}
std::string describe(const Tube& domain) {
  constexpr std::size_t kShownItems = 50;
  std::string text = fmt::format("tube of {} items", domain.items());
  for (std::size_t item = 0; item < std::min(domain.items(), kShownItems); ++item) {
    const Interval span = domain.line().span(item);
    text += item % 2 == 0 ? fmt::format("\n    at {}:", span.lo())
                          : fmt::format("\n    ({}, {}):", span.lo(), span.hi());
    for (std::size_t c = 0; c < domain.dim(); ++c) text += " " + to_string(domain.at(c, item));
  }
  return text;
}

template <class D>
bool describe(const Slot& slot, std::string& text) {
  const auto* typed = dynamic_cast<const TypedSlot<D>*>(&slot);
  if (typed != nullptr) text += describe(typed->domain) + "\n";
  return typed != nullptr;
}

// The syntax tree, and the unknowns with what is known of them before solving.
std::string describe(const Compilation& compilation) {
  std::string text = dump(*compilation.tree);
  for (const auto& variable : compilation.model->problem->graph().variables()) {
    if (variable.hidden()) continue;
    text += fmt::format("{}: ", variable.name());
    const Slot& slot = variable.initial();
    const bool known = describe<Interval>(slot, text) || describe<Box>(slot, text) ||
                       describe<Tube>(slot, text) || describe<SetInterval>(slot, text);
    if (!known) text += "?\n";
  }
  return text;
}

TEST(Corpus, BadModelsGiveTheirDiagnostics) {
  for (const auto& model : models_in(kLangTests / "bad")) {
    SCOPED_TRACE(model.filename().string());
    const std::string text = read_text(model);
    const Compilation compilation = compile_as("bad/" + model.filename().string(), text, options_in(text));
    EXPECT_FALSE(compilation.model.has_value());
    EXPECT_TRUE(compilation.diagnostics.any());
    compare(model, compilation.diagnostics.text());
    // One mistake does not cascade. A model with several says how many.
    std::size_t mistakes = 1;
    if (const auto at = text.find("// mistakes: "); at != std::string::npos)
      mistakes = std::stoul(text.substr(at + std::string("// mistakes: ").size()));
    EXPECT_LE(compilation.diagnostics.count(), 3 * mistakes);
  }
}

TEST(Corpus, GoodModelsCompile) {
  for (const auto& model : models_in(kLangTests / "good")) {
    SCOPED_TRACE(model.filename().string());
    const std::string text = read_text(model);
    const Compilation compilation = compile_as("good/" + model.filename().string(), text, options_in(text));
    EXPECT_EQ(compilation.diagnostics.text(), "");
    ASSERT_TRUE(compilation.model.has_value());
    compare(model, describe(compilation));
  }
}

TEST(Corpus, ShippedModelsCompile) {
  for (const auto& model : models_in(std::filesystem::path(HCSP_SOURCE_DIR) / "models" / "slam")) {
    SCOPED_TRACE(model.filename().string());
    const Compilation compilation = compile_file(model.string());
    EXPECT_EQ(compilation.diagnostics.text(), "");
    EXPECT_TRUE(compilation.model.has_value());
  }
}

}  // namespace
}  // namespace hcsp::lang
