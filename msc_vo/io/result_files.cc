// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/io/result_files.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "msc_vo/io/text_file.h"
#include "msc_vo/io/trajectory.h"

namespace msc_vo {

namespace {

// printf into a string.
template <typename... Values>
std::string Format(const char* format, Values... values) {
  std::string text(static_cast<size_t>(std::snprintf(nullptr, 0, format, values...)), '\0');
  std::snprintf(text.data(), text.size() + 1, format, values...);
  return text;
}

std::string FormatVertex(const Eigen::Vector3d& x) {
  return Format("%.6f %.6f %.6f", x.x(), x.y(), x.z());
}

}  // namespace

std::string FormatFramesCsv(const std::vector<FrameResult>& frames) {
  std::string text =
      "time,status,keyframe,points,lines,inlier_points,inlier_lines,points_ms,lines_ms,depth_ms,"
      "matching_ms,pose_ms,tracking_ms,mapping_ms,sigma_rx,sigma_ry,sigma_rz,sigma_tx,sigma_ty,"
      "sigma_tz\n";
  for (const FrameResult& frame : frames) {
    const StageTimes& ms = frame.times;
    text += Format("%.6f,%s,%d,%d,%d,%d,%d", frame.timestamp, ToString(frame.status),
                   frame.is_keyframe ? 1 : 0, frame.num_points, frame.num_lines,
                   frame.num_inlier_points, frame.num_inlier_lines);
    text += Format(",%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f", ms.points, ms.lines, ms.depth,
                   ms.matching, ms.pose, ms.tracking, ms.mapping);
    for (int i = 0; i < 6; ++i) text += Format(",%.9g", std::sqrt(frame.covariance(i, i)));
    text += '\n';
  }
  return text;
}

std::string FormatPointsPly(const std::vector<MapPoint>& points) {
  std::string text = Format(
      "ply\nformat ascii 1.0\ncomment msc_vo map points, metres\nelement vertex %zu\n"
      "property float x\nproperty float y\nproperty float z\nproperty int observations\n"
      "end_header\n",
      points.size());
  for (const MapPoint& point : points) {
    text += FormatVertex(point.position) + Format(" %d\n", point.num_observations);
  }
  return text;
}

std::string FormatLinesPly(const std::vector<MapLine>& lines) {
  std::string text = Format(
      "ply\nformat ascii 1.0\ncomment msc_vo map lines, metres\nelement vertex %zu\n"
      "property float x\nproperty float y\nproperty float z\nproperty int observations\n"
      "element edge %zu\nproperty int vertex1\nproperty int vertex2\nend_header\n",
      2 * lines.size(), lines.size());
  for (const MapLine& line : lines) {
    const std::string observations = Format(" %d\n", line.num_observations);
    text += FormatVertex(line.segment.start) + observations;
    text += FormatVertex(line.segment.end) + observations;
  }
  for (size_t i = 0; i < lines.size(); ++i) text += Format("%zu %zu\n", 2 * i, 2 * i + 1);
  return text;
}

void WriteResultFiles(const std::string& directory, const OdometryResult& result,
                      const RunContext& context) {
  const std::filesystem::path folder = directory;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw std::runtime_error(directory + ": cannot be made: " + error.message());
  }
  const auto path = [&](const char* name) { return (folder / name).string(); };
  WriteTrajectory(path("trajectory.txt"), TrajectoryOf(result));
  WriteTrajectory(path("keyframes.txt"), result.keyframes);
  WriteFile(path("frames.csv"), FormatFramesCsv(result.frames));
  WriteFile(path("map.ply"), FormatPointsPly(result.points));
  WriteFile(path("lines.ply"), FormatLinesPly(result.lines));
  WriteFile(path("summary.json"), FormatSummary(Summarize(result), context));
}

}  // namespace msc_vo
