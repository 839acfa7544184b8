// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/calibration_views.h"

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "msc_vo/frame/rolling_shutter.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/sensor/depth_alignment.h"

namespace msc_vo {

namespace {

// Velocity between two frames; std::nullopt unless both are tracked, in one world.
std::optional<CameraVelocity> VelocityBetween(const FrameResult& before, const FrameResult& after) {
  for (const FrameResult* frame : {&before, &after}) {
    if (frame->status != TrackingStatus::kTracked) return std::nullopt;
  }
  if (before.world != after.world) return std::nullopt;
  return CameraVelocity::Of(after.cam_from_world * before.cam_from_world.Inverse(),
                            after.timestamp - before.timestamp);
}

// Indices of at most `max_views` frames whose poses are in the largest world.
std::vector<size_t> SelectFrames(const OdometryResult& result, size_t max_views) {
  std::vector<size_t> estimated;
  for (size_t i = 1; i + 1 < result.frames.size(); ++i) {
    const FrameResult& frame = result.frames[i];
    if (frame.status == TrackingStatus::kTracked && frame.world == result.map_world) {
      estimated.push_back(i);
    }
  }
  if (estimated.size() <= max_views) return estimated;
  std::vector<size_t> selected;
  for (size_t i = 0; i < max_views; ++i) {
    selected.push_back(estimated[i * estimated.size() / max_views]);
  }
  return selected;
}

}  // namespace

CalibrationSequence MakeCalibrationViews(const RgbdDecoder& decoder,
                                         const FrameBuilderOptions& features,
                                         const OdometryResult& result, size_t max_views) {
  const Calibration& calibration = decoder.calibration();
  FrameBuilder builder(features, calibration.camera, calibration.distortion);
  CalibrationSequence views;
  for (const size_t i : SelectFrames(result, max_views)) {
    const auto velocity = VelocityBetween(result.frames[i - 1], result.frames[i + 1]);
    RgbdImage image = decoder.Decode(static_cast<int>(result.frames[i].id));
    if (velocity && image.depth_delay != 0.0) {
      image.depth = AlignDepth(calibration.camera, image.depth, velocity->Over(image.depth_delay));
      image.depth_velocity = velocity;
    }
    Frame frame = builder.Build(image);
    if (velocity && result.readout_time != 0.0) {
      frame = CompensateRollingShutter(frame, *velocity, result.readout_time);
    }
    views.push_back({std::make_shared<Frame>(std::move(frame)),
                     InverseDepthImage(image.depth, features.min_depth, features.max_depth),
                     result.frames[i].cam_from_world});
  }
  return views;
}

}  // namespace msc_vo
