// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "msc_vo/camera/undistorted_camera.h"
#include "msc_vo/datasets/calibration.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Degrees; RGB-D cameras have 54 to 90 degrees.
constexpr double kMinFieldOfView = 35.0, kMaxFieldOfView = 110.0;
// Offset of the principal point from the centre, as a fraction of the image size. Calibrations of
// RGB-D cameras have up to 0.04 (tum-fr1).
constexpr double kMaxOffset = 0.08;

void AddSigns(const Calibration& calibration, const std::string& format, Findings* findings) {
  const PinholeCamera& camera = calibration.Recorded();
  if (camera.fy < 0.0 && format != "icl-nuim") {
    findings->push_back(Warning("camera.sign",
                                "fy is negative: correct only for mirrored images (ICL-NUIM)",
                                "make fy positive unless the images are mirrored"));
  }
  if (camera.fy > 0.0 && format == "icl-nuim") {
    findings->push_back(Warning("camera.sign",
                                "fy is positive, but original ICL-NUIM images are mirrored: their "
                                "ground truth requires fy = -480",
                                "make fy negative, or mirror the images"));
  }
  if (!calibration.depth_camera) return;
  const double depth_fy = calibration.depth_camera->camera.fy;
  if ((depth_fy < 0.0) == (camera.fy < 0.0)) return;
  findings->push_back(Warning(
      "camera.sign",
      FormatText("fy of the depth camera is %s, that of the colour camera is %s: correct "
                 "only if one of the two images is mirrored top to bottom",
                 depth_fy < 0.0 ? "negative" : "positive",
                 camera.fy < 0.0 ? "negative" : "positive"),
      FormatText("make fy of the depth camera %s", camera.fy < 0.0 ? "negative" : "positive")));
}

void AddPrincipalPoint(const PinholeCamera& camera, Findings* findings) {
  const double x = camera.cx - 0.5 * (camera.width - 1);
  const double y = camera.cy - 0.5 * (camera.height - 1);
  if (std::abs(x) <= kMaxOffset * camera.width && std::abs(y) <= kMaxOffset * camera.height) return;
  findings->push_back(Warning(
      "camera.principal_point",
      FormatText("cx and cy are far from the image centre, by %.0f and %.0f px: is the calibration "
                 "for another image size?",
                 x, y),
      "give the calibration of these images; cropped or scaled images need cropped or scaled "
      "values",
      Measurement{std::hypot(x, y), "px"}));
}

void AddAspect(const PinholeCamera& camera, Findings* findings) {
  const double ratio = std::abs(camera.fx / camera.fy);
  if (std::abs(ratio - 1.0) <= 0.1) return;
  findings->push_back(Warning("camera.aspect",
                              "fx and fy differ by more than 10 %, but pixels are nearly always "
                              "square",
                              "check both", Measurement{ratio, "ratio"}));
}

// A lens whose undistorted image is a chosen part of what it sees may see as much as it likes.
void AddFieldOfView(const Calibration& calibration, Findings* findings) {
  const PinholeCamera& camera = calibration.Recorded();
  const double degrees = FieldOfView(calibration.distortion, camera);
  const bool is_wide = degrees > kMaxFieldOfView && !calibration.distortion.IsCropped();
  if (degrees >= kMinFieldOfView && !is_wide) return;
  findings->push_back(Warning(
      "camera.field_of_view",
      FormatText("the horizontal field of view is %.0f degrees (fx %.1f at a width of %d "
                 "px), unusual for an RGB-D camera",
                 degrees, camera.fx, camera.width),
      "check that the calibration is for this image size", Measurement{degrees, "degrees"}));
}

std::string LensText(const LensDistortion& lens) {
  const bool is_pinhole = lens.k == std::array<double, 8>{} && lens.model != LensModel::kFisheye;
  if (is_pinhole) return "";
  std::string text = std::string(", ") + LensModelName(lens.model) + " lens";
  const std::vector<std::string>& names = LensCoefficientNames(lens.model);
  for (size_t i = 0; i < names.size(); ++i)
    text += FormatText(" %s %.4g", names[i].c_str(), lens.k[i]);
  return text;
}

// Where the images are undistorted to another camera than the recorded one.
void AddUndistortedCamera(const Calibration& calibration, Findings* findings) {
  if (!calibration.distortion.recorded) return;
  const PinholeCamera& camera = calibration.camera;
  findings->push_back(Good(
      "camera.undistorted",
      FormatText("undistorted to fx %.3f, fy %.3f, cx %.3f, cy %.3f, %dx%d: a horizontal field "
                 "of view of %.0f degrees, of %.0f degrees that the lens sees",
                 camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height,
                 FieldOfView({}, camera),
                 FieldOfView(calibration.distortion, calibration.Recorded()))));
}

void AddDepthCamera(const DepthCamera& depth_camera, Findings* findings) {
  const PinholeCamera& camera = depth_camera.camera;
  const Eigen::Vector3d t = depth_camera.depth_from_color.translation();
  const double angle =
      depth_camera.depth_from_color.rotation().angularDistance(Eigen::Quaterniond::Identity());
  findings->push_back(
      Good("camera.depth_camera",
           FormatText("depth camera: fx %.3f, fy %.3f, cx %.3f, cy %.3f, %dx%d, depth_from_color "
                      "translation %.4f %.4f %.4f m, rotation %.2f degrees; depth is registered to "
                      "colour on reading",
                      camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height,
                      t.x(), t.y(), t.z(), RadiansToDegrees(angle))));
}

}  // namespace

void AddCameraFindings(const Calibration& calibration, const std::string& format,
                       Findings* findings) {
  const PinholeCamera& camera = calibration.Recorded();
  findings->push_back(
      Good("camera.source",
           "camera from " + calibration.origin +
               FormatText(": fx %.3f, fy %.3f, cx %.3f, cy %.3f, %dx%d, %.1f depth units per metre",
                          camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height,
                          calibration.depth_scale) +
               LensText(calibration.distortion)));
  AddUndistortedCamera(calibration, findings);
  if (calibration.depth_camera) AddDepthCamera(*calibration.depth_camera, findings);
  AddSigns(calibration, format, findings);
  AddAspect(camera, findings);
  AddFieldOfView(calibration, findings);
  AddPrincipalPoint(camera, findings);
}

}  // namespace msc_vo
