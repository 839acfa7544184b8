// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/self_calibration/calibration_evidence.h"
#include "msc_vo/self_calibration/recent_pairs.h"
#include "msc_vo/self_calibration/recorded_images.h"

namespace msc_vo {

/// Self-calibration of focal length, principal point, radial distortion and registration of depth
/// during a run. The given calibration counts as right until another one is far more likely, see
/// SelectCorrections(). Pairs of images, which cost little, make it a candidate;
/// SelfCalibratingBundleAdjustment() of the map then determines how large the error of the colour
/// camera is.
class CalibrationEstimator {
 public:
  explicit CalibrationEstimator(const std::shared_ptr<const CameraIntrinsics>& given);

  /// Updates the estimate with the images since the last keyframe and the newest keyframe, whose
  /// image is `recorded`. Call it after local bundle adjustment. `readout_sigma` (seconds):
  /// uncertainty of the readout time of a rolling shutter. Returns true if present() has changed.
  bool Update(const Map& map, KeyframeId newest,
              const std::shared_ptr<const RecordedImage>& recorded,
              const std::vector<CalibrationImage>& images, double readout_sigma);
  /// Whether there are so many pairs, and the colour camera is so certain, that Update() needs no
  /// further images; they may be null then. A later bundle adjustment may make it uncertain again.
  bool IsSettled() const;
  /// Reports another readout time of a rolling shutter, seconds.
  void SetReadoutTime(double readout_time) { pairs_.SetReadoutTime(readout_time); }

  /// The image of a recent keyframe, as long as the registration of depth may be corrected; null:
  /// it is not known.
  std::shared_ptr<const RecordedImage> FindImage(KeyframeId keyframe) const {
    return images_.Find(keyframe);
  }

  /// The calibration in use: the given one until a correction is accepted.
  const std::shared_ptr<const CameraIntrinsics>& present() const { return present_; }
  /// The estimate; nothing is corrected until a correction is accepted. Standard deviations are
  /// those of the pairs, or of bundle adjustment if they are larger.
  const CorrectionEstimate& estimate() const { return estimate_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [given, present, pairs, images, next_registration, at, estimate, applied, adjusted,
           adjusted_size, next_size] = *this;  // all members
    archive(given, present, pairs, images, next_registration, at, estimate, applied, adjusted,
            adjusted_size, next_size);
  }

 private:
  // The given calibration with a correction; null if there can be no such camera.
  std::shared_ptr<const CameraIntrinsics> MakeCorrected(
      const SensorCorrection::Vector& correction) const;
  // The groups that the pairs hold for wrong.
  CorrectionEstimate SelectByPairs(double readout_sigma, const CorrectionGroups& before) const;
  // Decides by the pairs which groups are corrected. Returns true if a new one is.
  bool SelectGroups(double readout_sigma);
  // Whether the estimate differs enough from the calibration in use to replace it.
  bool IsReplacementDue() const;
  // Whether bundle adjustment of a map of this size is due.
  bool IsAdjustmentDue(size_t num_keyframes) const;
  // Decides by bundle adjustment. Returns true if the calibration in use should be replaced.
  bool Adjust(const Map& map, double readout_sigma);
  // Uses the estimate from now on. Returns false if it is not possible.
  bool Apply();

  std::shared_ptr<const CameraIntrinsics> given_;
  std::shared_ptr<const CameraIntrinsics> present_;
  RecentPairs pairs_;
  RecordedImages images_;
  // Number of pairs from which on a registration may be accepted, after edges contradicted one.
  size_t next_registration_ = 0;
  SensorCorrection::Vector at_ = SensorCorrection::Vector::Zero();  // of the linearisation
  CorrectionEstimate estimate_;
  CorrectionEstimate applied_;                  // the one of present()
  std::optional<CorrectionEstimate> adjusted_;  // by bundle adjustment, of the corrected groups
  // Numbers of keyframes at the last bundle adjustment, and from which on the next one is due.
  size_t adjusted_size_ = 0;
  size_t next_size_ = 0;
};

}  // namespace msc_vo
