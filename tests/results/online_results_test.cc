// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/online_results.h"

#include <filesystem>

#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/results/result_files.h"

namespace msc_vo {
namespace {

class OnlineResultsTest : public TemporaryFolder {
 protected:
  static FrameResult Frame(double timestamp, TrackingStatus status) {
    FrameResult frame;
    frame.timestamp = timestamp;
    frame.status = status;
    frame.cam_from_world.translation() = Eigen::Vector3d(-timestamp, 0.0, 0.0);
    return frame;
  }
};

TEST_F(OnlineResultsTest, WritesEveryFrameImmediately) {
  OnlineResults online(Path("out"), {"/data/room", "", ""});
  std::vector<FrameResult> frames;
  size_t num_poses = 0;
  for (const TrackingStatus status :
       {TrackingStatus::kTracked, TrackingStatus::kWeak, TrackingStatus::kLost}) {
    frames.push_back(Frame(1.0 + static_cast<double>(frames.size()), status));
    online.Add(frames.back());
    num_poses += status != TrackingStatus::kLost;
    const std::vector<TimedPose> poses = ReadTrajectory(Path("out/trajectory.txt"));
    ASSERT_EQ(poses.size(), num_poses);
    EXPECT_EQ(poses.back().world_from_cam.translation().x(), poses.back().timestamp);
    EXPECT_EQ(ReadFile(Path("out/frames.csv")), FormatFramesCsv(frames));
  }
  EXPECT_THAT(ReadFile(Path("out/trajectory.txt")),
              testing::StartsWith(kUnfinishedTrajectoryComment));
}

TEST_F(OnlineResultsTest, KeepsSegmentsAndWorldsApart) {
  OnlineResults online(Path("out"), {"/data/room", "", ""});
  constexpr int kSegmentsAndWorlds[][2] = {{0, 0}, {1, 1}, {1, 1}, {2, 0}};
  double stamp = 1.0;
  for (const auto& [segment, world] : kSegmentsAndWorlds) {
    FrameResult frame = Frame(stamp++, TrackingStatus::kTracked);
    frame.segment = segment;
    frame.world = world;
    online.Add(frame);
  }
  const std::vector<TimedPose> poses = ReadTrajectory(Path("out/trajectory.txt"));
  ASSERT_EQ(poses.size(), 4u);
  for (size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(poses[i].segment, kSegmentsAndWorlds[i][0]) << i;
    EXPECT_EQ(poses[i].world, kSegmentsAndWorlds[i][1]) << i;
  }
}

TEST_F(OnlineResultsTest, RemovesEarlierResultsAtTheFirstReadableImage) {
  for (const char* name : {"trajectory.txt", "summary.json", "groundtruth.txt", "mine.txt"}) {
    WriteText(std::string("out/") + name, "earlier");
  }
  OnlineResults online(Path("out"), {"/data/room", "", ""});
  online.Add(Frame(0.5, TrackingStatus::kUnreadable));
  EXPECT_TRUE(HasEntry(Path("out/summary.json")));
  online.Add(Frame(1.0, TrackingStatus::kTracked));
  EXPECT_FALSE(HasEntry(Path("out/summary.json")));
  EXPECT_EQ(ReadFile(Path("out/groundtruth.txt")), "earlier");  // not every run writes it
  EXPECT_EQ(ReadFile(Path("out/mine.txt")), "earlier");
  EXPECT_EQ(ReadTrajectory(Path("out/trajectory.txt")).size(), 1u);
}

TEST_F(OnlineResultsTest, KeepsLaterFramesOfARunUntilTheyAreComputedAgain) {
  std::vector<FrameResult> frames;
  for (int i = 0; i < 5; ++i) frames.push_back(Frame(1.0 + i, TrackingStatus::kTracked));
  {
    OnlineResults killed(Path("out"), {"/data/room", "", ""});
    for (int i = 0; i < 4; ++i) killed.Add(frames[i]);
  }
  const std::string rows = ReadFile(Path("out/frames.csv"));
  WriteText("out/frames.csv", rows + "5.0,tra");  // not a whole row
  OnlineResults resumed(Path("out"), {"/data/room", "", ""});
  resumed.Continue({frames[0], frames[1]});
  resumed.Add(frames[2]);
  EXPECT_EQ(ReadTrajectory(Path("out/trajectory.txt")).size(), 4u);
  EXPECT_EQ(ReadFile(Path("out/frames.csv")), rows + "5.0,tra");
  resumed.Add(frames[3]);
  EXPECT_EQ(ReadFile(Path("out/frames.csv")), rows);
  resumed.Add(frames[4]);
  EXPECT_EQ(ReadFile(Path("out/frames.csv")), FormatFramesCsv(frames));
  EXPECT_EQ(ReadTrajectory(Path("out/trajectory.txt")).size(), 5u);
}

TEST_F(OnlineResultsTest, ReplacesFilesThatAreNotThoseOfTheResumedRun) {
  WriteText("out/trajectory.txt", "1 0 0 0 0 0 0 1\n");  // of a finished run
  WriteText("out/frames.csv", "a\nb\nc\nd\n");
  OnlineResults resumed(Path("out"), {"/data/room", "", ""});
  resumed.Continue({Frame(1.0, TrackingStatus::kLost)});
  resumed.Add(Frame(2.0, TrackingStatus::kTracked));
  EXPECT_EQ(
      ReadFile(Path("out/frames.csv")),
      FormatFramesCsv({Frame(1.0, TrackingStatus::kLost), Frame(2.0, TrackingStatus::kTracked)}));
  EXPECT_EQ(ReadTrajectory(Path("out/trajectory.txt")).size(), 1u);
}

// The first run was killed after it had written its final results, before it removed its
// checkpoint.
TEST_F(OnlineResultsTest, KeepsFinalResultsUntilTheResumedRunHasAsMany) {
  std::vector<FrameResult> frames;
  for (int i = 0; i < 3; ++i) frames.push_back(Frame(1.0 + i, TrackingStatus::kTracked));
  WriteText("out/trajectory.txt", "1 0 0 0 0 0 0 1\n");
  WriteText("out/frames.csv", FormatFramesCsv(frames));
  OnlineResults resumed(Path("out"), {"/data/room", "", ""});
  resumed.Continue({frames[0]});
  resumed.Add(frames[1]);
  EXPECT_EQ(ReadFile(Path("out/trajectory.txt")), "1 0 0 0 0 0 0 1\n");
  EXPECT_EQ(ReadFile(Path("out/frames.csv")), FormatFramesCsv(frames));
  resumed.Add(frames[2]);
  EXPECT_EQ(ReadFile(Path("out/frames.csv")), FormatFramesCsv(frames));
  EXPECT_EQ(ReadTrajectory(Path("out/trajectory.txt")).size(), 3u);
}

TEST_F(OnlineResultsTest, WritesLaterWhatCouldNotBeWritten) {
  for (const char* blocked : {"out/trajectory.txt/entry", "out/frames.csv/entry"}) {
    WriteText(blocked, "");
    OnlineResults online(Path("out"), {"/data/room", "", ""});
    std::vector<FrameResult> frames;
    for (int i = 0; i < 4; ++i) {
      frames.push_back(
          Frame(1.0 + i, i == 1 ? TrackingStatus::kUnreadable : TrackingStatus::kWeak));
      if (i < 2) {
        EXPECT_THROW(online.Add(frames.back()), std::runtime_error) << blocked;
      } else {
        if (i == 2) std::filesystem::remove_all(std::filesystem::path(Path(blocked)).parent_path());
        online.Add(frames.back());
      }
    }
    EXPECT_EQ(ReadFile(Path("out/frames.csv")), FormatFramesCsv(frames));
    EXPECT_EQ(ReadTrajectory(Path("out/trajectory.txt")).size(), 3u);
    std::filesystem::remove_all(Path("out"));
  }
}

}  // namespace
}  // namespace msc_vo
