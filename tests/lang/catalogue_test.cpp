// SPDX-License-Identifier: Apache-2.0
// The catalogue teaches by example; the examples have to be true.
#include "lang/catalogue.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corpus.h"

namespace hcsp::lang {
namespace {

// Examples of the command line are no models.
bool is_model(std::string_view example) { return !example.starts_with("hcsp-solve"); }

std::vector<std::string> codes_of(const std::string& items, const std::string& name) {
  std::vector<std::string> codes;
  const Compilation compilation = compile_as("data/" + name, whole_model(items));
  for (const Diagnostic& diagnostic : compilation.diagnostics.all())
    codes.push_back(code_id(diagnostic.code));
  return codes;
}

TEST(Catalogue, WrongExamplesGiveTheirCode) {
  for (const CatalogueEntry& e : catalogue()) {
    if (!is_model(e.wrong)) continue;
    EXPECT_THAT(codes_of(std::string(e.wrong), "wrong.hcsp"), testing::Contains(code_id(e.code))) << e.wrong;
  }
}

TEST(Catalogue, RightExamplesCompile) {
  for (const CatalogueEntry& e : catalogue()) {
    if (!is_model(e.right)) continue;
    EXPECT_THAT(codes_of(std::string(e.right), "right.hcsp"), testing::IsEmpty()) << code_id(e.code) << "\n"
                                                                                  << e.right;
  }
}

TEST(Catalogue, IsSortedAndComplete) {
  const auto all = catalogue();
  EXPECT_TRUE(
      std::is_sorted(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.code < b.code; }));
  for (const CatalogueEntry& e : all) {
    EXPECT_EQ(&entry(e.code), &e);
    EXPECT_FALSE(e.format.empty() || e.explanation.empty() || e.wrong.empty() || e.right.empty())
        << code_id(e.code);
  }
}

TEST(Catalogue, PagesAreFoundHoweverTheCodeIsWritten) {
  const std::string page = explanation_page("E101");
  EXPECT_THAT(page, testing::StartsWith("E101: `...` is not declared"));
  EXPECT_EQ(explanation_page("e101"), page);
  EXPECT_EQ(explanation_page("101"), page);
  EXPECT_EQ(explanation_page("E999"), "");
  EXPECT_EQ(explanation_page("unknown"), "");
  EXPECT_EQ(explanation_page(""), "");
}

// Every code is somewhere in the corpus, so that its text is tested.
TEST(Catalogue, EveryCodeHasABadModel) {
  std::string corpus;
  for (const auto& model : models_in(kLangTests / "bad")) {
    std::filesystem::path expected = model;
    corpus += read_text(expected.replace_extension(".expected"));
  }
  for (const CatalogueEntry& e : catalogue()) {
    EXPECT_NE(corpus.find("error[" + code_id(e.code) + "]"), std::string::npos)
        << code_id(e.code) << " " << e.format;
  }
}

}  // namespace
}  // namespace hcsp::lang
