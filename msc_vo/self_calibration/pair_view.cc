// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/pair_view.h"

#include <cmath>

#include "msc_vo/frame/rolling_shutter.h"

namespace msc_vo {

namespace {

// Standard deviation, radians, of the error of lens and depth that the points of a pair have in
// common. Chosen by measurement, see docs/lab/self_calibration.md.
constexpr double kCommonError = 4e-4;
// The same of an image of a map, whose points other images also determine.
constexpr double kMapCommonError = 2.3e-4;
// Relative error of the velocity by which a rolling shutter is compensated. It comes from the
// motion between the neighbouring images.
constexpr double kVelocityError = 0.1;

// Difference of the readout time for its derivatives, seconds.
constexpr double kStep = 0.01;

// Pixel of a point if the compensation of the rolling shutter were made with another readout time,
// larger by `change` (seconds).
Eigen::Vector2d PixelAt(const Frame& frame, const PointFeature& point, double change) {
  if (!frame.velocity || change == 0.0) return point.pixel;
  return frame.camera.Project(frame.camera.Ray(point.pixel) +
                              change * RayChange(frame, point.pixel, point.inverse_depth));
}

}  // namespace

RgbdPairReprojection::View MakePairView(const LensDistortion& distortion, const Frame& frame,
                                        const PointFeature& point) {
  const auto recorded = [&](const Eigen::Vector2d& pixel) {
    return distortion.IsZero() ? pixel : distortion.Distort(frame.camera, pixel);
  };
  RgbdPairReprojection::View view;
  view.pixel = recorded(point.pixel);
  view.recorded_pixel = recorded(PixelAt(frame, point, -frame.readout_time));
  view.pixel_rate = (recorded(PixelAt(frame, point, kStep)) - view.pixel) / kStep;
  return view;
}

double SquaredShiftRate(const Frame& frame) {
  if (!frame.velocity) return 0.0;
  const double rate = frame.camera.FocalLength() * frame.velocity->angular.norm();
  return rate * rate;
}

double CommonError(const PinholeCamera& camera) { return kCommonError * camera.FocalLength(); }

double MapCommonVariance(const PinholeCamera& camera) {
  const double common_error = kMapCommonError * camera.FocalLength();
  return common_error * common_error;
}

double CommonVariance(const PinholeCamera& camera, double squared_shift_rate, double readout_time,
                      double readout_sigma) {
  const double common_error = CommonError(camera);
  const double by_velocity = kVelocityError * readout_time;
  // Rows are shifted evenly, from the first to the last one.
  const double by_readout = readout_sigma / std::sqrt(12.0);
  return common_error * common_error +
         squared_shift_rate * (by_velocity * by_velocity + by_readout * by_readout);
}

}  // namespace msc_vo
