// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/result_files.h"

#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/results/covariance_columns.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/results/run_report.h"
#include "msc_vo/results/summary_json.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Files that every run writes.
constexpr const char* kFilesOfEveryRun[] = {"trajectory.txt", "keyframes.txt", "frames.csv",
                                            "map.ply",        "lines.ply",     "summary.json",
                                            "report.html"};

// Written by runs with planes.
constexpr char kPlanes[] = "planes.ply";

// Written for sequences with either.
constexpr char kGroundTruth[] = "groundtruth.txt", kReference[] = "reference.txt";

// Calls `write` and adds the message of its exception to `problems`, one per line.
void TryTo(const std::function<void()>& write, std::string* problems) {
  try {
    write();
  } catch (const std::exception& error) {
    *problems += (problems->empty() ? "" : "\n") + std::string(error.what());
  }
}

// Replaces the earlier version of a file; files that are written during the run have one. If the
// disk is full, asks `make_room` for `num_bytes`: the size of this file and of all files after it.
// If that does not suffice, deletes the earlier version first, provided that the file then fits.
void WriteResult(const std::string& path, const std::string& content, std::uintmax_t num_bytes,
                 const MakeRoom& make_room) {
  const auto make_more_room = [&](std::uintmax_t) {
    if (make_room && make_room(num_bytes)) return true;
    std::error_code error;
    const std::uintmax_t earlier = std::filesystem::file_size(path, error);
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return !error && WouldFit(folder, earlier, content.size()) &&
           std::filesystem::remove(path, error);
  };
  WriteWithRoom([&] { WriteFile(path, content); }, num_bytes, make_more_room);
}

}  // namespace

std::vector<std::string> ResultFileNames() {
  std::vector<std::string> names(std::begin(kFilesOfEveryRun), std::end(kFilesOfEveryRun));
  names.insert(names.end(), {kPlanes, kGroundTruth, kReference, "sequence.json"});
  return names;
}

std::string FormatFrameRow(const FrameResult& frame) {
  const StageTimes& ms = frame.times;
  std::string text = FormatText("%.6f,%s,%d,%d,%d,%d,%d", frame.timestamp, ToString(frame.status),
                                frame.is_keyframe ? 1 : 0, frame.num_points, frame.num_lines,
                                frame.num_inlier_points, frame.num_inlier_lines);
  text += FormatText(",%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f,%.3f", ms.points, ms.lines, ms.depth,
                     ms.waiting, ms.matching, ms.pose, ms.tracking, ms.mapping);
  text += FormatSigmas(frame.covariance);
  text += FormatText(",%d,%d", frame.num_dynamic, frame.segment);
  text += FormatCorrelations(frame.covariance);
  const Rigid3 odom_from_cam = frame.cam_from_odometry.Inverse();
  const Eigen::Vector3d t = odom_from_cam.translation().array() + 0.0;  // no -0
  for (const double x : t) text += FormatText(",%.9g", x);
  const Eigen::Vector4d q = odom_from_cam.rotation().coeffs().array() + 0.0;
  for (const double x : q) text += FormatText(",%.9g", x);
  for (const auto& covariance : {frame.world_covariance, frame.odometry_covariance}) {
    text += FormatSigmas(covariance) + FormatCorrelations(covariance);
  }
  return text + "\n";
}

std::string FormatFramesCsv(const std::vector<FrameResult>& frames) {
  std::vector<std::string> names = {"time",     "status",        "keyframe",     "points",
                                    "lines",    "inlier_points", "inlier_lines", "points_ms",
                                    "lines_ms", "depth_ms",      "waiting_ms",   "matching_ms",
                                    "pose_ms",  "tracking_ms",   "mapping_ms"};
  const auto add = [&names](const std::vector<std::string>& columns) {
    names.insert(names.end(), columns.begin(), columns.end());
  };
  add(SigmaColumns(""));
  add({"dynamic", "segment"});
  add(CorrelationColumns(""));
  add({"odom_x", "odom_y", "odom_z", "odom_qx", "odom_qy", "odom_qz", "odom_qw"});
  for (const char* prefix : {"world_", "odom_"}) {
    add(SigmaColumns(prefix));
    add(CorrelationColumns(prefix));
  }
  std::string text = Joined(names, ",") + "\n";
  for (const FrameResult& frame : frames) text += FormatFrameRow(frame);
  return text;
}

void RefuseToOverwriteInputs(const SequenceIndex& sequence, const std::vector<std::string>& files,
                             const std::string& directory) {
  RefuseToOverwrite(InputFolders(sequence), directory);
  for (const char* name : kFilesOfEveryRun) {
    RefuseToOverwrite(files, PathIn(directory, name));
  }
  RefuseToOverwrite(files, PathIn(directory, kPlanes));
}

void RemoveResultFiles(const std::string& directory, const SequenceIdentity& sequence) {
  std::vector<const char*> names(std::begin(kFilesOfEveryRun), std::end(kFilesOfEveryRun));
  names.push_back(kPlanes);  // would be taken for one of a run without planes
  const std::optional<SequenceIdentity> earlier = ReadIdentity(directory);
  if (earlier && !earlier->IsSame(sequence)) {
    names.insert(names.end(), {kGroundTruth, kReference});
  }
  for (const char* name : names) {
    std::error_code error;
    std::filesystem::remove(PathIn(directory, name), error);
    if (error) {
      throw std::runtime_error(PathIn(directory, name) +
                               ": cannot be replaced: " + ErrorText(error));
    }
  }
}

std::string WriteResultFiles(const std::string& directory, const OdometryResult& result,
                             const RunContext& context, const MakeRoom& make_room) {
  MakeFolder(directory);
  const auto path = [&](const char* name) { return PathIn(directory, name); };
  const RunSummary summary = Summarize(result);
  std::vector<std::pair<const char*, std::string>> files = {
      {"trajectory.txt", FormatTrajectory(TrajectoryOf(result))},
      {"keyframes.txt", FormatTrajectory(result.keyframes)},
      {"frames.csv", FormatFramesCsv(result.frames)},
      {"summary.json", FormatSummaryJson(summary, context)},
      {"map.ply", FormatPointsPly(result.points)},
      {"lines.ply", FormatLinesPly(result.lines)}};
  if (!result.planes.empty()) files.emplace_back(kPlanes, FormatPlanesPly(result.planes));
  std::uintmax_t num_bytes = 0;
  for (const auto& [name, content] : files) num_bytes += content.size();
  std::string lost;
  for (const auto& [name, content] : files) {
    TryTo([&, &name = name,
           &content = content] { WriteResult(path(name), content, num_bytes, make_room); },
          &lost);
    num_bytes -= content.size();
  }
  files.clear();  // the report needs memory, too

  std::string missing;
  const std::vector<TimedPose>& truth = context.sequence.ground_truth;
  TryTo(
      [&] {
        if (!truth.empty()) WriteTrajectory(path(TruthFileName(context.sequence)), truth);
      },
      &missing);
  TryTo([&] { WriteFile(path("report.html"), FormatReport(result, summary, context)); }, &missing);
  if (!lost.empty()) throw std::runtime_error(lost + (missing.empty() ? "" : "\n" + missing));
  Log().info("results written to {}", directory);
  return missing;
}

}  // namespace msc_vo
