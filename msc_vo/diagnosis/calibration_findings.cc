// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/calibration_findings.h"

#include <cmath>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr double kSigmas = 3.0;
// Deviations that are usual in well calibrated sequences, see docs/usage.md.
constexpr double kFocalLength = 0.02;     // relative
constexpr double kPrincipalPoint = 12.0;  // pixels at an image width of 640
constexpr double kDistortion = 0.05;      // k1
// Standard deviations with which an estimate decides nothing.
constexpr double kMaxFocalSigma = 0.015, kMaxPointSigma = 10.0, kMaxDistortionSigma = 0.015;

bool Differs(double difference, double sigma, double usual) {
  return std::abs(difference) > kSigmas * sigma && std::abs(difference) > usual;
}

void AddFocalLength(const CalibrationEstimate& estimate, Findings* findings) {
  const double given = estimate.given_focal_length;
  const Estimate& focal = estimate.focal_length;
  const double ratio = given / focal.value - 1.0;
  const double sigma = focal.sigma / focal.value;
  if (sigma > kMaxFocalSigma) {
    findings->push_back(
        Good("calibration.focal_length",
             FormatText("focal length: not tested, the motion does not determine it (%.0f +- %.0f "
                        "px); to test it, turn the camera slowly in all directions",
                        focal.value, focal.sigma)));
    return;
  }
  const Measurement measurement{focal.value, "px"};
  const std::string numbers =
      FormatText("estimated %.1f +- %.1f, given %.1f px", focal.value, focal.sigma, given);
  if (!Differs(ratio, sigma, kFocalLength)) {
    findings->push_back(Good("calibration.focal_length", "focal length: " + numbers, measurement));
    return;
  }
  findings->push_back(Warning("calibration.focal_length",
                              FormatText("focal length %.1f %% too %s: ", 100.0 * std::abs(ratio),
                                         ratio > 0.0 ? "long" : "short") +
                                  numbers,
                              "calibrate the camera, or give the calibration of this image size",
                              measurement));
}

void AddPrincipalPoint(const CalibrationEstimate& estimate, int width, Findings* findings) {
  const double scale = width / 640.0;
  const double x = estimate.cx.value - estimate.given_cx;
  const double y = estimate.cy.value - estimate.given_cy;
  if (std::fmax(estimate.cx.sigma, estimate.cy.sigma) > kMaxPointSigma * scale) {
    findings->push_back(
        Good("calibration.principal_point",
             FormatText("principal point: not tested, the motion does not determine it (+- %.0f, "
                        "%.0f px)",
                        estimate.cx.sigma, estimate.cy.sigma)));
    return;
  }
  const std::string text =
      FormatText("principal point: estimated (%.1f +- %.1f, %.1f +- %.1f), given (%.1f, %.1f) px",
                 estimate.cx.value, estimate.cx.sigma, estimate.cy.value, estimate.cy.sigma,
                 estimate.given_cx, estimate.given_cy);
  const Measurement measurement{std::hypot(x, y), "px"};
  if (!Differs(x, estimate.cx.sigma, kPrincipalPoint * scale) &&
      !Differs(y, estimate.cy.sigma, kPrincipalPoint * scale)) {
    findings->push_back(Good("calibration.principal_point", text, measurement));
    return;
  }
  findings->push_back(Warning("calibration.principal_point",
                              FormatText("principal point off by (%.0f, %.0f) px; ", -x, -y) + text,
                              "calibrate the camera; cropped, scaled or mirrored images need "
                              "changed values",
                              measurement));
}

void AddDistortion(const CalibrationEstimate& estimate, Findings* findings) {
  const Estimate& k1 = estimate.k1;
  if (k1.sigma > kMaxDistortionSigma) {
    findings->push_back(Good("calibration.lens",
                             FormatText("lens: not tested, the motion does not determine it (k1 +- "
                                        "%.2f)",
                                        k1.sigma)));
    return;
  }
  const std::string text =
      FormatText("radial distortion beyond the given lens: k1 = %.3f +- %.3f", k1.value, k1.sigma);
  const Measurement measurement{k1.value, "k1"};
  if (!Differs(k1.value, k1.sigma, kDistortion)) {
    findings->push_back(Good("calibration.lens", text, measurement));
    return;
  }
  findings->push_back(Warning("calibration.lens", text,
                              "give the lens distortion k1 k2 p1 p2 k3 in camera.txt, or "
                              "undistort the images (colour and depth)",
                              measurement));
}

}  // namespace

void AddCalibrationFindings(const CalibrationEstimate& estimate, int width, Findings* findings) {
  AddFocalLength(estimate, findings);
  AddPrincipalPoint(estimate, width, findings);
  AddDistortion(estimate, findings);
}

}  // namespace msc_vo
