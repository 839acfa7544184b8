// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Pairs of images that are found by the names of their files, in all layouts without lists.

#include "msc_vo/datasets/name_pairing.h"

#include <filesystem>
#include <functional>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

class NamePairingTest : public TemporaryFolder {
 protected:
  using NameOf = std::function<std::string(int)>;

  // Writes images first..last-1 of both streams.
  void WriteColors(int first, int last, const NameOf& name_of) {
    for (int i = first; i < last; ++i) WriteColor(color_ + name_of(i) + ".png");
  }
  void WriteDepths(int first, int last, const NameOf& name_of) {
    for (int i = first; i < last; ++i) WriteDepth(depth_ + name_of(i) + ".png");
  }
  std::string Error() {
    return MessageOf([&] { OpenSequence(Folder()); });
  }

  std::string color_ = "rgb/";
  std::string depth_ = "depth/";
};

std::string Milliseconds(const char* prefix, int i, double delay = 0.0) {
  return FormatText("%s%.3f", prefix, 1305031102175.304 + 33.4 * i + delay);
}

TEST_F(NamePairingTest, PairsByTimesInAnyLayout) {
  for (const auto& [color, depth] : {std::pair("rgb/", "depth/"), std::pair("color/", "depth/"),
                                     std::pair("results/frame", "results/depth")}) {
    SCOPED_TRACE(color);
    std::filesystem::remove_all(Folder());
    color_ = color;
    depth_ = depth;
    if (color_ == "color/") WriteText("pose/readme.txt", "");  // ScanNet
    WriteColors(0, 20, [](int i) { return Milliseconds("_", i); });
    WriteDepths(10, 31, [](int i) { return Milliseconds("_", i, 8.0); });
    const SequenceIndex index = OpenSequence(Folder());
    ASSERT_EQ(index.entries.size(), 10u);
    EXPECT_NEAR(index.entries[0].timestamp, 1305031102.175304 + 0.334, 2e-6);
    EXPECT_NEAR(index.entries[9].depth_delay, 0.008, 2e-6);
  }
}

TEST_F(NamePairingTest, StreamsMayHaveTheirOwnUnits) {
  WriteColors(0, 20, [](int i) { return FormatText("c%.6f", 1305031102.0 + i / 30.0); });
  WriteDepths(0, 20, [](int i) { return FormatText("d%.0f", 1e6 * (1305031102.004 + i / 30.0)); });
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 20u);
  EXPECT_NEAR(index.entries[7].depth_delay, 0.004, 2e-6);
  EXPECT_THAT(index.warnings, Contains(Names("depth images", "microseconds")));
}

TEST_F(NamePairingTest, NeverPairsTimesByOrder) {
  WriteColors(0, 9, [](int i) { return Milliseconds("", i); });
  WriteDepths(0, 9, [](int i) { return std::to_string(i); });
  EXPECT_THAT(Error(), Names("1305031102.175", "frame numbers", "0", "8", "associations.txt"));
}

TEST_F(NamePairingTest, NeverPairsTimesOfDifferentClocksByOrder) {
  WriteColors(0, 9, [](int i) { return Milliseconds("", i); });
  WriteDepths(0, 9, [](int i) { return FormatText("%.3f", 81.5 + i / 30.0); });
  EXPECT_THAT(Error(), Names("1305031102.175", "81.500", "81.767"));
}

TEST_F(NamePairingTest, CountersPairTimesOfDifferentClocks) {
  WriteColors(0, 9, [](int i) { return Milliseconds(FormatText("%04d_", i).c_str(), i); });
  WriteDepths(2, 12, [](int i) { return FormatText("%04d_%.3f", i, 81.5 + i / 30.0); });
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 7u);
  EXPECT_NEAR(index.entries[0].timestamp, 1305031102.175304 + 2 * 0.0334, 2e-6);
  EXPECT_THAT(index.entries[0].depth_path, HasSubstr("0002_81.567"));
  EXPECT_EQ(index.entries[0].depth_delay, 0.0);
}

TEST_F(NamePairingTest, PairsNumbersByNumberIfTheyShareARange) {
  WriteColors(0, 30, [](int i) { return FormatText("img_%03d", i); });
  WriteDepths(10, 40, [](int i) { return FormatText("img_%03d", i); });
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 20u);
  EXPECT_THAT(index.entries[0].color_path, HasSubstr("img_010"));
  EXPECT_THAT(index.entries[0].depth_path, HasSubstr("img_010"));
  EXPECT_THAT(index.warnings, Contains(Names("10", "higher", "associations.txt")));
}

TEST_F(NamePairingTest, FailsIfOneCounterNumbersBothStreams) {
  WriteColors(0, 20, [](int i) { return std::to_string(2 * i); });
  WriteDepths(0, 20, [](int i) { return std::to_string(2 * i + 1); });
  EXPECT_THAT(Error(), Names("0", "38", "1", "39"));
}

TEST_F(NamePairingTest, PairsSeparateNumbersByOrderAndSaysSo) {
  WriteColors(0, 20, [](int i) { return std::to_string(i); });
  WriteDepths(0, 20, [](int i) { return std::to_string(1000 + i); });
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 20u);
  EXPECT_THAT(index.warnings, Contains(Names("order")));
  std::filesystem::remove(Path("depth/1007.png"));
  EXPECT_THAT(Error(), Names("20", "19", "associations.txt"));
  WriteDepth("depth/1020.png");  // as many, but not the same steps
  EXPECT_THAT(Error(), Names(Path("rgb"), Path("depth"), "associations.txt"));
}

TEST_F(NamePairingTest, PairsEqualNamesWithoutNumbers) {
  const auto letters = [](int i) { return std::string("img_") + static_cast<char>('a' + i); };
  WriteColors(1, 10, letters);
  WriteDepths(0, 9, letters);
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 8u);
  for (const SequenceEntry& entry : index.entries) {
    EXPECT_EQ(std::filesystem::path(entry.color_path).filename(),
              std::filesystem::path(entry.depth_path).filename());
  }
  EXPECT_THAT(index.warnings, testing::ElementsAre(Names("2", "name")));
}

TEST_F(NamePairingTest, HexadecimalNamesAreInAlphabeticalOrder) {
  const auto hex = [](int i) { return FormatText("%08x", 160 + 7 * i); };
  WriteColors(0, 40, hex);
  WriteDepths(0, 40, hex);
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 40u);
  for (int i = 0; i < 40; ++i) {
    EXPECT_EQ(index.entries[i].color_path, Path("rgb/" + hex(i) + ".png"));
    EXPECT_EQ(index.entries[i].depth_path, Path("depth/" + hex(i) + ".png"));
  }
}

TEST_F(NamePairingTest, ConstantStepsAreFramesUnlessOnlyTimesFit) {
  WriteColors(0, 20, [](int i) { return std::to_string(33 * i); });
  WriteDepths(0, 20, [](int i) { return std::to_string(33 * i); });
  const SequenceIndex frames = OpenSequence(Folder());
  EXPECT_NEAR(frames.entries.back().timestamp, 33 * 19 / 30.0, 1e-9);
  EXPECT_THAT(frames.warnings, Contains(Names("steps", "33")));

  std::filesystem::remove_all(Path("depth"));
  WriteDepths(0, 20, [](int i) { return std::to_string(33 * i + 7); });
  const SequenceIndex times = OpenSequence(Folder());
  ASSERT_EQ(times.entries.size(), 20u);
  EXPECT_NEAR(times.entries.back().timestamp, 0.033 * 19, 1e-9);
  EXPECT_NEAR(times.entries.back().depth_delay, 0.007, 1e-9);
}

TEST_F(NamePairingTest, FailsIfFewImagesHaveAPartner) {
  WriteColors(0, 30, [](int i) { return std::to_string(i); });
  WriteDepths(20, 50, [](int i) { return std::to_string(i); });
  EXPECT_THAT(Error(), Names("10", "30", "40", "partner"));
}

// Each stream may count its own images.
TEST_F(NamePairingTest, WarnsOfCountersWithoutAGapThatEndApart) {
  const auto plain = [](int i) { return std::to_string(i); };
  WriteColors(0, 20, plain);
  WriteDepths(0, 17, plain);
  const auto warns = Contains(Names("20", "17", "associations.txt"));
  EXPECT_THAT(OpenSequence(Folder()).warnings, warns);
  std::filesystem::remove(Path("depth/7.png"));  // the missing image has a number
  EXPECT_THAT(OpenSequence(Folder()).warnings, testing::Not(Contains(Names("associations.txt"))));
}

TEST_F(NamePairingTest, PlainCountersGiveNoWarning) {
  WriteColors(0, 20, [](int i) { return FormatText("frame-%06d.color", i); });
  WriteDepths(0, 20, [](int i) { return FormatText("frame-%06d.depth", i); });
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.entries.size(), 20u);
  EXPECT_THAT(index.warnings, IsEmpty());
}

}  // namespace
}  // namespace msc_vo
