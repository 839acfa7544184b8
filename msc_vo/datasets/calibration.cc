// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calibration.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/camera/undistorted_camera.h"
#include "msc_vo/sensor/depth_camera_correction.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr double kMaxReadoutTime = 1.0;  // seconds; no camera takes longer for an image

// Raw units per metre of 16-bit depth images: a step of 10 cm, and a range of 65 cm.
constexpr double kMinDepthScale = 10.0;
constexpr double kMaxDepthScale = 1e5;

bool IsInDepthScaleRange(double units_per_metre) {
  return units_per_metre >= kMinDepthScale && units_per_metre <= kMaxDepthScale;
}

// Sets the intrinsics and the size of a camera or of a depth camera.
template <typename Settings>
void SetIntrinsics(const PinholeCamera& camera, Settings* settings) {
  settings->fx = camera.fx;
  settings->fy = camera.fy;
  settings->cx = camera.cx;
  settings->cy = camera.cy;
  settings->width = camera.width;
  settings->height = camera.height;
}

// The model and its coefficients; nothing without distortion.
LensSettings SettingsOf(const LensDistortion& lens) {
  LensSettings settings;
  if (lens.IsZero()) return settings;
  settings.model = LensModelName(lens.model);
  const std::vector<std::string>& all_names = LensCoefficientNames(LensModel::kRational);
  const std::vector<std::string>& names = LensCoefficientNames(lens.model);
  for (size_t i = 0; i < names.size(); ++i) {
    const auto at = std::find(all_names.begin(), all_names.end(), names[i]);
    settings.coefficients.at(static_cast<size_t>(at - all_names.begin())) = lens.k.at(i);
  }
  return settings;
}

DepthCameraSettings SettingsOf(const DepthCamera& depth_camera) {
  DepthCameraSettings settings;
  SetIntrinsics(depth_camera.camera, &settings);
  const Eigen::Vector3d translation = depth_camera.depth_from_color.translation();
  const Eigen::Quaterniond rotation(depth_camera.depth_from_color.rotation());
  settings.translation = {translation.x(), translation.y(), translation.z()};
  settings.rotation = {rotation.x(), rotation.y(), rotation.z(), rotation.w()};
  settings.inverse_depth_offset = depth_camera.inverse_depth_offset;
  settings.lens = SettingsOf(depth_camera.distortion);
  return settings;
}

}  // namespace

bool IsValidDepthScale(double depth_scale, std::string* error) {
  if (IsInDepthScaleRange(depth_scale)) return true;
  *error = FormatText("depth_scale = %.10g must be from %g to %g raw depth units per metre",
                      depth_scale, kMinDepthScale, kMaxDepthScale);
  if (IsInDepthScaleRange(1.0 / depth_scale)) {  // as the drivers of some sensors give it
    *error += FormatText("; %.10g metres per unit are %.6g units per metre", depth_scale,
                         1.0 / depth_scale);
  } else {
    *error +=
        ", 1000 units per metre if depth is in millimetres; floating-point depth in metres has "
        "none and needs any valid number";
  }
  return false;
}

void Calibration::SetRecorded(const PinholeCamera& recorded) {
  distortion.recorded.reset();
  camera = recorded;
}

void Calibration::SetUndistorted() {
  const PinholeCamera recorded = Recorded();
  camera = recorded;
  CropToFieldOfView(field_of_view, &distortion, &camera);
}

bool Calibration::IsValid(std::string* error) const {
  if (!Recorded().IsValid(error)) return false;
  if (field_of_view && !IsValidFieldOfView(*field_of_view, error)) return false;
  if (!camera.IsValid(error)) return false;
  if (!IsInvertible(distortion, camera, error)) return false;
  if (depth_camera && !depth_camera->IsValid(error)) return false;
  if (!IsValidDepthScale(depth_scale, error)) {
    *error = "camera: " + *error;
    return false;
  }
  if (readout_time && !(std::abs(*readout_time) < kMaxReadoutTime)) {
    *error = "camera: readout_time = " + FormatNumber(*readout_time) + " must be between -" +
             FormatNumber(kMaxReadoutTime) + " and " + FormatNumber(kMaxReadoutTime) +
             " seconds from the first image row to the last";
    return false;
  }
  return true;
}

CameraSettings SettingsOf(const Calibration& calibration) {
  CameraSettings settings;
  SetIntrinsics(calibration.Recorded(), &settings);
  settings.depth_scale = calibration.depth_scale;
  settings.lens = SettingsOf(calibration.distortion);
  settings.field_of_view = calibration.field_of_view;
  if (calibration.depth_camera) settings.depth_camera = SettingsOf(*calibration.depth_camera);
  settings.origin = calibration.origin;
  return settings;
}

std::optional<Eigen::Quaterniond> NormalizedQuaternion(const std::vector<double>& xyzw) {
  constexpr double kMaxLengthError = 0.05;
  const Eigen::Quaterniond rotation(xyzw.at(3), xyzw.at(0), xyzw.at(1), xyzw.at(2));
  if (!(std::abs(rotation.norm() - 1.0) <= kMaxLengthError)) return std::nullopt;
  return rotation.normalized();
}

Calibration Corrected(const Calibration& calibration, const SensorCorrection::Vector& correction) {
  CameraIntrinsics recorded{calibration.Recorded(), calibration.distortion};
  recorded.distortion.recorded.reset();
  Calibration corrected = Corrected(calibration, Corrected(recorded, correction));
  corrected.SetUndistorted();
  return corrected;
}

Calibration Corrected(const Calibration& calibration, const CameraIntrinsics& intrinsics) {
  Calibration corrected = calibration;
  corrected.camera = intrinsics.camera;
  corrected.distortion = intrinsics.distortion;
  if (intrinsics.registration) {
    const PinholeCamera& given = calibration.Recorded();
    const DepthCamera depth_camera = calibration.depth_camera
                                         ? *calibration.depth_camera
                                         : RegisteredDepthCamera(given, intrinsics.distortion);
    corrected.depth_camera =
        Corrected(depth_camera, given, corrected.Recorded(), *intrinsics.registration);
  }
  return corrected;
}

bool LensSettings::IsEmpty() const {
  return model.empty() &&
         std::none_of(coefficients.begin(), coefficients.end(),
                      [](const std::optional<double>& k) { return k.has_value(); });
}

bool DepthCameraSettings::IsEmpty() const {
  return !fx && !fy && !cx && !cy && !width && !height && translation.empty() && rotation.empty() &&
         !inverse_depth_offset && lens.IsEmpty();
}

bool CameraSettings::IsEmpty() const {
  return preset.empty() && !fx && !fy && !cx && !cy && !width && !height && !depth_scale &&
         depth_camera.IsEmpty() && lens.IsEmpty() && !field_of_view;
}

}  // namespace msc_vo
