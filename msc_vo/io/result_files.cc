// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/io/result_files.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "msc_vo/io/format_text.h"
#include "msc_vo/io/run_report.h"
#include "msc_vo/io/text_file.h"
#include "msc_vo/io/trajectory.h"

namespace msc_vo {

namespace {

std::string FormatVertex(const Eigen::Vector3d& x) {
  return FormatText("%.6f %.6f %.6f", x.x(), x.y(), x.z());
}

// The paper's colours (its Fig. 1): red, green, blue along an axis; purple along none; black
// outside the last window.
const char* LineColor(const MapLine& line) {
  if (!line.in_last_window) return "0 0 0";
  if (!line.axis) return "128 0 128";
  constexpr const char* kAxisColors[] = {"255 0 0", "0 255 0", "0 0 255"};
  return kAxisColors[*line.axis];
}

}  // namespace

std::string FormatFramesCsv(const std::vector<FrameResult>& frames) {
  std::string text =
      "time,status,keyframe,points,lines,inlier_points,inlier_lines,points_ms,lines_ms,depth_ms,"
      "waiting_ms,matching_ms,pose_ms,tracking_ms,mapping_ms,sigma_rx,sigma_ry,sigma_rz,sigma_tx,"
      "sigma_ty,sigma_tz\n";
  for (const FrameResult& frame : frames) {
    const StageTimes& ms = frame.times;
    text += FormatText("%.6f,%s,%d,%d,%d,%d,%d", frame.timestamp, ToString(frame.status),
                       frame.is_keyframe ? 1 : 0, frame.num_points, frame.num_lines,
                       frame.num_inlier_points, frame.num_inlier_lines);
    text += FormatText(",%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f", ms.points, ms.lines, ms.depth,
                       ms.waiting, ms.matching, ms.pose, ms.tracking, ms.mapping);
    for (int i = 0; i < 6; ++i) text += FormatText(",%.9g", std::sqrt(frame.covariance(i, i)));
    text += '\n';
  }
  return text;
}

std::string FormatPointsPly(const std::vector<MapPoint>& points) {
  std::string text = FormatText(
      "ply\nformat ascii 1.0\ncomment msc_vo map points, metres\nelement vertex %zu\n"
      "property float x\nproperty float y\nproperty float z\nproperty int observations\n"
      "end_header\n",
      points.size());
  for (const MapPoint& point : points) {
    text += FormatVertex(point.position) + FormatText(" %d\n", point.num_observations);
  }
  return text;
}

std::string FormatLinesPly(const std::vector<MapLine>& lines) {
  std::string text = FormatText(
      "ply\nformat ascii 1.0\ncomment msc_vo map lines, metres\nelement vertex %zu\n"
      "property float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar "
      "green\n"
      "property uchar blue\nproperty int observations\n"
      "element edge %zu\nproperty int vertex1\nproperty int vertex2\nproperty uchar red\n"
      "property uchar green\nproperty uchar blue\nend_header\n",
      2 * lines.size(), lines.size());
  for (const MapLine& line : lines) {
    const std::string rest = FormatText(" %s %d\n", LineColor(line), line.num_observations);
    text += FormatVertex(line.segment.start) + rest;
    text += FormatVertex(line.segment.end) + rest;
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    text += FormatText("%zu %zu %s\n", 2 * i, 2 * i + 1, LineColor(lines[i]));
  }
  return text;
}

void WriteResultFiles(const std::string& directory, const OdometryResult& result,
                      const RunContext& context) {
  MakeFolder(directory);
  const std::filesystem::path folder = directory;
  const auto path = [&](const char* name) { return (folder / name).string(); };
  WriteTrajectory(path("trajectory.txt"), TrajectoryOf(result));
  WriteTrajectory(path("keyframes.txt"), result.keyframes);
  const std::vector<TimedPose>& truth = context.sequence.ground_truth;
  if (!truth.empty()) WriteTrajectory(path("groundtruth.txt"), truth);
  WriteFile(path("frames.csv"), FormatFramesCsv(result.frames));
  WriteFile(path("map.ply"), FormatPointsPly(result.points));
  WriteFile(path("lines.ply"), FormatLinesPly(result.lines));
  const RunSummary summary = Summarize(result);
  WriteFile(path("summary.json"), FormatSummary(summary, context));
  WriteFile(path("report.html"), FormatReport(result, summary, context));
}

}  // namespace msc_vo
