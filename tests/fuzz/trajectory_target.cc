// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Trajectories in the formats of TUM, KITTI and EuRoC, and one with 4x4 matrices.

#include <cmath>
#include <optional>

#include "tests/fuzz/input_folder.h"

#include "msc_vo/datasets/pose_matrix.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/datasets/trajectory_format.h"

namespace msc_vo {
namespace {

void CheckPoses(const std::vector<TimedPose>& poses) {
  for (size_t i = 0; i < poses.size(); ++i) {
    Require(std::isfinite(poses[i].timestamp) && poses[i].world_from_cam.params.allFinite(),
            "finite poses");
    Require(std::abs(poses[i].world_from_cam.rotation().norm() - 1.0) < 1e-9, "unit quaternions");
    Require(i == 0 || poses[i].timestamp >= poses[i - 1].timestamp, "poses in order of time");
  }
}

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  // The size chooses the format; three of five inputs are read in the format that is detected.
  constexpr std::optional<TrajectoryFormat> kFormats[] = {
      std::nullopt, TrajectoryFormat::kKitti, std::nullopt, TrajectoryFormat::kEuroc, std::nullopt};
  const std::string path = folder.Write("trajectory.txt", AsText(data, size));
  TrajectoryFile file;
  if (Accepts(path, [&] { file = ReadTrajectoryFile(path, kFormats[size % 5]); })) {
    CheckPoses(file.poses);
    TrajectoryFile other = file;
    ShareStamps(path, path, &file, &other);
    const std::string copy = folder.Write("copy.txt", FormatTrajectory(file.poses));
    Require(ReadTrajectory(copy).size() <= file.poses.size(), "what is written can be read");
  }
  if (size % 16 != 0) return 0;
  Eigen::MatrixXd matrix;
  if (Accepts(path, [&] { matrix = ReadMatrix(path, 4, 4); })) {
    const std::optional<Rigid3> pose = RigidFromMatrix(matrix);
    Require(!pose || pose->params.allFinite(), "a finite pose");
  }
  return 0;
}
