// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/trajectory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "msc_vo/datasets/stamp_precision.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr size_t kFieldsPerPose = 8;
// Deviation of the norm from 1; larger than the rounding of components with two decimals.
constexpr double kMaxQuaternionError = 0.05;
constexpr char kNotEstimated[] = "not estimated";
constexpr char kSegmentFormat[] = "segment %d, world %d";

// Reads segment and world from a comment; other comments have no effect.
void ReadSegment(const std::string& comment, int* segment, int* world) {
  int numbers[2] = {0, 0};
  if (std::sscanf(comment.c_str(), kSegmentFormat, &numbers[0], &numbers[1]) != 2) return;
  *segment = numbers[0];
  *world = numbers[1];
}

// The comment above a pose, empty if it needs none. `segment` and `world`: of the pose before it.
std::string CommentOf(const TimedPose& pose, int segment, int world) {
  std::string comment;
  if (pose.segment != segment || pose.world != world) {
    comment = FormatText(kSegmentFormat, pose.segment, pose.world);
  }
  if (!pose.is_estimated) comment += (comment.empty() ? "" : ", ") + std::string(kNotEstimated);
  return comment;
}

bool EndsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void SortByTime(std::vector<TimedPose>* poses) {
  std::stable_sort(poses->begin(), poses->end(), [](const TimedPose& a, const TimedPose& b) {
    return a.timestamp < b.timestamp;
  });
}

// Throws if the stamps, as they are written in the file, do not tell most poses apart because they
// lost digits.
void CheckStampPrecision(const std::string& path, const std::vector<std::string>& stamps,
                         const std::vector<TimedPose>& sorted) {
  size_t num_repeated = 0;
  for (size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].timestamp == sorted[i - 1].timestamp) ++num_repeated;
  }
  if (2 * num_repeated <= sorted.size()) return;
  const std::string problem = DescribeLostDigits(stamps);
  if (!problem.empty()) throw std::runtime_error(path + ": " + problem);
}

// Formats with a fixed number of decimals: "0.1000000000"; never "-0.0000000000".
std::string Fixed(double value, int decimals) {
  std::array<char, 400> buffer;  // 309 digits of the largest double, sign, point, decimals
  std::snprintf(buffer.data(), buffer.size(), "%.*f", decimals, value);
  std::string text = buffer.data();
  if (text.find_first_of("123456789") == std::string::npos && text[0] == '-') text.erase(0, 1);
  return text;
}

}  // namespace

std::vector<TimedPose> ReadTrajectory(const std::string& path, int* num_left_out) {
  std::vector<TimedPose> poses;
  if (num_left_out) *num_left_out = 0;
  std::vector<std::string> stamps;
  int segment = 0, world = 0;
  for (const TextLine& line : ReadTextLines(path)) {
    ReadSegment(line.comment, &segment, &world);
    if (line.fields.size() != kFieldsPerPose) {
      line.Fail("expected 8 numbers 'time tx ty tz qx qy qz qw', found " +
                std::to_string(line.fields.size()) + " fields; correct the line");
    }
    std::array<double, kFieldsPerPose> v;
    bool finite = true;
    for (size_t i = 0; i < kFieldsPerPose; ++i) {
      const std::optional<double> value = ParseNumber(line.fields[i]);
      if (!value) {
        line.Fail("'" + line.fields[i] + "' is not a number; correct or remove the line");
      }
      v[i] = *value;
      finite = finite && std::isfinite(v[i]);
    }
    if (!finite) {
      if (num_left_out) ++*num_left_out;
      continue;
    }
    const Eigen::Quaterniond rotation(v[7], v[4], v[5], v[6]);
    if (!(std::abs(rotation.norm() - 1.0) <= kMaxQuaternionError)) {
      line.Fail(FormatText(
          "the quaternion qx qy qz qw has length %.3f instead of 1; correct or remove the line",
          rotation.norm()));
    }
    stamps.push_back(line.fields[0]);
    poses.push_back({v[0], Rigid3(rotation.normalized(), {v[1], v[2], v[3]}),
                     !EndsWith(line.comment, kNotEstimated), segment, world});
  }
  SortByTime(&poses);
  CheckStampPrecision(path, stamps, poses);
  return poses;
}

std::string FormatTrajectory(std::vector<TimedPose> poses) {
  SortByTime(&poses);
  std::string text;
  std::string previous_stamp;
  int segment = 0, world = 0;
  for (const TimedPose& pose : poses) {
    const std::string stamp = Fixed(pose.timestamp, 6);
    if (stamp == previous_stamp) continue;
    previous_stamp = stamp;
    const std::string comment = CommentOf(pose, segment, world);
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
