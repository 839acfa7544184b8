// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/calibrated_value.h"

#include <cmath>
#include <map>
#include <string>

#include "tests/support/calibration_parameters.h"
#include "tests/support/message_matchers.h"
#include <gtest/gtest.h>

#include "msc_vo/sensor/depth_camera_correction.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

// The summary of a run that has corrected a calibration whose focal lengths differ.
RunSummary CorrectedRun(const S::Vector& correction) {
  CameraIntrinsics given;
  given.camera = {500.0, 540.0, 320.0, 240.0, 640, 480};
  RunSummary summary;
  summary.intrinsics = Corrected(given, correction);
  summary.depth_camera = DepthCameraOf(given, summary.intrinsics);
  summary.calibration.correction = correction;
  summary.calibration.sigma.setConstant(1e-4);
  return summary;
}

std::map<std::string, CalibratedValue> ValuesByName(const RunSummary& summary) {
  std::map<std::string, CalibratedValue> values;
  for (const CalibratedValue& value : ListCalibratedValues(summary)) values[value.name] = value;
  return values;
}

TEST(CalibratedValue, HasTheSigmaOfItsParameter) {
  S::Vector correction = S::Vector::Zero();
  correction(S::kDepthFocalLength) = 0.1;
  const auto values = ValuesByName(CorrectedRun(correction));
  for (const auto& [name, parameter] : ParametersOfCalibration()) {
    S::Vector changed = correction;
    changed(parameter) += 1e-4;
    const double change =
        ValuesByName(CorrectedRun(changed)).at(name).value - values.at(name).value;
    EXPECT_NEAR(values.at(name).sigma, std::abs(change), 1e-3 * std::abs(change)) << name;
  }
}

TEST(CalibratedValue, HasTheVerdictsOfCalibrate) {
  RunSummary summary = CorrectedRun(S::Vector::Zero());
  summary.calibration.is_corrected[static_cast<size_t>(CorrectionGroup::kFocalLength)] = true;
  summary.calibration.sigma(S::kK1) = 0.0;  // no estimate
  const auto values = ValuesByName(summary);
  EXPECT_STREQ(values.at("fx").verdict, "corrected");
  EXPECT_STREQ(values.at("cx").verdict, "kept");
  EXPECT_STREQ(values.at("k1").verdict, "kept: not observable");
}

TEST(DepthContradiction, NeedsTheLargestNoiseAndAWrongRegistrationThatIsKept) {
  constexpr auto kRegistration = static_cast<size_t>(CorrectionGroup::kDepthRegistration);
  RunSummary summary = CorrectedRun(S::Vector::Zero());
  summary.noise_scale.point_depth = 3.0;
  summary.calibration.log_odds[kRegistration] = 24.0;
  EXPECT_THAT(DescribeDepthContradiction(summary), Names("depth", "3", "e^24", "check --deep"));
  summary.calibration.log_odds[kRegistration] = 6.2;  // distorted images with motion blur
  EXPECT_EQ(DescribeDepthContradiction(summary), "");
  summary.calibration.log_odds[kRegistration] = 24.0;
  summary.noise_scale.point_depth = 2.9;
  EXPECT_EQ(DescribeDepthContradiction(summary), "");
  summary.noise_scale.line_depth = 3.0;
  EXPECT_NE(DescribeDepthContradiction(summary), "");
  summary.calibration.is_corrected[kRegistration] = true;
  EXPECT_EQ(DescribeDepthContradiction(summary), "");
}

}  // namespace
}  // namespace msc_vo
