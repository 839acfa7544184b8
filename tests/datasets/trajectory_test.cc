// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/trajectory.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/tum_folder.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;

class TrajectoryTest : public TemporaryFolder {
 protected:
  std::string ErrorOf(const std::string& text) {
    WriteText("trajectory.txt", text);
    return MessageOf([&] { ReadTrajectory(Path("trajectory.txt")); });
  }
};

TEST_F(TrajectoryTest, WritesTumFormat) {
  const Eigen::Quaterniond rotation(-0.5, 0.5, 0.5, 0.5);  // w < 0
  EXPECT_EQ(FormatTrajectory({{1.5, Rigid3(rotation, {1.0, -2.0, -1e-15})}}),
            "1.500000 1.0000000000 -2.0000000000 0.0000000000 "
            "-0.5000000000 -0.5000000000 -0.5000000000 0.5000000000\n");
}

TEST_F(TrajectoryTest, RefusesStampsThatLostTheirDigits) {
  const auto rows = [](const char* format) {
    std::string text;
    for (int i = 0; i < 40; ++i) {
      text += FormatText(format, 1604645033.1 + i / 100.0) + " 0 0 0 0 0 0 1\n";
    }
    return text;
  };
  EXPECT_THAT(ErrorOf(rows("%.6e")), Names("trajectory.txt", "scientific notation"));
  EXPECT_EQ(ErrorOf(rows("%.18e")), "");
  EXPECT_EQ(ErrorOf(rows("%.0f")), "");  // repeated, but as they are
}

TEST_F(TrajectoryTest, MarksSegments) {
  std::vector<TimedPose> poses(6);
  for (int i = 0; i < 6; ++i) poses[i].timestamp = i;
  poses[1].is_estimated = false;
  for (const int i : {2, 3}) poses[i].segment = poses[i].world = 1;
  for (const int i : {4, 5}) poses[i].segment = 2;  // joined with segment 0
  poses[4].is_estimated = false;
  const std::string text = FormatTrajectory(poses);
  EXPECT_THAT(text, testing::StartsWith("0.000000 "));
  EXPECT_THAT(text, HasSubstr("\n# segment 1, world 1\n2.000000 "));
  EXPECT_THAT(text, HasSubstr("\n# segment 2, world 0, not estimated\n4.000000 "));
  WriteText("trajectory.txt", text);
  const std::vector<TimedPose> read = ReadTrajectory(Path("trajectory.txt"));
  ASSERT_EQ(read.size(), 6u);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(read[i].segment, poses[i].segment) << i;
    EXPECT_EQ(read[i].world, poses[i].world) << i;
    EXPECT_EQ(read[i].is_estimated, poses[i].is_estimated) << i;
  }
}

TEST_F(TrajectoryTest, WritesSortedUniqueStamps) {
  const TimedPose a{2.0, Rigid3()};
  const TimedPose b{1.0, Rigid3()};
  const TimedPose c{1.0 + 1e-9, Rigid3(Eigen::Quaterniond::Identity(), {9.0, 9.0, 9.0})};
  const std::string text = FormatTrajectory({a, b, c});
  EXPECT_THAT(text, testing::StartsWith("1.000000 0.0"));
  EXPECT_THAT(text, HasSubstr("\n2.000000 "));
  EXPECT_EQ(text.find('9'), std::string::npos);
}

TEST_F(TrajectoryTest, RestoresWrittenPoses) {
  const std::vector<TimedPose> poses = {
      {1305031102.175304, Rigid3(ExpSO3({0.3, -2.0, 0.7}), {0.123456789, -4.0, 7.5})},
      {1305031102.211214, Rigid3()}};
  WriteTrajectory(Path("t.txt"), poses);
  const std::vector<TimedPose> read = ReadTrajectory(Path("t.txt"));
  ASSERT_EQ(read.size(), 2u);
  for (size_t i = 0; i < read.size(); ++i) {
    EXPECT_NEAR(read[i].timestamp, poses[i].timestamp, 1e-6);
    EXPECT_TRUE(
        read[i].world_from_cam.translation().isApprox(poses[i].world_from_cam.translation(), 1e-9));
    EXPECT_LT(read[i].world_from_cam.rotation().angularDistance(poses[i].world_from_cam.rotation()),
              1e-9);
  }
  EXPECT_EQ(FormatTrajectory(read), ReadFile(Path("t.txt")));
}

TEST_F(TrajectoryTest, MarksPosesThatAreNotEstimatedByComment) {
  const std::string text =
      FormatTrajectory({{1.0, Rigid3()}, {2.0, Rigid3(), false}, {3.0, Rigid3()}});
  EXPECT_THAT(text, HasSubstr("\n# not estimated\n2.000000 "));
  WriteText("t.txt", text + "# other\r\n4 0 0 0 0 0 0 1\n#  not estimated \r\n5 0 0 0 0 0 0 1\n" +
                         "# not estimated\n\n6 0 0 0 0 0 0 1\n");
  std::vector<bool> is_estimated;
  for (const TimedPose& pose : ReadTrajectory(Path("t.txt"))) {
    is_estimated.push_back(pose.is_estimated);
  }
  EXPECT_THAT(is_estimated, testing::ElementsAre(true, false, true, true, false, true));
}

TEST_F(TrajectoryTest, AcceptsCommentsCommasTabsBlankLinesAndCrlf) {
  WriteText("t.txt",
            "\xEF\xBB\xBF# time x y z\r\n\r\n2,1,2,3,0,0,0,0.99\r\n1\t4 5\t6 0 0 0 1  \r\n"
            "3 nan 0 0 0 0 0 1\n");
  int num_left_out = -1;
  const std::vector<TimedPose> poses = ReadTrajectory(Path("t.txt"), &num_left_out);
  ASSERT_EQ(poses.size(), 2u);  // the lost frame (nan) is left out
  EXPECT_EQ(num_left_out, 1);
  EXPECT_EQ(poses[0].timestamp, 1.0);
  EXPECT_EQ(poses[0].world_from_cam.translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(poses[1].world_from_cam.rotation().w(), 1.0);  // normalised
}

TEST_F(TrajectoryTest, GroundTruthWithoutPosesIsLeftOutWithAWarning) {
  for (const char* text :
       {"2 -1 0 1 1 0 0 2 0 0 1 3\n2 -1 0 1 1 0 0 2 0 0 1 3\n", "1,5 0,0 0,0 0,0 0,0 0,0 0,0 1,0\n",
        "1 0.5 0.5 0.5 0.5 1 2 0.3\n2 0.5 0.5 0.5 0.5 2 1 0.3\n"}) {
    WriteText("groundtruth.txt", text);
    SequenceIndex index;
    ReadGroundTruthFile(Path("groundtruth.txt"), WholeStamps::kTimes, &index);
    EXPECT_TRUE(index.ground_truth.empty());
    EXPECT_THAT(index.warnings, testing::ElementsAre(Names("groundtruth.txt:1", "left out")));
  }
}

TEST_F(TrajectoryTest, ErrorsNameFileAndLine) {
  EXPECT_THAT(ErrorOf("# c\n1 2 3\n"), Names("trajectory.txt:2", "8", "3"));
  EXPECT_THAT(ErrorOf("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 1 9\n"),
              Names("trajectory.txt:2", "8", "time tx ty tz qx qy qz qw", "9"));
  EXPECT_THAT(ErrorOf("1 0 0 0 0 0 0 1 9\n2 0 0 0 0 0 0 1\n"),
              Names("trajectory.txt:2", "9", "first row", "8"));
  EXPECT_THAT(ErrorOf("1 0 0 x 0 0 0 1\n"), Names("trajectory.txt:1", "'x'"));
  EXPECT_THAT(ErrorOf("1 0 0 0 0 0 0 0.001\n"), Names("trajectory.txt:1", "qx qy qz qw", "0.001"));
  EXPECT_THAT(ErrorOf("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0.6 0.5\n"),
              Names("trajectory.txt:2", "qx qy qz qw", "0.781"));
  EXPECT_THAT(MessageOf([&] { ReadTrajectory(Path("none.txt")); }), Names("none.txt", "exist"));
  EXPECT_THAT(MessageOf([&] { ReadTrajectory(Folder()); }), Names(Folder(), "a folder"));
}

TEST_F(TrajectoryTest, FailedWriteThrowsAndLeavesNoFile) {
  EXPECT_THAT(MessageOf([&] { WriteTrajectory(Path("no/such/t.txt"), {}); }),
              Names("t.txt", "written"));
  EXPECT_TRUE(std::filesystem::is_empty(Folder()));
}

}  // namespace
}  // namespace msc_vo
