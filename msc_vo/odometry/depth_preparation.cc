// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/depth_preparation.h"

#include "msc_vo/features/depth_measurement.h"
#include "msc_vo/odometry/event_log.h"
#include "msc_vo/sensor/depth_camera_correction.h"

namespace msc_vo {

namespace {

std::optional<DepthRegistration> FindRegistration(const CameraIntrinsics& given,
                                                  const CameraIntrinsics& present) {
  if (!present.registration) return std::nullopt;
  return DepthRegistration(DepthCameraOf(given, present), present.camera, present.distortion);
}

}  // namespace

DepthPreparation::DepthPreparation(const std::shared_ptr<const CameraIntrinsics>& given)
    : given_(given), aligner_(given->camera, given->distortion) {}

void DepthPreparation::SetIntrinsics(const CameraIntrinsics& intrinsics) {
  registration_ = FindRegistration(*given_, intrinsics);
  if (registration_) {
    const DepthCamera depth_camera = DepthCameraOf(*given_, intrinsics);
    aligner_ = DepthAligner(depth_camera.camera, depth_camera.distortion);
  } else {
    aligner_ = DepthAligner(intrinsics.camera, intrinsics.distortion);
  }
}

RgbdImage DepthPreparation::RemoveClipped(const RgbdImage& image) {
  // Registration has changed the values; who registers depth knows those before.
  if (!image.recorded_depth.empty()) return image;
  const PinholeCamera& camera = given_->distortion.Recorded(given_->camera);
  const bool fits = image.depth.type() == CV_32FC1 && image.depth.cols == camera.width &&
                    image.depth.rows == camera.height;
  if (!fits) return image;  // refused later
  if (clipped_.Add(image.depth)) EventLog::LogClippedDepth(image.id, clipped_.limits());
  const DepthLimits& limits = clipped_.limits();
  if (!limits.HasNearest() && !limits.HasFarthest()) return image;
  RgbdImage measured = image;
  measured.depth = image.depth.clone();
  limits.Apply(&measured.depth);
  return measured;
}

RgbdImage DepthPreparation::Align(const RgbdImage& image,
                                  const std::optional<CameraVelocity>& velocity) const {
  RgbdImage aligned = image;
  if (image.depth_delay != 0.0 && velocity && !image.depth_velocity) {
    if (aligned.recorded_depth.empty()) aligned.recorded_depth = image.depth;
    aligned.depth = aligner_.Align(image.depth, velocity->Over(image.depth_delay));
    // A motion of less than half a pixel leaves the image as it is.
    aligned.depth_velocity = aligned.depth.data == image.depth.data ? CameraVelocity() : *velocity;
  }
  return aligned;
}

RgbdImage DepthPreparation::Register(const RgbdImage& image) const {
  RgbdImage registered = image;
  if (!registration_) return registered;
  if (registered.recorded_depth.empty()) registered.recorded_depth = image.depth;
  registered.depth = registration_->Register(image.depth);
  return registered;
}

DepthMeasurement DepthPreparation::MeasurementFor(const FrameBuilderOptions& options) const {
  return [options, given = given_](const Frame& frame, const RecordedImage& image,
                                   const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
    RgbdImage registered;
    registered.gray = image.Gray();
    registered.recorded_depth = image.Depth();
    const auto registration = FindRegistration(*given, *intrinsics);
    registered.depth = registration ? registration->Register(registered.recorded_depth)
                                    : registered.recorded_depth;
    FrameBuilderOptions of_image = options;
    of_image.depth_sensor = image.sensor();
    return MeasureDepthAgain(of_image, registered, frame, intrinsics);
  };
}

}  // namespace msc_vo
