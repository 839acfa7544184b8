// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>

#include "msc_vo/features/frame_builder.h"
#include "msc_vo/geometry/camera_velocity.h"
#include "msc_vo/mapping/mapper.h"
#include "msc_vo/sensor/clipped_depth.h"
#include "msc_vo/sensor/depth_alignment.h"
#include "msc_vo/sensor/depth_registration.h"

namespace msc_vo {

/// Brings depth images to the time and to the pixels of their colour images, without values that
/// are no measurements.
class DepthPreparation {
 public:
  /// `given`: the intrinsics at the start, to which depth images were said to be registered.
  explicit DepthPreparation(const std::shared_ptr<const CameraIntrinsics>& given);

  const std::shared_ptr<const CameraIntrinsics>& given() const { return given_; }

  /// Replaces the intrinsics.
  void SetIntrinsics(const CameraIntrinsics& intrinsics);

  /// Returns the image without depths at which it and those before it were clipped, which are found
  /// and logged.
  RgbdImage RemoveClipped(const RgbdImage& image);
  /// Returns the image with its depth warped to the time of its colour image, with the velocity of
  /// the camera then.
  RgbdImage Align(const RgbdImage& image, const std::optional<CameraVelocity>& velocity) const;
  /// Returns the image with its depth registered to its colour image.
  RgbdImage Register(const RgbdImage& image) const;

  /// How a mapper measures depths again after a change of the registration. `options`: those of the
  /// frames.
  DepthMeasurement MeasurementFor(const FrameBuilderOptions& options) const;

  /// Lists the state for a checkpoint. The intrinsics are set again.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [given, clipped, aligner, registration] = *this;  // all members, or it does not compile
    archive(clipped);
  }

 private:
  std::shared_ptr<const CameraIntrinsics> given_;
  ClippedDepthFinder clipped_;
  DepthAligner aligner_;
  std::optional<DepthRegistration> registration_;  // none: depth images are registered
};

}  // namespace msc_vo
