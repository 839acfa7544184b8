// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/calibration_report.h"

#include <optional>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/cli/calibration_rows.h"
#include "apps/cli/commands.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

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

std::string Cell(const std::optional<double>& number) {
  return number ? FormatText("%12.4f", *number) : std::string(12, ' ');
}

nlohmann::ordered_json Json(const std::optional<double>& number) {
  return number ? nlohmann::ordered_json(*number) : nlohmann::ordered_json();
}

}  // namespace

std::string FormatCalibrationTable(const CalibrationReport& report) {
  std::string text = FormatText("%d images, %d pairs of images with points in common\n",
                                report.num_views, report.num_pairs);
  text += FormatText("%-26s %12s %12s %12s %12s  %s\n", "", "given", "estimated", "+-", "used",
                     "verdict");
  for (const CalibrationRow& row : CalibrationRows(report)) {
    if (!row.is_listed) continue;
    text += FormatText("%-26s %s %s %s %s  %s\n", row.NameWithUnit().c_str(),
                       Cell(row.given).c_str(), Cell(row.estimated).c_str(),
                       Cell(row.sigma).c_str(), Cell(row.used).c_str(), row.verdict.c_str());
  }
  if (!report.residuals.given.empty()) {
    text += "median reprojection error " + PixelsText(report.residuals) + ", depth error " +
            DepthText(report.residuals) + "\n";
  }
  if (!report.used.depth_camera) {
    text += "The depth images count as registered: their camera is the colour camera.\n";
  }
  return text;
}

std::string FormatCalibrationJson(const CalibrationReport& report) {
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  for (const CalibrationRow& row : CalibrationRows(report)) {
    nlohmann::ordered_json& json = parameters[row.key];
    json = {
        {"unit", row.unit},         {"given", Json(row.given)}, {"estimated", Json(row.estimated)},
        {"sigma", Json(row.sigma)}, {"used", Json(row.used)},   {"verdict", row.verdict}};
    std::optional<double> log_odds;
    if (row.group) log_odds = report.log_odds[static_cast<size_t>(*row.group)];
    json["log_odds"] = Json(log_odds);
  }
  const nlohmann::ordered_json problem =
      report.problem.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(report.problem);
  const nlohmann::ordered_json json = {
      {"images", report.num_views},
      {"pairs", report.num_pairs},
      {"parameters", parameters},
      {"problem", problem},
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
  for (const CalibrationRow& row : CalibrationRows(report)) {
    if (!row.is_listed) continue;
    const std::string unit = row.unit.empty() ? "" : " " + row.unit;
    const auto number = [&](const std::optional<double>& value) {
      return value ? FormatText("%.6g", *value) + unit : "-";
    };
    std::string note = "given " + number(row.given) + ", estimated " + number(row.estimated);
    if (row.sigma) note += FormatText(" +- %.2g", *row.sigma);
    page.numbers.push_back({row.name, number(row.used), note + "; " + row.verdict});
  }
  return page;
}

}  // namespace msc_vo
