// SPDX-License-Identifier: Apache-2.0
#include "solver/report/presentation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/solver/report/sample_result.h"

namespace hcsp {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string error_of(std::string_view text) {
  std::string error;
  EXPECT_FALSE(read_truth(text, sample::result(), error).has_value());
  return error;
}

TEST(Truth, ReadsEitherWayOfNamingComponents) {
  std::string error;
  const auto plain = read_truth("t,x1,x2,z,other\n0,1,2,3,a\n0.5,4,5,6,b\n", sample::result(), error);
  ASSERT_TRUE(plain) << error;
  EXPECT_THAT(plain->t, ElementsAre(0.0, 0.5));
  EXPECT_THAT(plain->tubes.at("x"), ElementsAre(ElementsAre(1.0, 2.0), ElementsAre(4.0, 5.0)));
  EXPECT_THAT(plain->tubes.at("z"), ElementsAre(ElementsAre(3.0), ElementsAre(6.0)));
  EXPECT_EQ(plain->tubes.size(), 2U);
  const auto indexed = read_truth("\xef\xbb\xbf x[2] ,\"x[1]\", t\r\n2,1,0\r\n\r\n", sample::result(), error);
  ASSERT_TRUE(indexed) << error;
  EXPECT_THAT(indexed->tubes.at("x"), ElementsAre(ElementsAre(1.0, 2.0)));
}

TEST(Truth, SaysWhatIsWrong) {
  EXPECT_THAT(error_of(""), HasSubstr("line 1"));
  EXPECT_THAT(error_of("x1,x2\n0,0\n"), HasSubstr("column t"));
  EXPECT_THAT(error_of("t,y\n0,0\n"), HasSubstr("no column names a tube"));
  EXPECT_THAT(error_of("t,x1,x2\n0,0,0\n1,a,0\n"), HasSubstr("line 3"));
  EXPECT_THAT(error_of("t,x1,x2\n0,0\n"), HasSubstr("line 2"));
  EXPECT_THAT(error_of("t,x1,x2\n0,0,nan\n"), HasSubstr("line 2"));
  EXPECT_THAT(error_of("t,x1,x2\n1,0,0\n0,0,0\n"), HasSubstr("increase"));
}

}  // namespace
}  // namespace hcsp
