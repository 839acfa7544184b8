// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/mapping/keyframe_packet.h"
#include "msc_vo/self_calibration/calibration_estimator.h"
#include "msc_vo/self_calibration/readout_time_estimator.h"

namespace msc_vo {

/// Returns the frame with other intrinsics, and its depths measured again in its image, registered
/// as these say. Called on the thread of the mapper.
using DepthMeasurement = std::function<std::shared_ptr<const Frame>(
    const Frame& frame, const RecordedImage& image,
    const std::shared_ptr<const CameraIntrinsics>& intrinsics)>;

/// The calibration of the sensor during local mapping: estimates the readout time of a rolling
/// shutter and, after Begin(), the intrinsics, and brings frames and maps up to date with both.
class MapCalibration {
 public:
  /// `readout_time`: in seconds, which is then kept; std::nullopt: it is estimated.
  explicit MapCalibration(const std::optional<double>& readout_time)
      : readout_(readout_time), readout_time_(readout_.readout_time()) {}

  /// Estimates the intrinsics from now on, beginning with `given`, those of the frames.
  void Begin(const std::shared_ptr<const CameraIntrinsics>& given, DepthMeasurement measure_depth);

  /// Compensates the keyframes of the current map with the present readout time, which the next
  /// keyframes are compensated with.
  void CompensateMap(Map* map);
  /// The frame of a packet with the present intrinsics and readout time.
  std::shared_ptr<const Frame> BringUpToDate(const KeyframePacket& packet) const;

  /// Updates the readout time with the newest keyframe of the map, after local bundle adjustment.
  void UpdateReadoutTime(const KeyframePacket& packet, const Map& map, KeyframeId newest);
  /// Updates the intrinsics likewise. Returns true if they have changed: ChangeMap() is due.
  bool UpdateIntrinsics(const KeyframePacket& packet, const Map& map, KeyframeId newest);
  /// Gives the keyframes of a map the present intrinsics (ChangeKeyframeIntrinsics).
  void ChangeMap(Map* map) const;

  /// What frames must be prepared with that are tracked in the map of the snapshot.
  void Describe(MapSnapshot* snapshot) const;

  const ReadoutTimeEstimator& readout() const { return readout_; }
  /// None before Begin().
  const std::optional<CalibrationEstimator>& intrinsics() const { return intrinsics_; }
  /// See CalibrationEstimator; false if the calibration is not estimated.
  bool IsDoubted() const { return intrinsics_ && intrinsics_->IsDoubted(); }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [readout_estimator, readout_time, estimator, measure_depth] = *this;  // all members
    archive(readout_estimator, readout_time);
    if (estimator) archive(*estimator);  // present only if enabled
  }

 private:
  // The frame with the present intrinsics. `image`: its image; may be null.
  std::shared_ptr<const Frame> WithPresentIntrinsics(const std::shared_ptr<const Frame>& frame,
                                                     const RecordedImage* image) const;

  ReadoutTimeEstimator readout_;
  double readout_time_;  // seconds, of the compensation of the map's keyframes
  std::optional<CalibrationEstimator> intrinsics_;
  DepthMeasurement measure_depth_;  // with intrinsics_
};

}  // namespace msc_vo
