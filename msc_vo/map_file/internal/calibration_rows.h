// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/frame/frame.h"
#include "msc_vo/map_file/internal/sqlite_database.h"

namespace msc_vo {

/// The calibration of frames.
struct FrameCalibration {
  PinholeCamera camera;
  std::shared_ptr<const CameraIntrinsics> intrinsics;  ///< null: unknown
};

/// The rows of the table `calibration`: many frames share a row.
class CalibrationRows {
 public:
  /// Reads all rows. Throws std::runtime_error if one is not valid.
  void Read(const SqliteDatabase& database);
  /// nullptr if there is no such row.
  const FrameCalibration* Find(int64_t id) const;

  /// Returns the number of the row with the calibration of a frame. Writes it if there is none.
  int64_t Write(const SqliteDatabase& database, const Frame& frame);

 private:
  std::map<int64_t, FrameCalibration> rows_;
  std::map<std::string, int64_t> ids_;  // by all values of the row
  int64_t next_id_ = 1;
};

}  // namespace msc_vo
