// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <optional>
#include <string>

#include "msc_vo/checkpoint/checkpoint_file.h"
#include "msc_vo/odometry/odometry.h"

namespace msc_vo {

/// Checkpoints of one odometry in folders. They name the options and the camera of their run, so
/// that no other one continues it.
class RunCheckpoint {
 public:
  RunCheckpoint(const OdometryOptions& options, const PinholeCamera& camera,
                const LensDistortion& distortion);

  /// Writes a checkpoint, which replaces an earlier one in the folder; only what has changed since
  /// then if that is of the same run. Throws std::runtime_error that names the file, or if a step
  /// of the mapper has failed.
  void Save(const std::string& folder, Odometry* odometry);
  /// Throws std::runtime_error that names the file, and std::invalid_argument if the options or the
  /// camera are others. The odometry can then only be destroyed.
  void Restore(const std::string& folder, Odometry* odometry);

 private:
  void Read(const std::string& folder, Odometry* odometry);
  void CheckRun(const std::string& path, const std::map<std::string, std::string>& saved) const;

  std::map<std::string, std::string> facts_;  // options, camera and lens by name
  std::string folder_;                        // of `file_`
  std::optional<CheckpointFile> file_;        // last used
};

}  // namespace msc_vo
