// SPDX-License-Identifier: Apache-2.0
// Golden corpora: every model of bad/ gives exactly the text of its .expected, every model of good/ compiles
// to what its .expected lists. tests/lang/accept.sh writes the files anew.
#include <gtest/gtest.h>

#include "corpus.h"

namespace hcsp::lang {
namespace {

// The syntax tree, and the unknowns with what is known of them before solving.
std::string describe(const Compilation& compilation) {
  return dump(*compilation.tree) + unknowns_of(*compilation.model);
}

TEST(Corpus, BadModelsGiveTheirDiagnostics) {
  for (const auto& model : models_in(kLangTests / "bad")) {
    SCOPED_TRACE(model.filename().string());
    const std::string text = read_text(model);
    const Compilation compilation = compile_as("bad/" + model.filename().string(), text, options_in(text));
    EXPECT_FALSE(compilation.model.has_value());
    EXPECT_TRUE(compilation.diagnostics.any());
    compare(model, compilation.diagnostics.text());
    EXPECT_LE(compilation.diagnostics.count(), 3 * mistakes_in(text));
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
