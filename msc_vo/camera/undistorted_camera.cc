// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/undistorted_camera.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace msc_vo {

namespace {

constexpr double kMinFieldOfView = 10.0;   // degrees
constexpr double kMaxFieldOfView = 150.0;  // the middle has a 15th of the edge's pixels
constexpr double kDegrees = 180.0 / M_PI;

}  // namespace

double FieldOfView(const LensDistortion& distortion, const PinholeCamera& recorded) {
  LensDistortion lens = distortion;
  lens.recorded.reset();
  double angle = 0.0;
  for (const double x : {0.0, recorded.width - 1.0}) {
    const Eigen::Vector2d pixel = lens.Undistort(recorded, {x, recorded.cy});
    angle += std::atan(recorded.Ray(pixel).head<2>().norm());
  }
  return kDegrees * angle;
}

bool IsValidFieldOfView(double field_of_view, std::string* error) {
  if (field_of_view >= kMinFieldOfView && field_of_view <= kMaxFieldOfView) return true;
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "camera: field_of_view = " << field_of_view << " must be from " << kMinFieldOfView
       << " to " << kMaxFieldOfView << " degrees";
  *error = text.str();
  return false;
}

PinholeCamera UndistortedCamera(const LensDistortion& distortion, const PinholeCamera& recorded,
                                const std::optional<double>& field_of_view) {
  const double degrees = field_of_view
                             ? *field_of_view
                             : std::min(kMaxDefaultFieldOfView, FieldOfView(distortion, recorded));
  PinholeCamera camera = recorded;
  camera.cx = 0.5 * (recorded.width - 1);
  camera.cy = 0.5 * (recorded.height - 1);
  camera.fx = camera.cx / std::tan(0.5 * degrees / kDegrees);
  camera.fy = camera.fx * recorded.fy / recorded.fx;
  return camera;
}

void CropToFieldOfView(const std::optional<double>& field_of_view, LensDistortion* distortion,
                       PinholeCamera* camera) {
  distortion->recorded.reset();
  if (distortion->model != LensModel::kFisheye && !field_of_view) return;
  distortion->recorded = *camera;
  *camera = UndistortedCamera(*distortion, *camera, field_of_view);
}

}  // namespace msc_vo
