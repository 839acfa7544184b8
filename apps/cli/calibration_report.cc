// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/calibration_report.h"

#include <cmath>
#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/cli/commands.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/sensor/depth_camera_correction.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using S = SensorCorrection;

struct Row {
  const char* name;
  const char* key;
  const char* unit;
  double given;
  double estimated;
  double sigma;
  S::Index index;
  std::optional<CorrectionGroup> group;  ///< none: an error of the depth sensor, not corrected

  std::string NameWithUnit() const {
    return *unit ? std::string(name) + ", " + unit : std::string(name);
  }
};

DepthCamera DepthCameraOf(const Calibration& calibration) {
  return calibration.depth_camera.value_or(
      RegisteredDepthCamera(calibration.Recorded(), calibration.distortion));
}

std::vector<Row> RowsOf(const CalibrationReport& report) {
  using G = CorrectionGroup;
  const Calibration& given = report.given;
  const Calibration& estimated = report.estimated;
  const PinholeCamera& given_camera = given.Recorded();
  const PinholeCamera& camera = estimated.Recorded();
  const DepthCamera a = DepthCameraOf(given);
  const DepthCamera b = DepthCameraOf(estimated);
  const Eigen::Vector3d t_a = 1000.0 * a.depth_from_color.translation();
  const Eigen::Vector3d t_b = 1000.0 * b.depth_from_color.translation();
  const S::Vector& sigma = report.refinement.sigma;
  const Eigen::Vector2d& depth_errors = report.refinement.depth_errors;
  const double f = given_camera.FocalLength();
  const auto depth_group = G::kDepthRegistration;
  return {
      {"fx", "fx", "px", given_camera.fx, camera.fx, camera.fx * sigma(S::kFocalLength),
       S::kFocalLength, G::kFocalLength},
      {"fy", "fy", "px", given_camera.fy, camera.fy, std::abs(camera.fy) * sigma(S::kFocalLength),
       S::kFocalLength, G::kFocalLength},
      {"cx", "cx", "px", given_camera.cx, camera.cx, f * sigma(S::kCenterX), S::kCenterX,
       G::kPrincipalPoint},
      {"cy", "cy", "px", given_camera.cy, camera.cy, f * sigma(S::kCenterY), S::kCenterY,
       G::kPrincipalPoint},
      {"k1", "k1", "", given.distortion.k[0], estimated.distortion.k[0], sigma(S::kK1), S::kK1,
       G::kLens},
      {"k2", "k2", "", given.distortion.k[1], estimated.distortion.k[1], sigma(S::kK2), S::kK2,
       G::kLens},
      {"depth camera fx", "depth_fx", "px", a.camera.fx, b.camera.fx,
       b.camera.fx * sigma(S::kDepthFocalLength), S::kDepthFocalLength, depth_group},
      {"depth camera cx", "depth_cx", "px", a.camera.cx, b.camera.cx,
       a.camera.fx * sigma(S::kDepthX), S::kDepthX, depth_group},
      {"depth camera cy", "depth_cy", "px", a.camera.cy, b.camera.cy,
       std::abs(a.camera.fy) * sigma(S::kDepthY), S::kDepthY, depth_group},
      {"depth camera roll", "depth_roll", "degrees", RadiansToDegrees(a.Roll()),
       RadiansToDegrees(b.Roll()), RadiansToDegrees(sigma(S::kDepthRoll)), S::kDepthRoll,
       depth_group},
      {"depth_from_color x", "depth_x", "mm", t_a.x(), t_b.x(), 1000.0 * sigma(S::kDepthParallaxX),
       S::kDepthParallaxX, depth_group},
      {"depth_from_color y", "depth_y", "mm", t_a.y(), t_b.y(), 1000.0 * sigma(S::kDepthParallaxY),
       S::kDepthParallaxY, depth_group},
      {"depth offset", "depth_offset", "1/m", 0.0, depth_errors.x(), sigma(S::kDepthOffset),
       S::kDepthOffset, std::nullopt},
      {"depth error by radius", "depth_radial_error", "", 0.0, depth_errors.y(),
       sigma(S::kDepthBowl), S::kDepthBowl, std::nullopt},
  };
}

const char* VerdictOf(const Row& row, const CalibrationReport& report) {
  const bool is_observable = IsObservable(row.index, report.refinement.sigma(row.index));
  if (!row.group) return is_observable ? "not corrected" : "not observable";
  if (report.refinement.is_corrected[static_cast<size_t>(*row.group)]) return "corrected";
  if (row.group == CorrectionGroup::kDepthRegistration && report.edges_contradict) {
    return "kept: the edges contradict";
  }
  return is_observable ? "kept" : "kept: not observable";
}

using Residuals = std::vector<CalibrationResidual>;

double MedianPixels(const Residuals& residuals) {
  return MedianResidual(residuals, &CalibrationResidual::reprojection);
}

double MedianDepthPercent(const Residuals& residuals) {
  return 100.0 * MedianResidual(residuals, &CalibrationResidual::depth_error);
}

// The residuals of the given calibration, "0.45 px", or of both, "0.45 -> 0.31 px".
std::string BeforeAndAfter(const CalibrationResiduals& residuals,
                           double (*median)(const Residuals&), const char* unit) {
  const double before = median(residuals.given);
  return residuals.estimated.empty()
             ? FormatText("%.2f %s", before, unit)
             : FormatText("%.2f -> %.2f %s", before, median(residuals.estimated), unit);
}

std::string PixelsText(const CalibrationResiduals& residuals) {
  return BeforeAndAfter(residuals, MedianPixels, "px");
}

std::string DepthText(const CalibrationResiduals& residuals) {
  return BeforeAndAfter(residuals, MedianDepthPercent, "%");
}

nlohmann::ordered_json ResidualsJson(const Residuals& residuals) {
  if (residuals.empty()) return nullptr;
  return {{"points", residuals.size()},
          {"median_reprojection_error_px", MedianPixels(residuals)},
          {"median_depth_error_percent", MedianDepthPercent(residuals)}};
}

std::string LensYaml(const LensDistortion& lens, const std::string& indent) {
  std::string text;
  if (lens.model != LensModel::kRadialTangential) {
    text += indent + "lens: " + LensModelName(lens.model) + "\n";
  }
  const std::vector<std::string>& names = LensCoefficientNames(lens.model);
  for (size_t i = 0; i < names.size(); ++i) {
    text += indent + names[i] + FormatText(": %.8g\n", lens.k[i]);
  }
  return text;
}

}  // namespace

std::string FormatCalibrationTable(const CalibrationReport& report) {
  std::string text = FormatText("%d images, %d pairs of images with points in common\n",
                                report.num_views, report.num_pairs);
  text += FormatText("%-26s %12s %12s %10s  %s\n", "", "given", "estimated", "+-", "verdict");
  for (const Row& row : RowsOf(report)) {
    text += FormatText("%-26s %12.4f %12.4f %10.4f  %s\n", row.NameWithUnit().c_str(), row.given,
                       row.estimated, row.sigma, VerdictOf(row, report));
  }
  if (!report.residuals.given.empty()) {
    text += "median reprojection error " + PixelsText(report.residuals) + ", depth error " +
            DepthText(report.residuals) + "\n";
  }
  if (!report.estimated.depth_camera) {
    text += "The depth images count as registered: their camera is the colour camera.\n";
  }
  return text;
}

std::string FormatCalibrationJson(const CalibrationReport& report) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  for (const Row& row : RowsOf(report)) {
    nlohmann::ordered_json& json = parameters[row.key];
    json = {{"unit", row.unit},
            {"given", row.given},
            {"estimated", row.estimated},
            {"sigma", row.sigma},
            {"verdict", VerdictOf(row, report)}};
    json["log_odds"] =
        row.group ? nlohmann::ordered_json(report.log_odds[static_cast<size_t>(*row.group)])
                  : nlohmann::ordered_json();
  }
  const nlohmann::ordered_json json = {
      {"images", report.num_views},
      {"pairs", report.num_pairs},
      {"parameters", parameters},
      {"residuals",
       {{"given", ResidualsJson(report.residuals.given)},
        {"estimated", ResidualsJson(report.residuals.estimated)}}}};
  return json.dump(2) + "\n";
}

PlotPage CalibrationPage(const CalibrationReport& report, const std::string& title) {
  PlotPage page{title, CommandLine(), {}, PlotResiduals(report.residuals)};
  page.numbers = {{"images", std::to_string(report.num_views), ""},
                  {"pairs of images", std::to_string(report.num_pairs), ""}};
  if (!report.residuals.given.empty()) {
    page.numbers.push_back({"median reprojection error", PixelsText(report.residuals), ""});
    page.numbers.push_back({"median depth error", DepthText(report.residuals), ""});
  }
  for (const Row& row : RowsOf(report)) {
    const std::string unit = *row.unit ? std::string(" ") + row.unit : std::string();
    page.numbers.push_back(
        {row.name, FormatText("%.6g", row.estimated) + unit,
         FormatText("given %.6g, +- %.2g; ", row.given, row.sigma) + VerdictOf(row, report)});
  }
  return page;
}

std::string FormatCameraYaml(const Calibration& calibration, const std::string& comment) {
  const auto intrinsics = [](const PinholeCamera& c, const std::string& indent) {
    return indent + FormatText("fx: %.6f\n", c.fx) + indent + FormatText("fy: %.6f\n", c.fy) +
           indent + FormatText("cx: %.6f\n", c.cx) + indent + FormatText("cy: %.6f\n", c.cy) +
           indent + FormatText("width: %d\n", c.width) + indent +
           FormatText("height: %d\n", c.height);
  };
  std::string text = "# " + comment + "\ncamera:\n" + intrinsics(calibration.Recorded(), "  ") +
                     FormatText("  depth_scale: %.17g\n", calibration.depth_scale);
  text += LensYaml(calibration.distortion, "  ");
  if (calibration.field_of_view) {
    text += FormatText("  field_of_view: %.17g\n", *calibration.field_of_view);
  }
  if (calibration.depth_camera) {
    const Rigid3& transform = calibration.depth_camera->depth_from_color;
    const Eigen::Vector3d t = transform.translation();
    const Eigen::Quaterniond q(transform.rotation());
    text += "  depth_camera:\n" + intrinsics(calibration.depth_camera->camera, "    ") +
            FormatText("    translation: [%.6f, %.6f, %.6f]\n", t.x(), t.y(), t.z()) +
            FormatText("    rotation: [%.8f, %.8f, %.8f, %.8f]\n", q.x(), q.y(), q.z(), q.w()) +
            FormatText("    inverse_depth_offset: %.8g\n",
                       calibration.depth_camera->inverse_depth_offset);
    const LensDistortion& lens = calibration.depth_camera->distortion;
    if (!lens.IsZero()) text += LensYaml(lens, "    ");
  }
  return text;
}

}  // namespace msc_vo
