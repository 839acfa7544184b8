// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// TUM-style folders: image lists, association files, frame numbers.

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/image_pairing.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class TumSequenceTest : public TemporaryFolder {
 protected:
  std::string ErrorOf() {
    return MessageOf([&] { OpenSequence(Folder()); });
  }
  static std::vector<double> Stamps(const SequenceIndex& index) {
    std::vector<double> stamps;
    for (const SequenceEntry& entry : index.entries) stamps.push_back(entry.timestamp);
    return stamps;
  }
};

TEST_F(TumSequenceTest, PairsByNearestTime) {
  WriteText("rgb.txt", "# colour\n1.00 rgb/a.png\n1.03 rgb/b.png\n1.06 rgb/c.png\n");
  WriteText("depth.txt", "1.01 depth/a.png\r\n1.035\tdepth/b.png\r\n1.2 depth/c.png\r\n");
  WriteText("groundtruth.txt", "0.99 1 2 3 0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder() + "///");
  EXPECT_EQ(index.format, "tum");
  EXPECT_EQ(index.directory, Folder());
  EXPECT_THAT(Stamps(index), ElementsAre(1.00, 1.03));
  EXPECT_EQ(index.entries[0].color_path, Path("rgb/a.png"));
  EXPECT_EQ(index.entries[1].depth_path, Path("depth/b.png"));
  EXPECT_THAT(index.entries[0].origin, HasSubstr("rgb.txt:2"));
  EXPECT_NEAR(index.entries[0].depth_delay, 0.01, 1e-9);
  EXPECT_NEAR(index.entries[1].depth_delay, 0.005, 1e-9);
  ASSERT_EQ(index.ground_truth.size(), 1u);
  EXPECT_EQ(index.ground_truth[0].timestamp, 0.99);
  EXPECT_THAT(index.warnings, ElementsAre(Names("1", "3", "ms")));
}

TEST_F(TumSequenceTest, PairsOneToOneClosestFirst) {
  WriteText("rgb.txt", "1.00 a\n1.01 b\n");
  WriteText("depth.txt", "1.012 x\n");
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 1u);
  EXPECT_EQ(index.entries[0].color_path, Path("b"));
}

TEST_F(TumSequenceTest, PairsWithNextNearestIfNearestIsTaken) {
  WriteText("rgb.txt", "1.00 a\n1.01 b\n");
  WriteText("depth.txt", "0.99 w\n1.009 x\n");
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 2u);
  EXPECT_EQ(index.entries[0].depth_path, Path("w"));
  EXPECT_EQ(index.entries[1].depth_path, Path("x"));
}

TEST_F(TumSequenceTest, PairsUnsynchronisedImagesAtAnyRate) {
  for (const double rate : {5.0, 15.0, 30.0, 60.0}) {
    const double delay = 0.45 / rate;
    std::string color, depth;
    for (int i = 0; i < 20; ++i) {
      color += FormatText("%.6f rgb/%d.png\n", i / rate, i);
      depth += FormatText("%.6f depth/%d.png\n", i / rate + delay, i);
    }
    WriteText("rgb.txt", color);
    WriteText("depth.txt", depth);
    const SequenceIndex index = OpenSequence(Folder());
    EXPECT_EQ(index.entries.size(), 20u) << rate;
    EXPECT_THAT(index.warnings, IsEmpty()) << rate;
    for (const SequenceEntry& entry : index.entries) {
      EXPECT_NEAR(entry.depth_delay, delay, 2e-6) << rate;
    }
  }
}

TEST(MaxPairDifference, FollowsFromTheFasterCamera) {
  for (const double rate : {28.0, 30.0, 60.0, 1000.0})
    EXPECT_EQ(MaxPairDifference(1.0 / rate), 0.02);
  EXPECT_NEAR(MaxPairDifference(1.0 / 15.0), 0.0367, 1e-4);
  EXPECT_NEAR(MaxPairDifference(1.0 / 5.0), 0.11, 1e-9);
  EXPECT_EQ(MaxPairDifference(10.0), 0.15);
  const std::vector<ListedImage> slow = {{0.0, "", ""}, {0.2, "", ""}, {0.4, "", ""}};
  const std::vector<ListedImage> fast = {{0.0, "", ""}, {1.0 / 15, "", ""}, {2.0 / 15, "", ""}};
  EXPECT_DOUBLE_EQ(MaxPairDifference(ImageLists{slow, fast}), MaxPairDifference(1.0 / 15.0));
  EXPECT_DOUBLE_EQ(MaxPairDifference(ImageLists{fast, slow}), MaxPairDifference(1.0 / 15.0));
  EXPECT_EQ(MaxPairDifference(ImageLists{}), 0.02);
}

TEST_F(TumSequenceTest, KeepsDelaysOfSlowAssociations) {
  std::string rows;
  for (int i = 0; i < 4; ++i)
    rows += FormatText("%.2f rgb/%d %.2f depth/%d\n", 0.2 * i, i, 0.2 * i + 0.09, i);
  WriteText("associations.txt", rows);
  for (const SequenceEntry& entry : OpenSequence(Folder()).entries) {
    EXPECT_NEAR(entry.depth_delay, 0.09, 1e-9);
  }
}

TEST_F(TumSequenceTest, ReadsAssociationsInEitherOrder) {
  WriteText("associations.txt", "1.0 rgb/1.png 1.01 depth/1.png\n2.5 rgb/2.png 2.51 depth/2.png\n");
  SequenceIndex index = OpenSequence(Folder());
  EXPECT_THAT(Stamps(index), ElementsAre(1.0, 2.5));
  EXPECT_EQ(index.entries[0].depth_path, Path("depth/1.png"));

  WriteText("associations.txt", "1.01 depth/1.png 1.0 rgb/1.png\n2.51 depth/2.png 2.5 rgb/2.png\n");
  index = OpenSequence(Folder());
  EXPECT_THAT(Stamps(index), ElementsAre(1.0, 2.5));
  EXPECT_EQ(index.entries[0].color_path, Path("rgb/1.png"));
  EXPECT_EQ(index.entries[0].depth_path, Path("depth/1.png"));
  EXPECT_NEAR(index.entries[0].depth_delay, 0.01, 1e-9);
  EXPECT_EQ(index.entries[1].origin, Path("associations.txt") + ":2");
}

// A row whose stamps agree does so by chance.
TEST_F(TumSequenceTest, StampsOfDifferentClocksGiveNoDelay) {
  for (const double last : {9.9, 2.9}) {
    std::string rows;
    for (int i = 0; i < 9; ++i) {
      const double depth = i < 8 ? 9.01 + 0.1 * i : last;
      rows += FormatText("%.2f rgb/%d %.2f depth/%d\n", 2.1 + 0.1 * i, i, depth, i);
    }
    WriteText("associations.txt", rows);
    const SequenceIndex index = OpenSequence(Folder());
    EXPECT_EQ(index.entries.size(), 9u);
    for (const SequenceEntry& entry : index.entries) EXPECT_EQ(entry.depth_delay, 0.0);
    const auto warning = testing::Contains(Names("associations.txt:1", "8", "9", "6.910 s"));
    if (last == 2.9) {
      EXPECT_THAT(index.warnings, warning);
    } else {
      EXPECT_THAT(index.warnings, testing::Not(warning));
    }
  }
}

// Rows `begin` to `end` - 1 name the depth image four frames later.
TEST_F(TumSequenceTest, LeavesOutAssociationsOfDistantStamps) {
  const auto write = [&](int begin, int end) {
    std::string rows;
    for (int i = 0; i < 30; ++i) {
      const int j = i >= begin && i < end ? i + 4 : i;
      rows += FormatText("%.6f rgb/%d %.6f depth/%d\n", i / 30.0, i, j / 30.0 + 0.004, j);
    }
    WriteText("associations.txt", rows);
  };
  write(8, 16);
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.entries.size(), 22u);
  for (const SequenceEntry& entry : index.entries) EXPECT_NEAR(entry.depth_delay, 0.004, 2e-6);
  EXPECT_THAT(index.warnings,
              ElementsAre(Names("associations.txt:9", "0.137 s", "8", "30", "20 ms")));
  write(8, 26);
  EXPECT_THAT(ErrorOf(), Names("associations.txt:9", "only", "12", "18", "30", "20 ms"));
}

// The delay of a sensor varies about the limit of 20 ms.
TEST_F(TumSequenceTest, KeepsAssociationsWhoseDelayScatters) {
  std::string rows;
  for (int i = 0; i < 30; ++i) {
    rows += FormatText("%.6f rgb/%d %.6f depth/%d\n", i / 30.0, i,
                       i / 30.0 + 0.015 + 0.001 * (i % 11), i);
  }
  WriteText("associations.txt", rows);
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 30u);
  EXPECT_NEAR(index.entries[10].depth_delay, 0.025, 2e-6);
  EXPECT_THAT(index.warnings, IsEmpty());
}

TEST_F(TumSequenceTest, DistinguishesColumnsByBitDepth) {
  WriteColor("a/1.png");
  WriteDepth("b/1.png");
  WriteText("associations.txt", "1.5 b/1.png 1.5 a/1.png\n");
  EXPECT_EQ(OpenSequence(Folder()).entries[0].depth_path, Path("b/1.png"));
}

// Colour that was aligned to depth may say so in its name.
TEST_F(TumSequenceTest, DistinguishesColumnsByPixelsRatherThanNames) {
  WriteColor("aligned_to_depth/2.png");
  WriteDepth("z16/2.png");
  const std::string first = "1.0 aligned_to_depth/1.png 1.0 z16/1.png\n";  // missing
  WriteText("associations.txt", first + "2.5 aligned_to_depth/2.png 2.5 z16/2.png\n");
  EXPECT_EQ(OpenSequence(Folder()).entries[1].depth_path, Path("z16/2.png"));
  WriteText("associations.txt", "2.5 z16/2.png 2.5 aligned_to_depth/2.png\n");
  EXPECT_EQ(OpenSequence(Folder()).entries[0].depth_path, Path("z16/2.png"));
  WriteText("associations.txt", "1.5 a/1.png 1.5 z16/2.png\n");  // one is missing
  EXPECT_EQ(OpenSequence(Folder()).entries[0].depth_path, Path("z16/2.png"));
  WriteText("associations.txt", "1.5 a/1.png 1.5 aligned_to_depth/2.png\n");
  EXPECT_EQ(OpenSequence(Folder()).entries[0].depth_path, Path("aligned_to_depth/2.png"));
}

TEST_F(TumSequenceTest, RecognisesIclNuimByPixelsRatherThanNames) {
  WriteColor("depth_view/0.png");
  WriteDepth("z/0.png");
  WriteText("associations.txt", "0 depth_view/0.png 0 z/0.png\n1 depth_view/1.png 1 z/1.png\n");
  EXPECT_EQ(OpenSequence(Folder()).format, "tum");
}

TEST_F(TumSequenceTest, IclNuimStampsAreFrameNumbers) {
  WriteText(
      "associations.txt",
      "0 depth/0.png 0 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n30 depth/30.png 30 rgb/30.png\n");
  WriteText("livingRoom2.gt.freiburg", "1 0 0 -2.25 0 0 0 1\n30 0 0 -2.25 0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.format, "icl-nuim");
  EXPECT_THAT(Stamps(index), ElementsAre(0.0, 1.0 / 30.0, 1.0));
  EXPECT_EQ(index.entries[2].color_path, Path("rgb/30.png"));
  ASSERT_EQ(index.ground_truth.size(), 2u);  // image 0 has no pose
  EXPECT_DOUBLE_EQ(index.ground_truth[0].timestamp, 1.0 / 30.0);
  EXPECT_EQ(index.preset, "icl-nuim");
}

TEST_F(TumSequenceTest, RecognisesIclNuimWithoutGroundTruth) {
  WriteText("associations.txt", "0 depth/0.png 0 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n");
  EXPECT_EQ(OpenSequence(Folder()).format, "icl-nuim");
  WriteText("associations.txt", "0 rgb/0.png 0 depth/0.png\n1 rgb/1.png 1 depth/1.png\n");
  EXPECT_EQ(OpenSequence(Folder()).format, "tum");
  WriteText("associations.txt", "0.5 depth/0.png 0.5 rgb/0.png\n1 depth/1.png 1 rgb/1.png\n");
  EXPECT_EQ(OpenSequence(Folder()).format, "tum");
}

TEST_F(TumSequenceTest, ReadsIclNuimWithoutLists) {
  for (const char* name : {"0", "1", "2", "10"}) {
    WriteColor(std::string("rgb/") + name + ".png");
    WriteDepth(std::string("depth/") + name + ".png");
  }
  WriteText("traj0.gt.freiburg", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.format, "icl-nuim");
  EXPECT_THAT(Stamps(index), ElementsAre(0.0, 1.0 / 30.0, 2.0 / 30.0, 10.0 / 30.0));
}

TEST_F(TumSequenceTest, ConvertsStampsToSeconds) {
  WriteText("rgb.txt", "1305031102175304000 a\n1305031102208637000 b\n1305031102241970000 c\n");
  WriteText("depth.txt", "1305031102.180304 x\n1305031102.213637 y\n1305031102.246970 z\n");
  WriteText("groundtruth.txt", "1305031102175.3 0 0 0 0 0 0 1\n1305031102241.97 0 0 0 0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 3u);
  EXPECT_NEAR(index.entries[0].timestamp, 1305031102.175304, 1e-6);
  EXPECT_NEAR(index.entries[2].timestamp, 1305031102.241970, 1e-6);
  EXPECT_NEAR(index.entries[1].depth_delay, 0.005, 1e-6);
  ASSERT_EQ(index.ground_truth.size(), 2u);
  EXPECT_NEAR(index.ground_truth[1].timestamp, 1305031102.241970, 1e-6);
  EXPECT_THAT(index.warnings, ElementsAre(Names("rgb.txt", "nanoseconds"),
                                          Names("groundtruth.txt", "milliseconds")));
}

TEST_F(TumSequenceTest, ConvertsAssociationsInMilliseconds) {
  WriteText("associations.txt", "0 rgb/a 4 depth/a\n33 rgb/b 37 depth/b\n67 rgb/c 71 depth/c\n");
  WriteText("groundtruth.txt", "0 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n67 0 0 0 0 0 0 1\n");  // 1 kHz
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_THAT(Stamps(index), ElementsAre(0.0, 0.033, 0.067));
  EXPECT_NEAR(index.entries[1].depth_delay, 0.004, 1e-9);
  EXPECT_EQ(index.ground_truth.back().timestamp, 0.067);
}

TEST_F(TumSequenceTest, WholeStampsAreSecondsUnlessLayoutUsesFrameNumbers) {
  WriteText("associations.txt", "1.0 rgb/1 1.0 depth/1\n2.0 rgb/2 2.0 depth/2\n");
  WriteText("groundtruth.txt", "1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_THAT(Stamps(index), ElementsAre(1.0, 2.0));
  EXPECT_EQ(index.ground_truth.back().timestamp, 2.0);
  EXPECT_THAT(index.warnings,
              ElementsAre(Names("associations.txt", "seconds", "--format rgb-depth")));
  EXPECT_THAT(Stamps(OpenSequence(Folder(), "icl-nuim")), ElementsAre(1.0 / 30.0, 2.0 / 30.0));
}

TEST_F(TumSequenceTest, WarnsOfClockOffsetOfDepth) {
  std::string color, depth;
  for (int i = 0; i < 30; ++i) {
    color += std::to_string(1.0 + i / 30.0) + " rgb/" + std::to_string(i) + "\n";
    depth += std::to_string(1.1 + i / 30.0) + " depth/" + std::to_string(i) + "\n";
  }
  WriteText("rgb.txt", color);
  WriteText("depth.txt", depth);
  EXPECT_THAT(OpenSequence(Folder()).warnings,
              ElementsAre(Names("3", "30", "ms"), Names("0.100 s", "later")));
  WriteText("depth.txt", "0.90 x\n1.866667 y\n");
  EXPECT_THAT(OpenSequence(Folder()).warnings, testing::Contains(Names("0.100 s", "earlier")));
  WriteText("depth.txt", "6.0 x\n6.97 y\n");
  EXPECT_THAT(ErrorOf(), Names("no pair", "5.002 s", "later"));
}

TEST_F(TumSequenceTest, CountsInvalidPoses) {
  WriteText("associations.txt", "1.5 rgb/1 1.5 depth/1\n");
  WriteText("groundtruth.txt", "1.5 0 0 0 0 0 0 1\n1.6 nan 0 0 0 0 0 1\n");
  EXPECT_THAT(OpenSequence(Folder()).warnings, ElementsAre(Names("groundtruth.txt", "1", "nan")));
}

TEST_F(TumSequenceTest, SortsAndRemovesRepeatedStamps) {
  WriteText("associations.txt",
            "2.5 rgb/2 2.5 depth/2\n1.5 rgb/1 1.5 depth/1\n1.5 rgb/1b 1.5 depth/1b\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_THAT(Stamps(index), ElementsAre(1.5, 2.5));
  EXPECT_EQ(index.entries[0].color_path, Path("rgb/1"));
  EXPECT_EQ(index.warnings.size(), 2u);
}

// Sorting would interleave two passages.
TEST_F(TumSequenceTest, RefusesAClockThatWasSetBack) {
  std::string color, depth, pairs;
  for (int i = 0; i < 30; ++i) {
    const std::string stamp = FormatText("%.6f", 100.0 + i / 30.0 - (i < 20 ? 0.0 : 0.217));
    color += stamp + FormatText(" rgb/%d\n", i);
    depth += stamp + FormatText(" depth/%d\n", i);
    pairs += stamp + FormatText(" rgb/%d ", i) + stamp + FormatText(" depth/%d\n", i);
  }
  WriteText("lists/rgb.txt", color);
  WriteText("lists/depth.txt", depth);
  WriteText("pairs/associations.txt", pairs);
  for (const auto& [folder, row] :
       {std::pair("lists", "rgb.txt:21"), std::pair("pairs", "associations.txt:21")}) {
    const std::string error = MessageOf([&] { OpenSequence(Path(folder)); });
    EXPECT_THAT(error, Names(row, "0.217 s", "100.633333", "100.449667", "correct"));
  }
}

// An error instead of a run on one image of many, with the reason.
TEST_F(TumSequenceTest, FailsIfFewerThanHalfOfTheListedImagesCanBeUsed) {
  const auto write = [&](const char* format, double start) {
    std::string pairs, color, depth;
    for (int i = 0; i < 32; ++i) {
      const std::string stamp = FormatText(format, start + i / 30.0);
      pairs +=
          stamp + " rgb/" + std::to_string(i) + " " + stamp + " depth/" + std::to_string(i) + "\n";
      color += stamp + " rgb/" + std::to_string(i) + "\n";
      depth += stamp + " depth/" + std::to_string(i) + "\n";
    }
    WriteText("lists/rgb.txt", color);
    WriteText("lists/depth.txt", depth);
    WriteText("pairs/associations.txt", pairs);
  };
  const auto error = [&](const char* folder) {
    return MessageOf([&] { OpenSequence(Path(folder)); });
  };
  for (const auto& [name, list] :
       {std::pair("lists", "rgb.txt:1: "), std::pair("pairs", "associations.txt:1: ")}) {
    SCOPED_TRACE(name);
    write("%.6e", 1604645033.1);
    EXPECT_THAT(error(name), Names("1", "32", list, "1.604645e+09", "31", "time stamp"));
    write("%.0f", 1604645033.1);
    EXPECT_THAT(error(name), Names("2", "32", "30", "time stamp"));
    write("%.18e", 1604645033.1);
    EXPECT_EQ(OpenSequence(Path(name)).entries.size(), 32u);
    EXPECT_THAT(OpenSequence(Path(name)).warnings, IsEmpty());
    write("%.10e", 1604645033.0);  // to 0.1 s: a third of the images
    EXPECT_THAT(error(name), Names("0.1 s"));
  }
}

TEST_F(TumSequenceTest, NamesClocksThatDiffer) {
  std::string color, depth;
  for (int i = 0; i < 9; ++i) {
    color += FormatText("%.6f rgb/%d\n", 1604645033.1 + i / 30.0, i);
    depth += FormatText("%d depth/%d\n", 81500 + 33 * i, i);
  }
  WriteText("rgb.txt", color);
  WriteText("depth.txt", depth);
  EXPECT_THAT(ErrorOf(), Names("depth images", "81.500", "81.764", "associations.txt"));
}

TEST_F(TumSequenceTest, ErrorsNameFileLineAndFix) {
  WriteText("rgb.txt", "1.0 rgb/1.png\n");
  EXPECT_THAT(ErrorOf(), Names("depth.txt", "exist", "--format rgb-depth"));
  WriteText("depth.txt", "\n1.0\n");
  EXPECT_THAT(ErrorOf(), Names("depth.txt:2", "2", "time path", "1"));
  WriteText("depth.txt", "now depth/1.png\n");
  EXPECT_THAT(ErrorOf(), Names("depth.txt:1", "'now'"));
  WriteText("depth.txt", "# nothing\n");
  EXPECT_THAT(ErrorOf(), Names("depth.txt", "no image"));
  WriteText("depth.txt", "9.0 depth/1.png\n");
  EXPECT_THAT(ErrorOf(), Names("no pair"));
  WriteText("associations.txt", "1.0 rgb/1.png 1.0\n");
  EXPECT_THAT(ErrorOf(), Names("associations.txt:1", "4 fields", "3"));
  WriteText("associations.txt", "1.0 rgb/1.png 1.0 0.5\n");
  EXPECT_THAT(ErrorOf(), Names("'0.5'", "path"));
  WriteText("associations.txt", "1.0 rgb/1 1.0 depth/1 1.0 0 0 0 0 0 0 1\n");
  EXPECT_THAT(ErrorOf(), Names("associations.txt:1", "12", "ground-truth"));
}

}  // namespace
}  // namespace msc_vo
