// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/online_results.h"

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
  OnlineResults online(Path("out"));
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

TEST_F(OnlineResultsTest, RemovesEarlierResultsAtTheFirstReadableImage) {
  for (const char* name : {"trajectory.txt", "summary.json", "groundtruth.txt", "mine.txt"}) {
    WriteText(std::string("out/") + name, "earlier");
  }
  OnlineResults online(Path("out"));
  online.Add(Frame(0.5, TrackingStatus::kUnreadable));
  EXPECT_TRUE(HasEntry(Path("out/summary.json")));
  online.Add(Frame(1.0, TrackingStatus::kTracked));
  EXPECT_FALSE(HasEntry(Path("out/summary.json")));
  EXPECT_EQ(ReadFile(Path("out/groundtruth.txt")), "earlier");  // not every run writes it
  EXPECT_EQ(ReadFile(Path("out/mine.txt")), "earlier");
  EXPECT_EQ(ReadTrajectory(Path("out/trajectory.txt")).size(), 1u);
}

}  // namespace
}  // namespace msc_vo
