// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Times of images whose names only number them.

#include "msc_vo/datasets/image_times.h"

#include <filesystem>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

class ImageTimesTest : public TemporaryFolder {
 protected:
  static constexpr int kImages = 6;

  // Opens a folder with numbered images and a pose at each time.
  SequenceIndex Open(const std::vector<double>& poses) {
    for (int i = 0; i < kImages; ++i) {
      WriteColor(FormatText("rgb/%d.png", i));
      WriteDepth(FormatText("depth/%d.png", i));
    }
    std::string truth;
    for (const double time : poses) truth += FormatText("%.6f 0 0 0 0 0 0 1\n", time);
    WriteText("groundtruth.txt", truth);
    return OpenSequence(Folder());
  }
  static std::vector<double> Times(double first, double rate, int count = kImages) {
    std::vector<double> times;
    for (int i = 0; i < count; ++i) times.push_back(first + i / rate);
    return times;
  }
  static std::vector<double> StampsOf(const SequenceIndex& index) {
    std::vector<double> stamps;
    for (const SequenceEntry& entry : index.entries) stamps.push_back(entry.timestamp);
    return stamps;
  }
  std::vector<double> ReadTimes(const std::string& text) {
    WriteText("t.txt", text);
    return ReadTimesFile(Path("t.txt")).seconds;
  }
};

TEST_F(ImageTimesTest, ImagesWithoutTimesHaveThoseOfTheirPoses) {
  for (const auto& [first, rate] :
       {std::pair(0.0, 25.0), std::pair(1.0 / 30.0, 30.0), std::pair(1305031102.2, 15.0)}) {
    const SequenceIndex index = Open(Times(first, rate));
    EXPECT_THAT(StampsOf(index), testing::Pointwise(testing::DoubleNear(2e-6), Times(first, rate)));
    EXPECT_THAT(index.warnings, ElementsAre(Names("groundtruth.txt", FormatText("%g", rate))));
  }
}

// Names need not be in the order of the times.
TEST_F(ImageTimesTest, RowsWithNamesAreThoseOfTheseImages) {
  for (const char* name : {"ca", "ab", "be"}) {
    WriteColor(std::string("rgb/") + name + ".png");
    WriteDepth(std::string("depth/") + name + ".png");
  }
  WriteText("times.txt", "rgb/ca.png 1.0\nrgb/ab.png 1.1\nrgb/be.png 1.3\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_THAT(StampsOf(index), testing::ElementsAre(1.0, 1.1, 1.3));
  EXPECT_THAT(index.entries.front().color_path, testing::EndsWith("ca.png"));
  EXPECT_THAT(TimesOfImages(Path("times.txt"), {Path("rgb/ab.png"), Path("rgb/ca.png")}),
              testing::ElementsAre(1.1, 1.0));
  EXPECT_THROW(TimesOfImages(Path("times.txt"), {Path("rgb/xx.png")}), std::runtime_error);
}

TEST_F(ImageTimesTest, PosesAt30HertzConfirmTheTimes) {
  EXPECT_THAT(Open(Times(0.0, 30.0)).warnings, IsEmpty());
}

TEST_F(ImageTimesTest, OtherNumbersOfPosesDoNotGiveTheTimes) {
  const SequenceIndex index = Open(Times(0.0, 25.0, kImages + 1));
  EXPECT_DOUBLE_EQ(index.entries[1].timestamp, 1.0 / 30.0);
  EXPECT_THAT(index.warnings, ElementsAre(Names("groundtruth.txt", "7", "6", "times.txt")));
  EXPECT_THAT(index.ground_truth, IsEmpty());  // errors at assumed times would be wrong
}

TEST_F(ImageTimesTest, RowsAreThoseOfTheStreamBeforePairing) {
  const std::vector<double> times = Times(2.0, 10.0);
  Open(times);
  std::filesystem::remove(Path("depth/2.png"));
  const std::vector<double> paired = {2.0, 2.1, 2.3, 2.4, 2.5};
  const SequenceIndex by_truth = OpenSequence(Folder());
  EXPECT_THAT(StampsOf(by_truth), testing::Pointwise(testing::DoubleNear(2e-6), paired));
  std::string text;
  for (const double time : times) text += FormatText("%.3f\n", time);
  WriteText("times.txt", text);
  const SequenceIndex by_file = OpenSequence(Folder());
  EXPECT_THAT(StampsOf(by_file), testing::Pointwise(testing::DoubleNear(2e-6), paired));
  EXPECT_EQ(by_file.ground_truth.size(), times.size());
}

TEST_F(ImageTimesTest, RowsWithoutAPoseCount) {
  Open(Times(0.0, 10.0));
  WriteText("groundtruth.txt",
            "0.0 0 0 0 0 0 0 1\n0.1 nan nan nan nan nan nan nan\n0.2 0 0 0 0 0 0 0\n"
            "0.3 0 0 0 0 0 0 1\n0.4 0 0 0 0 0 0 1\n0.5 0 0 0 0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_NEAR(index.entries[5].timestamp, 0.5, 1e-9);
  EXPECT_EQ(index.ground_truth.size(), 4u);
}

TEST_F(ImageTimesTest, PosesWithoutStampsBelongToImagesInOrder) {
  Open(Times(0.0, 30.0));
  for (const char* row :
       {"0 0 0 0 0 0 1\n", "1 0 0 0 0 1 0 0 0 0 1 0\n", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"}) {
    std::string text;
    for (int i = 0; i < kImages; ++i) text += row;
    WriteText("groundtruth.txt", text);
    const SequenceIndex index = OpenSequence(Folder());
    ASSERT_EQ(index.ground_truth.size(), static_cast<size_t>(kImages));
    EXPECT_EQ(index.ground_truth[3].timestamp, index.entries[3].timestamp);
    EXPECT_THAT(index.warnings, ElementsAre(Names("groundtruth.txt", "order")));
    WriteText("groundtruth.txt", text + row);
    EXPECT_THAT(OpenSequence(Folder()).ground_truth, IsEmpty());
  }
}

TEST_F(ImageTimesTest, FilesWithoutPosesAreNoGroundTruth) {
  Open(Times(0.0, 30.0));
  WriteText("groundtruth.txt", "0 1 2\n1 2 3\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_THAT(index.ground_truth, IsEmpty());
  EXPECT_THAT(index.warnings, ElementsAre(Names("groundtruth.txt:1", "ground truth")));
  WriteText("groundtruth.txt", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n2 0 0 0 damaged\n");
  EXPECT_THAT(MessageOf([&] { OpenSequence(Folder()); }), Names("groundtruth.txt:3"));
}

TEST_F(ImageTimesTest, StreamsHaveTimesOfTheirOwn) {
  for (const char* file : {"rgb/timestamps.txt", "rgb_timestamps.txt", "timestamps.txt"}) {
    Open(Times(0.0, 30.0));
    std::filesystem::remove(Path("groundtruth.txt"));
    // Colour lost the image at 0.2, depth that at 0.4.
    WriteText(file, "time name\n0.0 a\n0.1 b\n0.3 c\n0.4 d\n0.5 e\n0.6 f\n");
    WriteText("depth/timestamps.txt", "0.0\n0.1\n0.2\n0.3\n0.5\n0.6\n");
    const SequenceIndex index = OpenSequence(Folder());
    EXPECT_THAT(StampsOf(index), ElementsAre(0.0, 0.1, 0.3, 0.5, 0.6)) << file;
    EXPECT_EQ(index.entries[2].depth_path, Path("depth/3.png"));
    std::filesystem::remove(Path(file));
  }
}

TEST_F(ImageTimesTest, WarnsOfAListThatIsNotUsed) {
  Open(Times(0.0, 30.0));
  WriteText("frame_list.csv", "frame,exposure\n0,5\n1,5\n2,5\n3,5\n4,5\n5,5\n");
  EXPECT_THAT(OpenSequence(Folder()).warnings, ElementsAre(Names("frame_list.csv", "6")));
}

TEST_F(ImageTimesTest, PosesOfEqualTimesDoNotGiveTheTimes) {
  EXPECT_DOUBLE_EQ(Open({0.0, 0.1, 0.1, 0.2, 0.3, 0.4}).entries[1].timestamp, 1.0 / 30.0);
}

TEST_F(ImageTimesTest, NumbersOfPosesMayBeginElsewhere) {
  EXPECT_THAT(Open({1, 2, 3, 4, 5, 6}).warnings, ElementsAre(Names("groundtruth.txt", "1 higher")));
  EXPECT_THAT(Open({0, 1, 2, 3, 4, 5}).warnings, IsEmpty());
}

TEST_F(ImageTimesTest, TakesTheTimesOfAFile) {
  for (const char* name : {"timestamps.txt", "times.txt"}) {  // the second one precedes
    const double rate = name[4] == 's' ? 10.0 : 20.0;
    std::string text;
    for (const double time : Times(5.0, rate)) text += FormatText("%.3f\n", time);
    WriteText(name, text);
    const SequenceIndex index = Open(Times(5.0, rate));
    EXPECT_DOUBLE_EQ(index.entries[1].timestamp, 5.0 + 1.0 / rate);
    EXPECT_THAT(index.warnings, IsEmpty());
  }
  WriteText("times.txt", "1\n2\n");
  EXPECT_THAT(Open(Times(0.0, 30.0)).warnings, Contains(Names("times.txt", "2", "6")));
}

TEST_F(ImageTimesTest, TimesMayFollowTheNumberOfTheLine) {
  EXPECT_THAT(ReadTimes("0 5.5\n1 5.6\n2 5.7\n"), ElementsAre(5.5, 5.6, 5.7));
  EXPECT_THAT(ReadTimes("0.5 0\n0.6 1\n"), ElementsAre(0.5, 0.6));
  EXPECT_THAT(ReadTimes("5500 a\n5533 b\n"), ElementsAre(5.5, 5.533));
  EXPECT_THAT(ReadTimes("7.966666667\n8.0\n8.33333333\n8.100000000\n"),
              ElementsAre(7.966666667, 8.0, 8.033333333, 8.1));
  EXPECT_THAT(MessageOf([&] { ReadTimes("1\nx\n"); }), Names("t.txt:2", "'x'"));
  EXPECT_THAT(MessageOf([&] { ReadTimes("1\n1\n"); }), Names("t.txt:2", "ascend"));
}

}  // namespace
}  // namespace msc_vo
