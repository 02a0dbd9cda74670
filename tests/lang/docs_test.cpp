// SPDX-License-Identifier: Apache-2.0
// docs/language.md is true: its models compile, and it lists every diagnostic and every reserved word.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "corpus.h"
#include "lang/syntax/token.h"

namespace hcsp::lang {
namespace {

std::string page() { return read_text(std::filesystem::path(HCSP_SOURCE_DIR) / "docs" / "language.md"); }

TEST(Docs, ModelsCompile) {
  const std::string text = page();
  const std::string open = "```hcsp\n";
  std::size_t count = 0;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at + 1)) {
    const std::size_t begin = at + open.size();
    const std::string model = text.substr(begin, text.find("```", begin) - begin);
    EXPECT_EQ(compile_as("data/snippet.hcsp", model).diagnostics.text(), "");
    ++count;
  }
  EXPECT_GE(count, 5);
}

TEST(Docs, ListEveryDiagnostic) {
  const std::string text = page();
  for (const CatalogueEntry& e : catalogue()) {
    std::string message(e.format);
    for (std::size_t at = message.find("{}"); at != std::string::npos; at = message.find("{}")) {
      message.replace(at, 2, "...");
    }
    EXPECT_THAT(text, testing::HasSubstr(fmt::format("| {} | {} |", code_id(e.code), message)));
  }
}

TEST(Docs, ListEveryReservedWord) {
  const std::string text = page();
  for (const std::string& word : keywords()) EXPECT_THAT(text, testing::HasSubstr(fmt::format("`{}`", word)));
}

}  // namespace
}  // namespace hcsp::lang
