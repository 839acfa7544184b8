// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/pair_view.h"

#include "msc_vo/map/rolling_shutter.h"

namespace msc_vo {

namespace {

// Standard deviation, pixels, of the error that the points of a pair have in common; as for the
// readout time (docs/lab/self_calibration.md).
constexpr double kCommonError = 0.2;
// Relative error of the velocity by which a rolling shutter is compensated. It comes from the
// motion between the neighbouring images.
constexpr double kVelocityError = 0.1;

// Recorded pixel of a point before the compensation of the rolling shutter.
Eigen::Vector2d PixelBeforeCompensation(const Frame& frame, const PointFeature& point) {
  if (!frame.velocity || frame.readout_time == 0.0) return point.pixel;
  return frame.camera.Project(frame.camera.Ray(point.pixel) -
                              frame.readout_time *
                                  RayChange(frame, point.pixel, point.inverse_depth));
}

}  // namespace

RgbdPairReprojection::View MakePairView(const LensDistortion& distortion, const Frame& frame,
                                        const PointFeature& point) {
  const auto recorded = [&](const Eigen::Vector2d& pixel) {
    return distortion.IsZero() ? pixel : distortion.Distort(frame.camera, pixel);
  };
  RgbdPairReprojection::View view;
  view.pixel = recorded(point.pixel);
  view.recorded_pixel = recorded(PixelBeforeCompensation(frame, point));
  return view;
}

double CommonVariance(const Frame& frame) {
  const double shift = frame.velocity ? frame.camera.FocalLength() * frame.readout_time *
                                            frame.velocity->angular.norm()
                                      : 0.0;
  return 0.5 * kCommonError * kCommonError + kVelocityError * kVelocityError * shift * shift;
}

}  // namespace msc_vo
