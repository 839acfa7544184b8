// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/depth_measurement.h"

#include "msc_vo/features/internal/depth_range_builder.h"
#include "msc_vo/features/internal/feature_depth.h"
#include "msc_vo/frame/feature_counts.h"
#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/frame/rolling_shutter.h"

namespace msc_vo {

std::shared_ptr<const Frame> MeasureDepthAgain(
    const FrameBuilderOptions& options, const RgbdImage& image, const Frame& frame,
    const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  DepthSource source(options.depth_sensor, options.noise, options.min_depth, options.max_depth,
                     image.depth.cols);
  source.Assign(image);
  // Features are where they were recorded without compensation of the rolling shutter.
  const CameraVelocity velocity = frame.velocity.value_or(CameraVelocity());
  const auto recorded = std::make_shared<Frame>(CompensateRollingShutter(frame, velocity, 0.0));
  Frame measured = *ChangeIntrinsics(recorded, intrinsics);
  const LensRemap lens(intrinsics->camera, intrinsics->distortion);
  for (PointFeature& point : measured.points) {
    MeasureDepth(source, lens.RawFromIdeal(point.pixel), &point);
  }
  MeasureDepth(options, source, lens, &measured.lines);
  ShareDepthErrors(source.model().shared_radius, &measured);
  measured.depth_ranges = HasDynamicFeatures(frame)
                              ? DepthRanges()
                              : MakeDepthRanges(source.image(), lens, intrinsics->camera);
  auto compensated =
      std::make_shared<Frame>(CompensateRollingShutter(measured, velocity, frame.readout_time));
  compensated->velocity = frame.velocity;
  return compensated;
}

}  // namespace msc_vo
