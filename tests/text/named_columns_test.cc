// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/named_columns.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

class NamedColumnsTest : public TemporaryFolder {
 protected:
  NamedColumns Read(const std::string& text) const {
    WriteText("table.csv", text);
    return {Path("table.csv"), {"write it again", "correct the line"}};
  }
};

TEST_F(NamedColumnsTest, FindsColumnsByName) {
  const NamedColumns table = Read("Time, name, X\n1.5, a, -2\n\n# comment\n2.5, b, 3e2\n");
  ASSERT_EQ(table.num_rows(), 2u);
  EXPECT_EQ(table.Number(0, table.Column("time")), 1.5);
  EXPECT_EQ(table.Number(1, table.Column("x")), 300.0);
  EXPECT_TRUE(table.Has("name"));
  EXPECT_FALSE(table.Has("y"));
}

TEST_F(NamedColumnsTest, NamesFileLineAndFix) {
  EXPECT_THAT(MessageOf([&] { Read("# nothing\n"); }), Names("table.csv:1", "correct the line"));
  const NamedColumns table = Read("time,x\n1,2\n3\n4,5,6\n7,nan\n8,x1\n");
  EXPECT_THAT(MessageOf([&] { table.Column("y"); }), Names("table.csv:1", "'y'", "write it again"));
  EXPECT_THAT(MessageOf([&] { table.Number(1, 0); }), Names("table.csv:3", "2 columns", "found 1"));
  EXPECT_THAT(MessageOf([&] { table.Number(2, 0); }), Names("table.csv:4", "found 3", "correct"));
  EXPECT_THAT(MessageOf([&] { table.Number(3, 1); }), Names("table.csv:5", "nan", "column x"));
  EXPECT_THAT(MessageOf([&] { table.Number(4, 1); }), Names("table.csv:6", "x1", "column x"));
  EXPECT_THAT(MessageOf([&] { table.Fail(0, "wrong"); }), Names("table.csv:2", "wrong; correct"));
}

}  // namespace
}  // namespace msc_vo
