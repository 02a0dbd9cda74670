// SPDX-License-Identifier: Apache-2.0
// docs/language.md is true: its models compile, and it lists every diagnostic and every reserved word; so is
// docs/minibex.md.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "corpus.h"
#include "lang/minibex/words.h"
#include "lang/syntax/token.h"

namespace hcsp::lang {
namespace {

std::string page(const std::string& name = "language.md") {
  return read_text(std::filesystem::path(HCSP_SOURCE_DIR) / "docs" / name);
}

// Compiles the snippets of a language; how many there are.
std::size_t compile_snippets(const std::string& text, const std::string& language, const std::string& name) {
  const std::string open = "```" + language + "\n";
  std::size_t count = 0;
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at + 1)) {
    const std::size_t begin = at + open.size();
    const std::string model = text.substr(begin, text.find("```", begin) - begin);
    EXPECT_EQ(compile_as(name, model).diagnostics.text(), "");
    ++count;
  }
  return count;
}

TEST(Docs, ModelsCompile) { EXPECT_GE(compile_snippets(page(), "hcsp", "data/snippet.hcsp"), 5); }

TEST(Docs, MinibexFilesCompile) {
  EXPECT_GE(compile_snippets(page("minibex.md"), "minibex", "data/snippet.bch"), 1);
}

TEST(Docs, ListEveryWordOfMinibex) {
  const std::string text = page("minibex.md");
  for (const minibex::Word& word : minibex::words()) {
    if (word.name.starts_with("arc")) continue;  // arcsin and so on
    EXPECT_THAT(text, testing::ContainsRegex(fmt::format("[` ]{}[`( ]", word.name)));
  }
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

// Links between pages, and from pages to files, lead somewhere.
TEST(Docs, LinksLeadToFiles) {
  const std::filesystem::path root = HCSP_SOURCE_DIR;
  std::vector<std::filesystem::path> pages{root / "README.md", root / "CONTRIBUTING.md"};
  for (const auto& entry : std::filesystem::directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  const std::regex link(R"(\]\(([^)#:\s]+)(#[^)]*)?\))");
  for (const std::filesystem::path& from : pages) {
    const std::string text = read_text(from);
    for (std::sregex_iterator found(text.begin(), text.end(), link); found != std::sregex_iterator();
         ++found) {
      EXPECT_TRUE(std::filesystem::exists(from.parent_path() / (*found)[1].str()))
          << from << ": " << (*found)[1];
    }
  }
}

}  // namespace
}  // namespace hcsp::lang
