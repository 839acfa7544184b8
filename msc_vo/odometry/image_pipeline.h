// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "msc_vo/features/frame_builder.h"
#include "msc_vo/features/surface_normals.h"
#include "msc_vo/odometry/depth_preparation.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/odometry_options.h"
#include "msc_vo/odometry/side_workers.h"
#include "msc_vo/structure/axis_evidence.h"

namespace msc_vo {

/// An image with its depth at the time of its colour image.
struct AlignedImage {
  RgbdImage recorded;  ///< as given, without clipped depths
  RgbdImage aligned;
  double milliseconds = 0.0;  ///< time of the alignment
};

/// A frame and the image that its features were extracted from.
struct ExtractedFrame {
  RgbdImage image;  ///< with its depth registered
  std::shared_ptr<const Frame> frame;
};

/// From images to frames, with the calibration in use: prepares the depth and extracts features.
class ImagePipeline {
 public:
  /// Throws std::invalid_argument on invalid options or an invalid camera.
  ImagePipeline(const OdometryOptions& options, const PinholeCamera& camera,
                const LensDistortion& distortion);

  void SkipClippedDepthSearch() { finds_clipped_depth_ = false; }

  /// Throws std::invalid_argument if the image does not match the camera.
  void Check(const RgbdImage& image) const;

  /// Removes clipped depths, and warps the depth to the time of the colour image by the motion of
  /// the camera.
  AlignedImage Align(const RgbdImage& given, const std::optional<CameraVelocity>& velocity);
  /// Registers the depth and extracts the features. Sets the times of both functions.
  ExtractedFrame Extract(const AlignedImage& image, StageTimes* times);
  /// Normals of the surfaces that an image shows, camera frame.
  std::vector<AxisEvidence> Normals(const RgbdImage& image);

  /// The calibration in use, and the one given at the start.
  const std::shared_ptr<const CameraIntrinsics>& intrinsics() const {
    return builder_.intrinsics();
  }
  const CameraIntrinsics& given() const { return *preparation_.given(); }
  /// Replaces the calibration in use. Returns whether it has changed.
  bool UseIntrinsics(const std::shared_ptr<const CameraIntrinsics>& intrinsics);
  /// How depths are measured again after a change of the registration.
  DepthMeasurement MeasurementOfDepth() const {
    return preparation_.MeasurementFor(options_.features);
  }
  DepthSensor depth_sensor() const { return builder_.depth_sensor(); }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    std::shared_ptr<const CameraIntrinsics> in_use = intrinsics();
    archive(in_use);
    UseIntrinsics(in_use);  // resets what is read next
    archive(preparation_, builder_);
  }

 private:
  OdometryOptions options_;
  bool finds_clipped_depth_ = true;
  FrameBuilder builder_;
  DepthPreparation preparation_;
  std::optional<SurfaceNormalEstimator> normals_;
  SideWorkers side_workers_;
};

}  // namespace msc_vo
