// SPDX-License-Identifier: Apache-2.0
#include "sim/os/csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/os/test/folder_test.hpp"

namespace halfway {
namespace {

using ::testing::HasSubstr;

class TableTest : public FolderTest {
 protected:
  Result<Table> read(const std::string& text) const { return read_csv(write("t.csv", text)); }
};

TEST_F(TableTest, ReadsQuotedValues) {
  const auto table = must(read("name,n,m\n\"a, \"\"b\"\"\",1.5,\r\nc,inf,-2\n"));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.text(0, "name"), "a, \"b\"");
  EXPECT_EQ(table.number(0, "n"), 1.5);
  EXPECT_EQ(table.number(0, "m"), std::nullopt);
  EXPECT_EQ(table.number(0, "name"), std::nullopt);
  EXPECT_EQ(table.number(1, "n"), std::nullopt);
  EXPECT_EQ(table.number(1, "m"), -2.0);
  EXPECT_EQ(table.text(1, "none"), "");
}

TEST_F(TableTest, WritesWhatItReads) {
  const Table table{{"name", "n"}, {{"", ""}, {"a, \"b\"", "1"}, {"\"", "inf"}}};
  const auto again = must(read(to_csv(table)));
  EXPECT_EQ(again.columns, table.columns);
  EXPECT_EQ(again.rows, table.rows);
}

TEST_F(TableTest, ErrorsNameTheLine) {
  EXPECT_THAT(read("a,b\n1,2\n1,2,3\n").error().message, HasSubstr("t.csv:3: has 3 values"));
  EXPECT_THAT(read("a,b\n\"1,2\n").error().message, HasSubstr("t.csv:2: "));
  EXPECT_THAT(read("").error().message, HasSubstr("t.csv:1: "));
  EXPECT_FALSE(read_csv(at("none.csv")));
}

}  // namespace
}  // namespace halfway
