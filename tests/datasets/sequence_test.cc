// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Layouts other than TUM, and their recognition.

#include "msc_vo/datasets/sequence.h"

#include <cmath>
#include <filesystem>
#include <utility>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"

namespace msc_vo {
namespace {

constexpr char kPose[] = "1 0 0 0.5\n0 1 0 -1\n0 0 1 2\n0 0 0 1\n";
constexpr char kLostPose[] =
    "-inf -inf -inf -inf\n-inf -inf -inf -inf\n-inf -inf -inf -inf\n"
    "-inf -inf -inf -inf\n";

class SequenceTest : public TemporaryFolder {
 protected:
  std::string ErrorOf(const std::string& format = "auto") {
    return MessageOf([&] { OpenSequence(Folder(), format); });
  }
};

TEST_F(SequenceTest, ReadsSevenScenes) {
  for (const std::string number : {"000000", "000001", "000003"}) {
    WriteColor("frame-" + number + ".color.png");
    WriteDepth("frame-" + number + ".depth.png", 1500);
    WriteText("frame-" + number + ".pose.txt", number == "000001" ? kLostPose : kPose);
  }
  WriteColor("frame-000009.color.png");  // no depth
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.format, "7-scenes");
  ASSERT_EQ(index.entries.size(), 3u);
  EXPECT_DOUBLE_EQ(index.entries[2].timestamp, 0.1);
  EXPECT_EQ(index.invalid_depth, 65535);
  EXPECT_EQ(index.preset, "7-scenes");
  ASSERT_EQ(index.ground_truth.size(), 2u);
  EXPECT_EQ(index.ground_truth[1].world_from_cam.translation(), Eigen::Vector3d(0.5, -1, 2));
  EXPECT_EQ(index.warnings.size(), 2u);  // one unpaired image, one lost pose
  WriteText("frame-000003.pose.txt", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0.5 -1 2 1\n");
  EXPECT_THAT(ErrorOf(), Names("frame-000003.pose.txt", "transposed", "[R t; 0 0 0 1]"));
}

TEST_F(SequenceTest, SaysThatNoPoseOfScanNetHasTheNameOfAnImage) {
  WriteColor("color/0.jpg");
  WriteDepth("depth/0.png");
  WriteText("pose/000000.txt", kPose);
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_THAT(index.warnings, testing::Contains(Names("ground truth", Path("pose/0.txt"))));
}

TEST_F(SequenceTest, WarnsOfAnAssociationFileOfFewImages) {
  std::string color, depth, rows;
  for (const std::string time : {"0.1", "0.2", "0.3", "0.4", "0.5"}) {
    color += time + " rgb/" + time + ".png\n";
    depth += time + " depth/" + time + ".png\n";
    if (time < "0.3") rows += time + " rgb/" + time + ".png " + time + " depth/" + time + ".png\n";
  }
  WriteText("associations.txt", rows);
  EXPECT_THAT(OpenSequence(Folder()).warnings, testing::IsEmpty());
  WriteText("rgb.txt", color);
  WriteText("depth.txt", depth);
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.entries.size(), 2u);
  EXPECT_THAT(index.warnings, testing::ElementsAre(Names("associations.txt", "2", "5")));
}

TEST_F(SequenceTest, RefusesToOverwriteItsParts) {
  WriteColor("seq/frame-000000.color.png");
  WriteDepth("seq/frame-000000.depth.png");
  WriteText("seq/frame-000000.pose.txt", kPose);
  WriteText("camera-intrinsics.txt", "7 0 3.5\n0 5 2.5\n0 0 1\n");
  WriteText("seq/result.html", "");
  const SequenceIndex index = OpenSequence(Path("seq"));
  for (const char* name : {"seq/frame-000000.color.png", "seq/frame-000000.depth.png",
                           "seq/frame-000000.pose.txt", "camera-intrinsics.txt"}) {
    EXPECT_THAT(MessageOf([&] { RefuseToOverwriteSequence(index, Path(name)); }),
                Names(Path(name), "input"));
  }
  RefuseToOverwriteSequence(index, Path("seq/camera.yaml"));
  RefuseToOverwriteSequence(index, Path("seq/result.html"));
  RefuseToOverwriteSequence(index, Path("new.txt"));
}

TEST_F(SequenceTest, RefusesToWriteBesideImagesInTheirOwnFolder) {
  WriteColor("rgb/1.png");
  WriteDepth("depth/1.png");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_THAT(MessageOf([&] { RefuseToOverwriteSequence(index, Path("rgb/camera.yaml")); }),
              Names("rgb/camera.yaml", "images"));
  RefuseToOverwriteSequence(index, Path("camera.yaml"));
}

TEST_F(SequenceTest, ReadsReplica) {
  for (const std::string number : {"000000", "000001"}) {
    WriteColor("results/frame" + number + ".jpg");
    WriteDepth("results/depth" + number + ".png");
  }
  WriteText("traj.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n1 0 0 4 0 1 0 5 0 0 1 6 0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.format, "replica");
  ASSERT_EQ(index.entries.size(), 2u);
  EXPECT_EQ(index.entries[1].depth_path, Path("results/depth000001.png"));
  ASSERT_EQ(index.ground_truth.size(), 2u);
  EXPECT_DOUBLE_EQ(index.ground_truth[1].timestamp, 1.0 / 30.0);
  EXPECT_EQ(index.ground_truth[1].world_from_cam.translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(index.preset, "replica");
  WriteText("traj.txt", "1 0 0\n");
  EXPECT_THAT(ErrorOf(), Names("traj.txt:1", "16"));
  WriteText("traj.txt", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n1 0 0 0 0 1 0 0 0 0 1 0 4 5 6 1\n");
  EXPECT_THAT(ErrorOf(), Names("traj.txt:2", "transposed"));
}

// Rows are poses of frames by number, if the numbers allow that.
TEST_F(SequenceTest, AssignsPosesOfReplicaByNumberOrOrder) {
  const auto read = [&](const std::vector<int>& numbers, int num_rows, int without_depth = -1) {
    std::filesystem::remove_all(Path("results"));
    for (const int number : numbers) {
      WriteColor("results/frame" + std::to_string(number) + ".jpg");
      if (number != without_depth) {
        WriteDepth("results/depth" + std::to_string(number) + ".png");
      }
    }
    std::string rows;
    for (int i = 0; i < num_rows; ++i) {
      rows += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0 0 0 0 1\n";
    }
    WriteText("traj.txt", rows);
    return OpenSequence(Folder());
  };
  // Number of the frame and row of each pose.
  const auto poses = [](const SequenceIndex& index) {
    std::vector<std::pair<int, int>> pairs;
    for (const TimedPose& pose : index.ground_truth) {
      pairs.emplace_back(std::lround(30.0 * pose.timestamp), pose.world_from_cam.translation().x());
    }
    return pairs;
  };
  const SequenceIndex subset = read({3, 6, 9}, 10);  // by number
  EXPECT_EQ(poses(subset).size(), 10u);
  EXPECT_EQ(poses(subset).back(), std::pair(9, 9));
  EXPECT_THAT(subset.warnings, testing::IsEmpty());
  const SequenceIndex from_one = read({1, 2, 3}, 3);
  EXPECT_THAT(poses(from_one),
              testing::ElementsAre(testing::Pair(1, 0), testing::Pair(2, 1), testing::Pair(3, 2)));
  EXPECT_THAT(from_one.warnings, testing::ElementsAre(Names("traj.txt", "3", "1", "order")));
  EXPECT_THAT(poses(read({0, 5, 10}, 3, 5)),
              testing::ElementsAre(testing::Pair(0, 0), testing::Pair(10, 2)));
  const SequenceIndex shorter = read({0, 1, 2, 3}, 3);
  EXPECT_THAT(poses(shorter),
              testing::ElementsAre(testing::Pair(0, 0), testing::Pair(1, 1), testing::Pair(2, 2)));
  EXPECT_THAT(shorter.warnings, testing::ElementsAre(Names("traj.txt", "3", "4")));
  const SequenceIndex unknown = read({1, 2, 3, 4}, 3);
  EXPECT_THAT(poses(unknown), testing::IsEmpty());
  EXPECT_THAT(unknown.warnings, testing::ElementsAre(Names("traj.txt", "3", "1", "4", "left")));
}

// Depth of another shape is not registered to colour.
TEST_F(SequenceTest, KeepsTheColourCameraOfScanNetWithDepthOfAnotherShape) {
  WriteColor("color/0.jpg", 16, 9);
  WriteDepth("depth/0.png");
  WriteText("intrinsic/intrinsic_color.txt", "20 0 7.5 0\n0 22 4 0\n0 0 1 0\n0 0 0 1\n");
  SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.format, "scannet");
  EXPECT_FALSE(index.scale_color);
  const Calibration calibration = ResolveCalibration({}, "", &index);
  EXPECT_EQ(calibration.camera.fy, 22.0);
  EXPECT_EQ(calibration.camera.height, 9);
  const RgbdDecoder decoder(index, calibration);
  EXPECT_THAT(MessageOf([&] { decoder.Decode(0); }),
              Names("depth/0.png", "8x6", "16x9", "register", "camera.txt"));
}

TEST_F(SequenceTest, ReadsScanNetAndScalesItsCameraToDepth) {
  for (const std::string number : {"0", "2", "10"}) {
    WriteColor("color/" + number + ".jpg", 16, 12);
    WriteDepth("depth/" + number + ".png");
    WriteText("pose/" + number + ".txt", kPose);
  }
  WriteText("color/0.jpg", "damaged");
  WriteText("pose/2.txt", kLostPose);
  WriteText("intrinsic/intrinsic_color.txt", "20 0 7.5 0\n0 22 5.5 0\n0 0 1 0\n0 0 0 1\n");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.format, "scannet");
  ASSERT_EQ(index.entries.size(), 3u);
  EXPECT_EQ(index.entries[1].color_path, Path("color/2.jpg"));  // natural order
  EXPECT_TRUE(index.scale_color);
  EXPECT_EQ(index.ground_truth.size(), 2u);
  const PinholeCamera& camera = index.calibration->camera;
  EXPECT_DOUBLE_EQ(camera.fx, 10.0);
  EXPECT_DOUBLE_EQ(camera.fy, 11.0);
  // The centre of 16 x 12 pixels is mapped to the centre of 8 x 6.
  EXPECT_DOUBLE_EQ(camera.cx, 3.5);
  EXPECT_DOUBLE_EQ(camera.cy, 2.5);
  EXPECT_EQ(camera.width, 8);
}

TEST_F(SequenceTest, PairsPlainFoldersByName) {
  for (const std::string name : {"1.000000", "1.033333", "1.066667"}) {
    WriteColor("rgb/" + name + ".png");
  }
  for (const std::string name : {"1.001000", "1.065000"}) WriteDepth("depth/" + name + ".png");
  const SequenceIndex index = OpenSequence(Folder());
  EXPECT_EQ(index.format, "rgb-depth");
  ASSERT_EQ(index.entries.size(), 2u);
  EXPECT_DOUBLE_EQ(index.entries[1].timestamp, 1.066667);
  EXPECT_EQ(index.entries[1].depth_path, Path("depth/1.065000.png"));
}

TEST_F(SequenceTest, PairsPlainFoldersByTimeAtLowRate) {
  for (const std::string name : {"1.0", "1.2", "1.4"}) WriteColor("rgb/" + name + ".png");
  for (const std::string name : {"1.08", "1.28"}) WriteDepth("depth/" + name + ".png");
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 2u);
  EXPECT_NEAR(index.entries[1].depth_delay, 0.08, 1e-9);
}

TEST_F(SequenceTest, PairsNumberedPlainFoldersByNumberOnly) {
  for (const std::string name : {"0", "6", "12", "18"}) WriteColor("rgb/" + name + ".png");
  for (const std::string name : {"0", "6", "14"}) WriteDepth("depth/" + name + ".png");
  EXPECT_EQ(OpenSequence(Folder()).entries.size(), 2u);
}

TEST_F(SequenceTest, MillisecondsAreNoFrameNumbersOfIclNuim) {
  for (const std::vector<int>& stamps : std::vector<std::vector<int>>{
           {81533, 81566, 81600}, {81533, 81573, 81613}, {0, 40, 80}, {1000, 1050, 1100}}) {
    std::string rows;
    for (const int stamp : stamps) {
      const std::string name = std::to_string(stamp);
      rows += name + " depth/" + name + ".png " + name + " rgb/" + name + ".jpg\n";
    }
    WriteText("associations.txt", rows);
    const SequenceIndex index = OpenSequence(Folder());
    EXPECT_EQ(index.format, "tum");
    ASSERT_EQ(index.entries.size(), 3u);
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(index.entries[i].timestamp, stamps[i] / 1e3);
  }
}

TEST_F(SequenceTest, GroundTruthOfPlainFoldersHasUnitInWhichItCoversImages) {
  const auto check = [&](const std::vector<std::string>& names,
                         const std::vector<std::string>& stamps, double first, double last) {
    std::string truth;
    for (const std::string& name : names) {
      WriteColor("rgb/" + name + ".jpg");
      WriteDepth("depth/" + name + ".png");
    }
    for (const std::string& stamp : stamps) truth += stamp + " 0 0 0 0 0 0 1\n";
    WriteText("groundtruth.txt", truth);
    const SequenceIndex index = OpenSequence(Folder());
    EXPECT_EQ(index.format, "rgb-depth");
    EXPECT_DOUBLE_EQ(index.entries.front().timestamp, first);
    EXPECT_DOUBLE_EQ(index.ground_truth.front().timestamp, first);
    EXPECT_DOUBLE_EQ(index.ground_truth.back().timestamp, last);
    std::filesystem::remove_all(Path("rgb"));
    std::filesystem::remove_all(Path("depth"));
  };
  const std::vector<std::string> milliseconds = {"81533", "81566", "81600"};
  check(milliseconds, milliseconds, 81.533, 81.6);
  check({"81.533", "81.566", "81.600"}, milliseconds, 81.533, 81.6);
  check({"240", "241", "270"}, {"240", "255", "270"}, 8.0, 9.0);
}

TEST_F(SequenceTest, GroundTruthOfMoreFramesThanImagesIsAt30Hz) {
  std::string rows;
  for (int i = 0; i < 50; ++i) {
    const std::string name = std::to_string(i);
    const std::string color = "rgb/" + name + ".png";
    const std::string depth = "depth/" + name + ".png";
    WriteColor(color);
    WriteDepth(depth);
    rows += name + " " + depth + " " + name + " " + color + "\n";
  }
  std::string truth;
  for (int i = 1; i <= 1508; ++i) truth += std::to_string(i) + " 0 0 0 0 0 0 1\n";
  WriteText("groundtruth.txt", truth);
  EXPECT_EQ(OpenSequence(Folder()).format, "rgb-depth");
  EXPECT_DOUBLE_EQ(OpenSequence(Folder()).ground_truth.back().timestamp, 1508 / 30.0);
  WriteText("associations.txt", rows);
  EXPECT_EQ(OpenSequence(Folder()).format, "icl-nuim");
  EXPECT_DOUBLE_EQ(OpenSequence(Folder()).ground_truth.back().timestamp, 1508 / 30.0);
}

TEST_F(SequenceTest, PairsPlainFoldersWithoutNumbersByOrder) {
  for (const std::string name : {"a", "b"}) {
    WriteColor("color/" + name + ".png");
    WriteDepth("depth/" + name + "_depth.png");
  }
  const SequenceIndex index = OpenSequence(Folder());
  ASSERT_EQ(index.entries.size(), 2u);
  EXPECT_DOUBLE_EQ(index.entries[1].timestamp, 1.0 / 30.0);
  EXPECT_EQ(index.entries[1].depth_path, Path("depth/b_depth.png"));
  WriteDepth("depth/c_depth.png");
  EXPECT_THAT(ErrorOf(), Names("2", "3", "associations.txt"));
}

TEST_F(SequenceTest, UsesGivenFormat) {
  WriteColor("rgb/0.png");
  WriteDepth("depth/0.png");
  WriteText("rgb.txt", "garbage\n");
  EXPECT_THAT(ErrorOf(), Names("depth.txt", "exist"));
  EXPECT_EQ(OpenSequence(Folder(), "rgb-depth").entries.size(), 1u);
  EXPECT_THAT(ErrorOf("replica"), Names("no pair"));
  EXPECT_THAT(ErrorOf("kitti"), Names("'kitti'", "auto", "replica"));
}

TEST_F(SequenceTest, ErrorListsLayoutsAndSuggestsSubfolder) {
  EXPECT_THAT(ErrorOf(), Names("RGB-D sequence", "tum:"));
  WriteColor("left/images_0/1.png");
  WriteDepth("z/1.png");
  EXPECT_THAT(ErrorOf(), Names(Path("left/images_0"), Path("z"), "rgb", "depth"));
  WriteText("inner/rgb.txt", "1.5 a\n");
  EXPECT_THAT(ErrorOf(), Names(Path("inner")));
  EXPECT_THAT(MessageOf([&] { OpenSequence(Path("nowhere")); }), Names("nowhere", "exist"));
  EXPECT_THAT(MessageOf([&] { OpenSequence(Path("inner/rgb.txt")); }),
              Names("inner/rgb.txt", "file"));
}

}  // namespace
}  // namespace msc_vo
