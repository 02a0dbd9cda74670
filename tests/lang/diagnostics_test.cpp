// SPDX-License-Identifier: Apache-2.0
#include "lang/diagnostics.h"

#include <gtest/gtest.h>

#include "lang/nearest.h"

namespace hcsp::lang {
namespace {

std::string shown(const std::string& text, std::uint32_t begin, std::uint32_t end) {
  const Source source("f", text);
  Diagnostics diagnostics;
  diagnostics.report(Code::not_constant, {&source, begin, end});
  return diagnostics.text();
}

TEST(Diagnostics, PointAtTheRange) {
  EXPECT_EQ(shown("ab\ncde f\n", 4, 6), "f:2:2: error[E114]: this has to be a constant\n  cde f\n   ^~\n");
  EXPECT_EQ(shown("ab", 2, 2), "f:1:3: error[E114]: this has to be a constant\n  ab\n    ^\n");
  EXPECT_EQ(shown("ab\r\ncd", 0, 9), "f:1:1: error[E114]: this has to be a constant\n  ab\n  ^~\n");
  EXPECT_EQ(shown("\n", 0, 0), "f:1:1: error[E114]: this has to be a constant\n");
}

TEST(Diagnostics, CountCodePointsAndKeepTabs) {
  EXPECT_EQ(shown("\xC3\xA9\tx", 3, 4),
            "f:1:3: error[E114]: this has to be a constant\n  \xC3\xA9\tx\n   \t^\n");
  EXPECT_EQ(shown("\xFFx", 1, 2), "f:1:2: error[E114]: this has to be a constant\n  \xEF\xBF\xBDx\n   ^\n");
}

TEST(Diagnostics, ShowAPartOfALongLine) {
  const std::string text = shown(std::string(1000, ' ') + "x" + std::string(1000, ' '), 1000, 1001);
  EXPECT_LT(text.size(), 400);
  EXPECT_NE(text.find("..."), std::string::npos);
}

TEST(Diagnostics, AreSortedByPlaceAndCounted) {
  const Source source("f", std::string(200, 'x'));
  Diagnostics diagnostics;
  for (std::uint32_t i = 100; i > 0; --i) diagnostics.report(Code::not_constant, {&source, i, i + 1});
  const std::string text = diagnostics.text();
  EXPECT_EQ(text.find("f:1:2: "), 0);
  EXPECT_NE(text.find("50 more errors\n"), std::string::npos);
}

TEST(Nearest, FindsWhatWasMeant) {
  const std::vector<std::string> names{"speed", "heading", "x", "delta"};
  EXPECT_EQ(nearest_name("sped", names), "speed");
  EXPECT_EQ(nearest_name("detla", names), "delta");
  EXPECT_EQ(nearest_name("Heading", names), "heading");
  EXPECT_EQ(nearest_name("X", names), "x");
  EXPECT_EQ(nearest_name("y", names), std::nullopt);
  EXPECT_EQ(nearest_name("range", names), std::nullopt);
  EXPECT_EQ(nearest_name(std::string(100'000, 'a'), names), std::nullopt);
}

}  // namespace
}  // namespace hcsp::lang
