// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/trajectory.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Formats with a fixed number of decimals: "0.1000000000"; never "-0.0000000000".
std::string Fixed(double value, int decimals) {
  std::string text = FormatText("%.*f", decimals, value);
  if (text.find_first_of("123456789") == std::string::npos && text[0] == '-') text.erase(0, 1);
  return text;
}

}  // namespace

std::vector<TimedPose> ReadTrajectory(const std::string& path, int* num_left_out) {
  TrajectoryFile file = ReadTrajectoryFile(path);
  if (!file.has_stamps) {
    throw std::runtime_error(path + ": has no time stamps; write 'time tx ty tz qx qy qz qw' rows");
  }
  if (num_left_out) *num_left_out = file.num_left_out;
  return std::move(file.poses);
}

std::string FormatTrajectory(std::vector<TimedPose> poses, const TimedPose& before) {
  SortByTime(&poses);
  std::string text;
  std::string previous_stamp;
  int segment = before.segment, world = before.world;
  for (const TimedPose& pose : poses) {
    const std::string stamp = Fixed(pose.timestamp, 6);
    if (stamp == previous_stamp) continue;
    previous_stamp = stamp;
    const std::string comment = FormatPoseComment(pose, segment, world);
    if (!comment.empty()) text += "# " + comment + "\n";
    segment = pose.segment;
    world = pose.world;
    text += stamp;
    const Eigen::Vector3d t = pose.world_from_cam.translation();
    Eigen::Vector4d q = pose.world_from_cam.rotation().normalized().coeffs();
    if (q.w() < 0.0) q = -q;
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      text += ' ' + Fixed(value, 10);
    }
    text += '\n';
  }
  return text;
}

void WriteTrajectory(const std::string& path, const std::vector<TimedPose>& poses) {
  WriteFile(path, FormatTrajectory(poses));
}

}  // namespace msc_vo
