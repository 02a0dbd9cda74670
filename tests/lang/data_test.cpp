// SPDX-License-Identifier: Apache-2.0
// Numbers as they are written, and tables.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lang/data/column.h"
#include "lang/data/decimal.h"
#include "lang/data/table.h"

namespace hcsp::lang {
namespace {

Number number(const std::string& text) { return *Number::parse(text); }

TEST(Decimal, ReadsWhatIsWritten) {
  for (const char* text : {"0", "12", "+3", "-0.5", ".5", "1.", "1e3", "1.5E-3", "0.1e+2"}) {
    EXPECT_TRUE(Number::parse(text)) << text;
  }
  for (const char* text : {"", "+", ".", "1e", "1e+", "0x10", "nan", "inf", "1 2", "1,5", "--1", "1.2.3"}) {
    EXPECT_FALSE(Number::parse(text)) << text;
  }
}

TEST(Decimal, EnclosesTightly) {
  const Interval tenth = number("0.1").enclosure;
  EXPECT_EQ(tenth.hi(), 0.1);  // the double 0.1 is above one tenth
  EXPECT_EQ(tenth.lo(), std::nextafter(0.1, 0.0));
  EXPECT_TRUE(number("0.5").enclosure.is_point());
  EXPECT_EQ(number("1e400").enclosure.hi(), kInfinity);
  EXPECT_EQ(number("1e-400").enclosure, Interval(0.0, std::numeric_limits<double>::denorm_min()));
}

TEST(Decimal, ArithmeticIsExact) {
  EXPECT_EQ((number("0.1") + number("0.2")).nearest(), 0.3);
  EXPECT_EQ((number("1700000000.3") - number("1700000000")).nearest(), 0.3);
  EXPECT_EQ((number("0.1") * number("3")).enclosure, number("0.3").enclosure);
  EXPECT_EQ((number("1e20") + number("-1e20")).exact->as_int(), 0);
  EXPECT_EQ(number("2.50e1").exact->as_int(), 25);
  EXPECT_FALSE(number("2.5").exact->as_int());
  EXPECT_FALSE(number("3000000000").exact->as_int());
}

// Where digits no longer fit, results stay enclosures.
TEST(Decimal, OverflowsIntoIntervals) {
  const Number large = number("123456789012345678901234567890");
  const Number product = large * large;
  EXPECT_FALSE(product.exact);
  EXPECT_LE(product.enclosure.lo(), 1.524157875323883675e58);
  EXPECT_GE(product.enclosure.hi(), 1.524157875323883675e58);
  EXPECT_TRUE(Number::parse(std::string(500, '7')));
  EXPECT_TRUE((number("1e4000") * number("1e4000")).enclosure.hi() == kInfinity);
}

TEST(Decimal, AgreesWithDoublesOnRandomNumbers) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20'000; ++i) {
    const double a = std::ldexp(static_cast<double>(random() >> 11), static_cast<int>(random() % 80) - 100);
    const std::string text = fmt::format("{}", a);
    EXPECT_EQ(number(text).nearest(), a) << text;
    EXPECT_TRUE(number(text).enclosure.contains(a)) << text;
  }
}

struct Read {
  std::unique_ptr<Source> source;
  Diagnostics diagnostics;
  std::optional<Table> table;
};

std::unique_ptr<Read> table_of(const std::string& text) {
  auto result = std::make_unique<Read>();
  result->source = std::make_unique<Source>("t.csv", text);
  result->table = Table::read_csv(*result->source, result->diagnostics);
  return result;
}

TEST(Table, ReadsCells) {
  const auto read = table_of(
      "\xEF\xBB\xBF"
      "a, b ,\"c, \"\"d\"\"\"\r\n1,\" 2 \",\n\n 4 ,5,\"x\ny\"\n\n");
  ASSERT_TRUE(read->table) << read->diagnostics.text();
  const Table& table = *read->table;
  EXPECT_THAT(table.columns(), testing::ElementsAre("a", "b", "c, \"d\""));
  ASSERT_EQ(table.rows(), 2);
  EXPECT_EQ(table.cell(0, 1), "2");
  EXPECT_EQ(table.cell(0, 2), "");
  EXPECT_EQ(table.cell(1, 0), "4");
  EXPECT_EQ(table.cell(1, 2), "x\ny");
  EXPECT_EQ(table.line(0), 2);
  EXPECT_EQ(table.line(1), 4);
}

TEST(Table, TakesACommaAtTheEndOfALine) {
  const auto read = table_of("a,b\n1,2,\n3,4,,\n");
  ASSERT_TRUE(read->table);
  EXPECT_EQ(read->table->rows(), 2);
}

TEST(Column, NamesTheFirstWrongCellAndCountsTheOthers) {
  const auto read = table_of("a,b\n1,x\n2,y\n3,z\n");
  EXPECT_FALSE(convert_column(*read->table, 1, read->diagnostics));
  EXPECT_EQ(read->diagnostics.text(),
            "t.csv:2:3: error[E205]: column `b`: `x` is not a number\n  1,x\n    ^\n"
            "  2 more cells of the column are wrong\n");
}

TEST(Column, TellsBlanksAndMissingEchoes) {
  const auto read = table_of("a\n1\n\"\"\noo\n");
  const auto column = convert_column(*read->table, 0, read->diagnostics);
  ASSERT_TRUE(column);
  EXPECT_EQ(column->cells[0].kind, CellValue::Kind::number);
  EXPECT_EQ(column->cells[1].kind, CellValue::Kind::blank);
  EXPECT_EQ(column->cells[2].kind, CellValue::Kind::no_echo);
}

}  // namespace
}  // namespace hcsp::lang
