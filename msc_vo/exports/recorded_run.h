// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// What frames.csv has of a frame beside its pose in the trajectory.
struct RecordedFrame {
  /// See FrameResult::cam_from_odometry, of which it is the inverse.
  Rigid3 odom_from_cam;
  /// See FrameResult::world_covariance and FrameResult::odometry_covariance; none if unknown.
  std::optional<PoseCovariance> world_covariance;
  std::optional<PoseCovariance> odometry_covariance;
};

/// Returns a time stamp in whole microseconds, as result files have them.
int64_t Microseconds(double seconds);

/// Reads frames.csv: frames by their time in microseconds. Throws std::runtime_error, naming file
/// and line, if it is damaged or was written by a version without these columns.
std::map<int64_t, RecordedFrame> ReadFramesCsv(const std::string& path);

/// How the images of a run were read, apart from their camera.
struct RecordedReading {
  bool color_is_reduced = false;
  double float_depth_scale = 1.0;  ///< units per metre of depth images of floating-point numbers
  std::string mask;                ///< file or folder; empty: none
  bool mask_zero = false;          ///< pixels of the mask that are zero are left out
  std::string settings;            ///< ImageContainer::Settings()
};

/// What summary.json says of a run.
struct RecordedRun {
  /// At its end, with the camera as self-calibration has corrected it; none: of an earlier version.
  std::optional<Calibration> calibration;
  std::optional<RecordedReading> reading;  ///< none: of an earlier version
  /// Number of the world that its map is in; none: there is no map.
  std::optional<int> map_world;
};

/// Reads the summary.json of a folder of results; nothing is set if there is none. Throws
/// std::runtime_error, naming the file, if it is damaged.
RecordedRun ReadRecordedRun(const std::string& folder);

}  // namespace msc_vo
