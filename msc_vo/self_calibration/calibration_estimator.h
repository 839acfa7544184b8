// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
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
/// SelectCorrections(). Pairs of images, which cost little, make it a candidate. Once it has been
/// one at several keyframes in succession, SelfCalibratingBundleAdjustment() of the map takes part
/// in the decision and then determines how large the error of the colour camera is. A correction
/// that later images contradict is taken back for good.
class CalibrationEstimator {
 public:
  explicit CalibrationEstimator(const std::shared_ptr<const CameraIntrinsics>& given);

  /// Updates the estimate with the images since the last keyframe and the newest keyframe, whose
  /// image is `recorded`. Call it after local bundle adjustment. `readout_sigma` (seconds):
  /// uncertainty of the readout time of a rolling shutter. Returns true if present() has changed.
  bool Update(const Map& map, KeyframeId newest,
              const std::shared_ptr<const RecordedImage>& recorded,
              const std::vector<CalibrationImage>& images, double readout_sigma);
  /// Whether the estimation from pairs has ended: Update() needs no further images, which may be
  /// null then, and keeps none.
  bool IsSettled() const { return pairs_.is_closed(); }
  /// Whether focal length, lens or registration of depth may be wrong, and are not corrected: by
  /// kDoubtedOdds, or for the registration kAcceptedOdds. May remain so to the end of a run.
  bool IsDoubted() const;
  /// Reports another readout time of a rolling shutter, seconds.
  void SetReadoutTime(double readout_time) { pairs_.SetReadoutTime(readout_time); }

  /// The image of a recent keyframe, as long as the registration of depth may be corrected; null:
  /// it is not known.
  std::shared_ptr<const RecordedImage> FindImage(KeyframeId keyframe) const {
    return images_.Find(keyframe);
  }

  /// The calibration in use: the given one until a correction is accepted.
  const std::shared_ptr<const CameraIntrinsics>& present() const { return present_; }
  /// The estimate; nothing is corrected until a correction is accepted. Standard deviations and
  /// odds are those of the pairs and the map, whose images have errors in common; see also
  /// WithRegistrationErrors().
  CorrectionEstimate estimate() const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [given, present, pairs, images, next_registration, at, estimate, applied, candidacy,
           is_suspected, taken_back, of_map, is_map_corrected, adjusted_size, next_size] =
        *this;  // all members
    archive(given, present, pairs, images, next_registration, at, estimate, applied, candidacy,
            is_suspected, taken_back, of_map, is_map_corrected, adjusted_size, next_size);
  }

 private:
  // The given calibration with a correction; null if there can be no such camera.
  std::shared_ptr<const CameraIntrinsics> MakeCorrected(
      const SensorCorrection::Vector& correction) const;
  // Whether the estimation from pairs can end: the given calibration is certainly right, or further
  // pairs would hardly add information.
  bool IsEnough(double readout_sigma) const;
  // Linearises pairs again, at the present optimum of all parameters.
  void Linearize(double readout_sigma, size_t max_pairs);
  // Counts the keyframes in succession at which each group is a candidate by the pairs.
  void CountCandidacy(const CorrectionEstimate& by_pairs);
  bool IsLastingCandidate(size_t group) const;
  // What pairs and map tell, with the errors that the points of an image have in common.
  CalibrationInformation Information(double readout_sigma) const;
  // The estimate in which exactly the groups `wrong` are corrected. In a map of the corrected
  // camera, the errors of the points count as independent for the values, not for their sigmas.
  CorrectionEstimate Estimate(double readout_sigma, const CorrectionGroups& wrong) const;
  // The groups that are corrected already, and those whose correction is accepted.
  CorrectionEstimate Select(double readout_sigma) const;
  // Accepts corrections. Returns true if there are new ones.
  bool SelectGroups(double readout_sigma);
  // Takes back the corrections of groups whose given value has become the more likely one, if they
  // are no longer significant or the odds against them are as clear as those that accept one.
  // Returns true if there are any.
  bool TakeBack(double readout_sigma);
  // Whether the estimate differs enough from the calibration in use to replace it.
  bool IsReplacementDue(bool is_adjusted) const;
  // Whether bundle adjustment of a map of this size is due.
  bool IsAdjustmentDue(size_t num_keyframes) const;
  // Optimises the map together with the calibration. Returns whether it has succeeded.
  bool Adjust(const Map& map);
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
  CorrectionEstimate applied_;                            // the one of present()
  std::array<int, kNumCorrectionGroups> candidacy_ = {};  // keyframes in succession
  CorrectionGroups is_suspected_ = {};  // more likely wrong than right by the pairs alone
  CorrectionGroups taken_back_ = {};    // these remain as given
  // Of the last bundle adjustment, with independent errors; and whether its map was made with a
  // corrected colour camera.
  std::optional<CalibrationInformation> of_map_;
  bool is_map_corrected_ = false;
  // Numbers of keyframes at the last bundle adjustment, and from which on the next one is due.
  size_t adjusted_size_ = 0;
  size_t next_size_ = 0;
};

}  // namespace msc_vo
