// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/calibration_rows.h"

#include <array>
#include <cmath>
#include <iterator>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/results/calibrated_value.h"
#include "msc_vo/sensor/depth_camera_correction.h"

namespace msc_vo {

namespace {

using S = SensorCorrection;
using G = CorrectionGroup;

// A value that belongs to a group.
struct Value {
  const char* name;
  const char* key;
  const char* unit;
  S::Index index;
  G group;
};

constexpr Value kValues[] = {
    {"fx", "fx", "px", S::kFocalLength, G::kFocalLength},
    {"fy", "fy", "px", S::kFocalLength, G::kFocalLength},
    {"cx", "cx", "px", S::kCenterX, G::kPrincipalPoint},
    {"cy", "cy", "px", S::kCenterY, G::kPrincipalPoint},
    {"k1", "k1", "", S::kK1, G::kLens},
    {"k2", "k2", "", S::kK2, G::kLens},
    {"depth camera fx", "depth_fx", "px", S::kDepthFocalLength, G::kDepthRegistration},
    {"depth camera cx", "depth_cx", "px", S::kDepthX, G::kDepthRegistration},
    {"depth camera cy", "depth_cy", "px", S::kDepthY, G::kDepthRegistration},
    {"depth camera roll", "depth_roll", "degrees", S::kDepthRoll, G::kDepthRegistration},
    {"depth_from_color x", "depth_x", "mm", S::kDepthParallaxX, G::kDepthRegistration},
    {"depth_from_color y", "depth_y", "mm", S::kDepthParallaxY, G::kDepthRegistration},
};
constexpr size_t kNumValues = std::size(kValues);
using Numbers = std::array<double, kNumValues>;

DepthCamera DepthCameraOf(const Calibration& calibration) {
  return calibration.depth_camera.value_or(
      RegisteredDepthCamera(calibration.Recorded(), calibration.distortion));
}

// The values of a calibration, in the order and the units of kValues.
Numbers NumbersOf(const Calibration& calibration) {
  const PinholeCamera& color = calibration.Recorded();
  const std::array<double, 8>& k = calibration.distortion.k;
  const DepthCamera depth = DepthCameraOf(calibration);
  const Eigen::Vector3d translation = 1000.0 * depth.depth_from_color.translation();
  return {color.fx,
          color.fy,
          color.cx,
          color.cy,
          k[0],
          k[1],
          depth.camera.fx,
          depth.camera.cx,
          depth.camera.cy,
          RadiansToDegrees(depth.Roll()),
          translation.x(),
          translation.y()};
}

// Changes of the values with their parameters of the SensorCorrection.
Numbers ScalesOf(const Calibration& calibration) {
  const PinholeCamera& color = calibration.Recorded();
  const PinholeCamera depth = DepthCameraOf(calibration).camera;
  const double f = color.FocalLength();
  // A shift of depth is in focal lengths of the colour image that depth is registered to. The depth
  // image of a depth camera has pixels of another size.
  const double depth_x = f * depth.fx / color.fx;
  const double depth_y = f * std::abs(depth.fy / color.fy);
  const double parallax_x = 1000.0 * f / color.fx;
  const double parallax_y = 1000.0 * f / std::abs(color.fy);
  return {color.fx, std::abs(color.fy),    f,          f,         1.0, 1.0, depth.fx, depth_x,
          depth_y,  RadiansToDegrees(1.0), parallax_x, parallax_y};
}

std::string VerdictOf(const Value& value, const CalibrationReport& report) {
  const auto group = static_cast<size_t>(value.group);
  if (report.is_corrected[group]) return "corrected";
  if (report.refinement.is_corrected[group]) return "kept: no such camera";
  if (value.group == G::kDepthRegistration && report.edges_contradict) {
    return "kept: the edges contradict";
  }
  return KeptVerdict(IsObservable(value.index, report.refinement.sigma(value.index)));
}

std::vector<CalibrationRow> GroupedRows(const CalibrationReport& report) {
  const Numbers given = NumbersOf(report.given), used = NumbersOf(report.used);
  const Numbers estimated = NumbersOf(report.estimated);
  const Numbers unrestricted = NumbersOf(report.unrestricted);
  const Numbers scales = ScalesOf(report.used);
  const auto registration = static_cast<size_t>(G::kDepthRegistration);
  const bool is_registered = !report.given.depth_camera && !report.edges_contradict &&
                             !report.refinement.is_corrected[registration];
  std::vector<CalibrationRow> rows;
  for (size_t i = 0; i < kNumValues; ++i) {
    const Value& value = kValues[i];
    CalibrationRow row{value.name, value.key, value.unit};
    row.given = given[i];
    row.used = used[i];
    row.verdict = VerdictOf(value, report);
    row.group = value.group;
    const bool is_corrected = report.refinement.is_corrected[static_cast<size_t>(value.group)];
    if (is_corrected || IsObservable(value.index, report.refinement.sigma(value.index))) {
      row.estimated = is_corrected ? estimated[i] : unrestricted[i];
      row.sigma = scales[i] * report.refinement.sigma(value.index);
    }
    const bool is_of_depth_camera =
        value.index >= S::kDepthFocalLength && value.index <= S::kDepthY;
    row.is_listed = !is_registered || !is_of_depth_camera;
    rows.push_back(row);
  }
  return rows;
}

// The readout time of the shutter.
CalibrationRow ReadoutRow(const CalibrationReport& report) {
  CalibrationRow row{"readout time", "readout_time", "s"};
  row.given = report.given.readout_time;
  row.used = report.used.readout_time;
  if (report.readout) {
    row.estimated = report.readout->seconds;
    row.sigma = report.readout->sigma;
  }
  row.verdict = row.given ? "kept" : row.estimated ? "estimated" : "not found";
  return row;
}

// An error of the depth sensor.
CalibrationRow DepthErrorRow(const char* name, const char* key, const char* unit, S::Index index,
                             double estimated, const CalibrationReport& report) {
  CalibrationRow row{name, key, unit};
  row.verdict = "not observable";
  if (!IsObservable(index, report.refinement.sigma(index))) return row;
  row.estimated = estimated;
  row.sigma = report.refinement.sigma(index);
  row.verdict = "not corrected";
  return row;
}

}  // namespace

std::vector<CalibrationRow> CalibrationRows(const CalibrationReport& report) {
  std::vector<CalibrationRow> rows = GroupedRows(report);
  rows.push_back(ReadoutRow(report));
  // The offset that would correct the error, like DepthCamera::inverse_depth_offset.
  const double given = DepthCameraOf(report.given).inverse_depth_offset;
  const Eigen::Vector2d& errors = report.refinement.depth_errors;
  rows.push_back(DepthErrorRow("inverse depth offset", "depth_offset", "1/m", S::kDepthOffset,
                               given - errors.x(), report));
  rows.back().given = rows.back().used = given;
  rows.push_back(DepthErrorRow("depth error by radius", "depth_radial_error", "", S::kDepthBowl,
                               errors.y(), report));
  return rows;
}

}  // namespace msc_vo
