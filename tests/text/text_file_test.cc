// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/text_file.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class TextFileTest : public TemporaryFolder {
 protected:
  // ASCII text in units of several bytes, with or without a byte order mark.
  static std::string Encoded(const std::string& text, size_t bytes, bool is_big_endian,
                             bool has_mark) {
    std::string encoded;
    const auto append = [&](unsigned value) {
      std::string unit(bytes, '\0');
      unit[is_big_endian ? bytes - 1 : 0] = static_cast<char>(value & 0xFF);
      unit[is_big_endian ? bytes - 2 : 1] = static_cast<char>(value >> 8);
      encoded += unit;
    };
    if (has_mark) append(0xFEFF);
    for (const char c : text) append(static_cast<unsigned char>(c));
    return encoded;
  }
};

TEST_F(TextFileTest, NamesWideText) {
  for (const size_t bytes : {2, 4}) {
    for (const bool is_big_endian : {false, true}) {
      for (const bool has_mark : {true, false}) {
        if (bytes == 4 && is_big_endian && !has_mark) continue;  // begins with three zeros
        WriteText("list.txt", Encoded("1.5 rgb/1.png\r\n", bytes, is_big_endian, has_mark));
        EXPECT_THAT(MessageOf([&] { ReadTextLines(Path("list.txt")); }),
                    Names("list.txt", "UTF-16", "UTF-8"))
            << bytes << is_big_endian << has_mark;
      }
    }
  }
}

TEST_F(TextFileTest, SkipsByteOrderMarkAndLineEndsOfOtherSystems) {
  for (const char* text : {"\xEF\xBB\xBFone 1\r\ntwo 2\r\n", "one 1\rtwo 2\r", "one 1\ntwo 2"}) {
    WriteText("list.txt", text);
    const std::vector<TextLine> lines = ReadTextLines(Path("list.txt"));
    ASSERT_EQ(lines.size(), 2u) << text;
    EXPECT_THAT(lines[0].fields, ElementsAre("one", "1"));
    EXPECT_THAT(lines[1].fields, ElementsAre("two", "2"));
    EXPECT_EQ(lines[1].number, 2);
  }
}

TEST_F(TextFileTest, MessagesDoNotEndAtZeroBytes) {
  WriteText("list.txt", std::string("one\ntw\0o\n", 9));
  const TextLine line = ReadTextLines(Path("list.txt"))[1];
  EXPECT_THAT(MessageOf([&] { line.Fail("'" + line.fields[0] + "' is wrong; correct it"); }),
              Names("list.txt:2", "'tw?o'", "correct it"));
}

TEST(SplitFields, KeepsEmptyFieldsBetweenCommas) {
  EXPECT_THAT(SplitFields(" a\tb  c \r"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(SplitFields("a, b ,c,"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(SplitFields("a,,c , ,\r\n"), ElementsAre("a", "", "c"));
  EXPECT_THAT(SplitFields(",a b"), ElementsAre("", "a", "b"));
  EXPECT_THAT(SplitFields("1,5;2,5"), ElementsAre("1,5", "2,5"));
  EXPECT_THAT(SplitFields(" \t"), IsEmpty());
  EXPECT_THAT(SplitFields(",, ,"), IsEmpty());
}

}  // namespace
}  // namespace msc_vo
