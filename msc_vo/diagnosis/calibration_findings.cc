// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>
#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/diagnosis/motion_calibration.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/self_calibration/calibration_bounds.h"
#include "msc_vo/sensor/depth_camera_correction.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using S = SensorCorrection;

constexpr char kFix[] = "run msc_vo calibrate";

// One part of a calibration, in words.
struct Part {
  CorrectionGroup group;
  std::string check;      // Finding::check
  std::string name;       // "focal length"
  std::string precision;  // "+- 0.6 px"
  std::string error;      // what is wrong, with the estimate, if it is corrected
  Measurement estimate;
  std::string fix = kFix;
};

class CalibrationFindings {
 public:
  CalibrationFindings(const Calibration& given, const MotionCalibration& calibration,
                      Findings* findings)
      : given_(given),
        estimate_(calibration.estimate),
        edges_contradict_(calibration.edges_contradict),
        estimated_(Corrected(given, calibration.estimate.correction)),
        findings_(findings) {}

  void Run() {
    AddFocalLength();
    AddPrincipalPoint();
    AddLens();
    AddRegistration();
  }

 private:
  bool IsCorrected(CorrectionGroup group) const {
    return estimate_.is_corrected[static_cast<size_t>(group)];
  }

  void Add(const Part& part) {
    if (IsCorrected(part.group)) {
      findings_->push_back(Warning(part.check, part.error, part.fix, part.estimate));
      return;
    }
    findings_->push_back(Good(part.check, part.name + VerdictOn(part)));
  }

  // On a part that is not corrected.
  std::string VerdictOn(const Part& part) const {
    const int index = IndicesOf(part.group).front();
    if (!IsObservable(index, estimate_.sigma(index))) {
      return ": not tested, the motion does not determine it (" + part.precision +
             "); to test it, turn the camera slowly in all directions";
    }
    const double odds = std::exp(estimate_.log_odds[static_cast<size_t>(part.group)]);
    if (odds < kCandidateOdds) return " agrees with the motion, " + part.precision;
    // Large odds without a correction: the errors of all groups together are not significant.
    const std::string number = odds > 99.0 ? "above 99" : FormatText("%.1f", odds);
    return ": in doubt, the odds that it is wrong are " + number + " to 1 (" + part.precision +
           "); to decide it, " + kFix;
  }

  void AddFocalLength() {
    const double given = given_.Recorded().fx;
    const double value = estimated_.Recorded().fx;
    const double sigma = value * estimate_.sigma(S::kFocalLength);
    const double ratio = given / value - 1.0;
    Add({CorrectionGroup::kFocalLength,
         "calibration.focal_length",
         "focal length",
         FormatText("+- %.1f px", sigma),
         FormatText("focal length %.1f %% too %s: estimated %.1f +- %.1f, given %.1f px",
                    100.0 * std::abs(ratio), ratio > 0.0 ? "long" : "short", value, sigma, given),
         {value, "px"}});
  }

  void AddPrincipalPoint() {
    const PinholeCamera& given = given_.Recorded();
    const PinholeCamera& value = estimated_.Recorded();
    const double x = value.cx - given.cx, y = value.cy - given.cy;
    const double sigma_x = given.FocalLength() * estimate_.sigma(S::kCenterX);
    const double sigma_y = given.FocalLength() * estimate_.sigma(S::kCenterY);
    Add({CorrectionGroup::kPrincipalPoint, "calibration.principal_point", "principal point",
         FormatText("+- %.1f, %.1f px", sigma_x, sigma_y),
         FormatText("principal point off by (%.1f, %.1f) px: estimated (%.1f +- %.1f, %.1f +- "
                    "%.1f), given (%.1f, %.1f) px",
                    -x, -y, value.cx, sigma_x, value.cy, sigma_y, given.cx, given.cy),
         Measurement{std::hypot(x, y), "px"},
         std::string(kFix) + "; cropped, scaled or mirrored images need changed values"});
  }

  void AddLens() {
    const auto& given = given_.distortion.k;
    const auto& value = estimated_.distortion.k;
    const double sigma_1 = estimate_.sigma(S::kK1), sigma_2 = estimate_.sigma(S::kK2);
    Add({CorrectionGroup::kLens,
         "calibration.lens",
         "lens",
         FormatText("k1 +- %.3f, k2 +- %.3f", sigma_1, sigma_2),
         FormatText("lens distortion: estimated k1 %.3f +- %.3f, k2 %.3f +- %.3f, given k1 %.3f, "
                    "k2 %.3f",
                    value[0], sigma_1, value[1], sigma_2, given[0], given[1]),
         {value[0], "k1"}});
  }

  void AddRegistration() {
    const std::string check = "calibration.depth_registration";
    const std::string name = "registration of depth to colour";
    if (edges_contradict_) {
      findings_->push_back(Good(check, name + ": not tested, the edges of the depth images "
                                              "contradict their motion"));
      return;
    }
    const DepthCamera camera = estimated_.depth_camera.value_or(
        RegisteredDepthCamera(estimated_.Recorded(), estimated_.distortion));
    const S::Vector& sigma = estimate_.sigma;
    Add({CorrectionGroup::kDepthRegistration,
         check,
         name,
         FormatText("magnification +- %.1f %%, roll +- %.2f degrees",
                    100.0 * sigma(S::kDepthFocalLength), RadiansToDegrees(sigma(S::kDepthRoll))),
         RegistrationError(camera),
         {camera.camera.fx, "px"}});
  }

  std::string RegistrationError(const DepthCamera& camera) const {
    const S::Vector& sigma = estimate_.sigma;
    const Eigen::Vector3d millimetres = 1000.0 * camera.depth_from_color.translation();
    return std::string(given_.depth_camera
                           ? "the given depth camera does not register depth to colour: it"
                           : "depth is not registered to colour: the depth camera") +
           FormatText(
               " seems to have fx %.1f +- %.1f px, to be turned by %.2f +- %.2f degrees, "
               "and depth_from_color (%.0f +- %.0f, %.0f +- %.0f) mm",
               camera.camera.fx, camera.camera.fx * sigma(S::kDepthFocalLength),
               RadiansToDegrees(camera.Roll()), RadiansToDegrees(sigma(S::kDepthRoll)),
               millimetres.x(), 1000.0 * sigma(S::kDepthParallaxX), millimetres.y(),
               1000.0 * sigma(S::kDepthParallaxY));
  }

  const Calibration& given_;
  const CorrectionEstimate& estimate_;
  bool edges_contradict_;
  Calibration estimated_;
  Findings* findings_;
};

}  // namespace

void AddCalibrationFindings(const Calibration& given, const MotionCalibration& calibration,
                            Findings* findings) {
  S::Vector correction = calibration.estimate.correction;
  correction.segment<2>(S::kDepthOffset) = calibration.estimate.depth_errors;
  const std::string implausible = DescribeImplausible({given.camera, given.distortion}, correction);
  if (!implausible.empty()) {
    findings->push_back(Error("calibration", "no calibration makes the scene rigid: " + implausible,
                              "check that the depth images hold depth along the optical axis and "
                              "belong to the colour images, and that the given focal length is "
                              "that of this image size"));
    return;
  }
  CalibrationFindings(given, calibration, findings).Run();
}

}  // namespace msc_vo
