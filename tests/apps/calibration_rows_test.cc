// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/calibration_rows.h"

#include <cmath>
#include <map>
#include <string>

#include "tests/support/calibration_parameters.h"
#include <gtest/gtest.h>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

constexpr double kSigma = 1e-4;

// The report of a calibration that is corrected by `correction`.
CalibrationReport ReportOf(const Calibration& given, const S::Vector& correction) {
  CalibrationReport report;
  report.given = given;
  report.used = report.estimated = report.unrestricted = Corrected(given, correction);
  report.is_corrected.fill(true);
  report.refinement.is_corrected.fill(true);
  report.refinement.sigma.setConstant(kSigma);
  return report;
}

std::map<std::string, CalibrationRow> RowsByKey(const CalibrationReport& report) {
  std::map<std::string, CalibrationRow> rows;
  for (const CalibrationRow& row : CalibrationRows(report)) rows[row.key] = row;
  return rows;
}

// Compares the sigmas of the values with their changes by one sigma of their parameters.
void ExpectSigmasOfParameters(const Calibration& given) {
  const auto rows = RowsByKey(ReportOf(given, S::Vector::Zero()));
  for (const auto& [key, parameter] : ParametersOfCalibration()) {
    const CalibrationRow changed =
        RowsByKey(ReportOf(given, kSigma * S::Vector::Unit(parameter))).at(key);
    const double change = std::abs(*changed.estimated - *rows.at(key).estimated);
    EXPECT_NEAR(*rows.at(key).sigma, change, 1e-3 * change) << key;
  }
}

TEST(CalibrationRows, HaveTheSigmasOfTheirParameters) {
  Calibration given;
  given.camera = {500.0, 540.0, 320.0, 240.0, 640, 480};
  ExpectSigmasOfParameters(given);
  // Depth images with smaller pixels than the colour images.
  given.depth_camera = DepthCamera{{800.0, 810.0, 400.0, 300.0, 800, 600}, Rigid3()};
  ExpectSigmasOfParameters(given);
}

}  // namespace
}  // namespace msc_vo
