// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/mapping/mapper.h"
#include "msc_vo/odometry/image_pipeline.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/tracking/tracked_frame.h"

namespace msc_vo {

/// The interface between a run and the self-calibration of its sensor: gives the images of the run
/// to the estimator, which is a part of the mapper (MapCalibration), and its calibration to the
/// images of the run.
class CalibrationExchange {
 public:
  /// Starts the estimator if `enabled`. The others must outlive the object.
  CalibrationExchange(bool enabled, ImagePipeline* images, Mapper* mapper);

  /// Takes over the calibration of the map that a frame is tracked in. Returns the frame with it:
  /// if a correction has arrived, the features are extracted again.
  ExtractedFrame Adopt(const MapSnapshot& map, const AlignedImage& image, ExtractedFrame extracted,
                       StageTimes* times);

  /// Keeps the image of a frame that is no keyframe if the estimator needs it.
  void KeepImage(const TrackedFrame& tracked, const AlignedImage& image, const MapSnapshot& map);
  /// Passes the kept images to the mapper, and the image of the keyframe.
  void AddImages(const AlignedImage& image, const MapSnapshot& map, KeyframePacket* packet);

  /// Sets calibration, readout time, intrinsics and depth camera of the result.
  void Describe(OdometryResult* result) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [enabled, images, mapper, kept, last_image_time] =
        *this;  // all members, or it does not compile
    archive(kept, last_image_time);
  }

 private:
  bool NeedsImages(const MapSnapshot& map) const { return enabled_ && !map.calibration_is_settled; }

  bool enabled_;
  ImagePipeline* images_;
  Mapper* mapper_;
  std::vector<CalibrationImage> kept_;  // since the last keyframe
  double last_image_time_ = 0.0;        // seconds, of the last image for the estimator
};

}  // namespace msc_vo
