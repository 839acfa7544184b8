// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/camera/camera_intrinsics.h"
#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/sensor_correction.h"
#include "msc_vo/sensor/depth_camera.h"
#include "msc_vo/sensor/depth_sensor.h"

namespace msc_vo {

/// Tests whether `depth_scale` can be the raw units per metre of a depth image. If it cannot,
/// `error` names the valid range and, if the value is metres per unit, its reciprocal.
bool IsValidDepthScale(double depth_scale, std::string* error);

/// Calibration of an RGB-D camera: intrinsics, lens distortion, depth scale and readout time.
/// `camera` (of the undistorted images) and `distortion` are those of the colour images, and of the
/// depth images too unless there is a depth camera.
struct Calibration {
  static constexpr char kSelfCalibrated[] = "self-calibrated from the images";

  PinholeCamera camera;
  LensDistortion distortion;
  double depth_scale = 5000.0;  ///< raw depth units per metre
  /// Readout time of a rolling shutter: seconds from the first image row to the last, negative if
  /// the last row comes first; 0: global shutter. None: unknown, to be self-calibrated.
  std::optional<double> readout_time;
  std::string readout_origin = kSelfCalibrated;  ///< source of the readout time, for messages
  std::string origin;  ///< source of the other values, for messages: "camera.txt"
  /// Camera of depth images that are not registered to the colour images; none: they are.
  std::optional<DepthCamera> depth_camera = {};
  /// Horizontal field of view of the undistorted images, degrees, as given; none: the default of
  /// UndistortedCamera().
  std::optional<double> field_of_view = {};
  DepthSensor depth_sensor = DepthSensor::kAuto;  ///< of the depth images; kAuto: not given

  /// Intrinsics and size of the recorded colour images.
  const PinholeCamera& Recorded() const { return distortion.Recorded(camera); }
  /// Sets the intrinsics of the recorded images; SetUndistorted() must follow.
  void SetRecorded(const PinholeCamera& recorded);
  /// Determines the camera of the undistorted images from the recorded one, the lens, and the field
  /// of view, see CropToFieldOfView().
  void SetUndistorted();

  /// If the calibration is invalid, `error` names the value and its valid range.
  bool IsValid(std::string* error) const;
};

/// Returns the calibration with a correction applied. Corrections of the depth registration become
/// a depth camera, or change the one that there is; those of the depth sensor (kDepthOffset,
/// kDepthBowl) are left out.
Calibration Corrected(const Calibration& calibration, const SensorCorrection::Vector& correction);

/// The same for intrinsics that have been corrected.
Calibration Corrected(const Calibration& calibration, const CameraIntrinsics& intrinsics);

/// The lens of a camera in a configuration.
struct LensSettings {
  std::string model;                                  ///< LensModelName(); may be empty
  std::array<std::optional<double>, 8> coefficients;  ///< k1 k2 p1 p2 k3 k4 k5 k6

  /// Tests whether no value is set.
  bool IsEmpty() const;
};

/// The section camera.depth_camera of a configuration, see DepthCamera.
struct DepthCameraSettings {
  std::optional<double> fx, fy, cx, cy;
  std::optional<int> width, height;
  std::vector<double> translation;             ///< x y z, metres; empty: not set
  std::vector<double> rotation;                ///< quaternion x y z w; empty: not set
  std::optional<double> inverse_depth_offset;  ///< 1/metres
  LensSettings lens;

  /// Tests whether no value is set.
  bool IsEmpty() const;
};

/// The camera section of a configuration. Values that are not set come from other sources, see
/// ResolveCalibration().
struct CameraSettings {
  std::string preset;  ///< name of a CameraPreset; may be empty
  std::optional<double> fx, fy, cx, cy;
  std::optional<int> width, height;
  std::optional<double> depth_scale;  ///< raw depth units per metre
  LensSettings lens;
  std::optional<double> field_of_view;  ///< degrees, of the undistorted images
  std::optional<int> max_width;         ///< of colour images, pixels, see FitToImageSizes()
  /// Units per metre of depth images of floating-point numbers; not set: metres.
  std::optional<double> float_depth_scale;
  DepthCameraSettings depth_camera;
  std::string origin;  ///< the file, for messages

  /// Tests whether no value that describes the camera is set.
  bool IsEmpty() const;
};

/// Returns the settings that give all values of a calibration but its readout time.
CameraSettings SettingsOf(const Calibration& calibration);

/// Returns the unit quaternion of four numbers x y z w as a file gives them; none if their length
/// differs from 1 by more than 5 %.
std::optional<Eigen::Quaterniond> NormalizedQuaternion(const std::vector<double>& xyzw);

}  // namespace msc_vo
