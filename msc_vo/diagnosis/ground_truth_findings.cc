// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "msc_vo/diagnosis/depth_quality.h"
#include "msc_vo/diagnosis/ground_truth_motion.h"
#include "msc_vo/diagnosis/ground_truth_reading.h"
#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr double kMinRotation = 0.03;  // radians, median of the pairs
constexpr double kMaxScaleError = 0.025;

class GroundTruthComparison {
 public:
  GroundTruthComparison(const MotionTrack& track, const std::vector<TimedPose>& truth,
                        const DepthUnits& units, bool is_calibrated, Findings* findings)
      : track_(track),
        truth_(truth),
        units_(units),
        is_calibrated_(is_calibrated),
        findings_(findings) {}

  void Run() {
    const std::vector<MotionComparison> given = CompareMotions(track_, truth_, TruthReading());
    const std::string obstacle = DescribeObstacle(given);
    if (!obstacle.empty()) {
      findings_->push_back(
          Good("ground_truth.convention", "ground truth against motion: not tested, " + obstacle));
      return;
    }
    const TruthReadings readings = FindReading(track_, truth_);
    if (!Judge(readings.given, readings.best)) return;
    AddTimeOffset(readings.best);
    AddTranslations(readings.best);
  }

 private:
  // Why the motions decide nothing; empty if they do.
  std::string DescribeObstacle(const std::vector<MotionComparison>& motions) const {
    if (motions.size() < kMinPairs) {
      const std::string weak =
          track_.num_weak > 0 ? FormatText(", %d have a weak pose", track_.num_weak) : "";
      return FormatText("%zu of %d images are tracked", track_.images.size(), track_.num_images) +
             weak +
             FormatText(", and %zu pairs of tracked images have ground truth, %zu needed",
                        motions.size(), kMinPairs);
    }
    const double rotation = MedianRotation(motions);
    if (rotation >= kMinRotation) return "";
    return FormatText(
        "the camera turns too little: by %.1f degrees in the median pair of images, "
        "%.1f needed",
        RadiansToDegrees(rotation), RadiansToDegrees(kMinRotation));
  }

  static double MedianRotation(const std::vector<MotionComparison>& comparisons) {
    std::vector<double> rotations;
    for (const MotionComparison& c : comparisons) rotations.push_back(c.image_rotation.norm());
    return UpperMedian(std::move(rotations));
  }

  // Adds the finding on the convention. Returns whether a reading agrees with the images.
  bool Judge(const TruthReading& given, const TruthReading& best) {
    const std::string check = "ground_truth.convention";
    const Measurement measurement{given.disagreement, "ratio"};
    if (best.disagreement > kMaxDisagreement) {
      findings_->push_back(
          Warning(check,
                  FormatText("the ground truth does not describe the motion of these images: its "
                             "rotations differ by %.0f %% from those of the images, whatever its "
                             "convention",
                             100.0 * given.disagreement),
                  "is it of another sequence or on another clock? Poses must be those of the "
                  "camera in the world, x right, y down, z forward",
                  measurement));
      return false;
    }
    const bool is_as_given =
        best.convention == PoseConvention::kCameraInWorld && best.camera_from_body.isIdentity();
    if (is_as_given) {
      findings_->push_back(
          Good(check,
               FormatText("ground truth: camera in world, rotations differ by %.0f "
                          "%% from those of the images",
                          100.0 * given.disagreement),
               measurement));
      return true;
    }
    const ReadingDescription description = DescribeReading(best);
    findings_->push_back(Warning(
        check,
        description.text + FormatText(" (rotations differ by %.0f %% from those of the images as "
                                      "they are, by %.0f %% if read so)",
                                      100.0 * given.disagreement, 100.0 * best.disagreement),
        description.fix, measurement));
    return true;
  }

  void AddTimeOffset(const TruthReading& reading) {
    const std::optional<TimeOffset> offset = EstimateTimeOffset(track_, truth_, reading);
    const std::string check = "ground_truth.time_offset";
    if (!offset) {
      findings_->push_back(Good(check,
                                "time offset of the ground truth: not tested, the camera "
                                "turns too little, or too few consecutive images are tracked"));
      return;
    }
    if (kSignificantSigmas * offset->sigma > kTimeOffsetReach) {
      findings_->push_back(
          Good(check, FormatText("time offset of the ground truth: not tested, the "
                                 "motion determines it to +- %.0f ms only",
                                 1e3 * offset->sigma)));
      return;
    }
    const Measurement measurement{offset->seconds, "s"};
    const std::string text = FormatText("the ground truth is %.0f +- %.0f ms %s than the images",
                                        1e3 * std::abs(offset->seconds), 1e3 * offset->sigma,
                                        offset->seconds > 0.0 ? "later" : "earlier");
    findings_->push_back(MakeFinding(
        IsSignificant(*offset) ? Severity::kWarning : Severity::kGood, check, text,
        FormatText("%s %.3f s %s its stamps", offset->seconds > 0.0 ? "subtract" : "add",
                   std::abs(offset->seconds), offset->seconds > 0.0 ? "from" : "to"),
        measurement));
  }

  void AddTranslations(const TruthReading& reading) {
    const std::vector<MotionComparison> comparisons = CompareMotions(track_, truth_, reading);
    if (comparisons.size() < kMinPairs) return;
    const double translation = MedianTranslation(comparisons);
    if (translation < kMinTranslation) {
      findings_->push_back(
          Good("ground_truth.positions",
               FormatText("positions of the ground truth: not tested, the camera moves too little: "
                          "by %.0f mm in the median pair of images, %.0f needed",
                          1e3 * translation, 1e3 * kMinTranslation)));
      return;
    }
    const HandEye hand_eye = FitSignificantHandEye(comparisons, reading.Axes());
    if (hand_eye.correlation < kMinCorrelation) {
      findings_->push_back(
          Warning("ground_truth.positions",
                  FormatText("the rotations of the ground truth agree with the images, its "
                             "positions do not (correlation %.2f): swapped or mirrored axes",
                             hand_eye.correlation),
                  "write positions and rotations in the same right-handed world",
                  Measurement{hand_eye.correlation, "correlation"}));
      return;
    }
    AddScale(hand_eye);
    AddOffset(FitHandEye(comparisons, reading.Axes()));
  }

  void AddScale(const HandEye& hand_eye) {
    const double ratio = 1.0 / hand_eye.scale;  // of the lengths from depth to the true ones
    const double sigma = hand_eye.scale_sigma / (hand_eye.scale * hand_eye.scale);
    if (!hand_eye.HasScale()) {
      findings_->push_back(Good("ground_truth.scale",
                                FormatText("scale: not tested, the camera moves too little (%.2f "
                                           "+- %.2f)",
                                           ratio, sigma)));
      return;
    }
    const std::string text = FormatText(
        "lengths from depth are %.3f +- %.3f times those of the "
        "ground truth",
        ratio, sigma);
    const Measurement measurement{ratio, "ratio"};
    if (!is_calibrated_) {
      findings_->push_back(Good("ground_truth.scale",
                                "scale: not tested, since the calibration is wrong; " + text,
                                measurement));
      return;
    }
    const bool is_good =
        std::abs(ratio - 1.0) <= std::max(kMaxScaleError, kSignificantSigmas * sigma);
    findings_->push_back(MakeFinding(
        is_good ? Severity::kGood : Severity::kWarning, "ground_truth.scale", text,
        units_.Option() +
            FormatText(units_.are_floats ? " is probably %.4g units per metre, not %.4g"
                                         : " is probably %.0f raw units per metre, not %.1f",
                       NearestScale(units_.per_metre * ratio, sigma / ratio), units_.per_metre) +
            " (or the ground truth is not in metres)",
        measurement));
  }

  // The common scale that an estimate with a relative standard deviation means, or the estimate.
  double NearestScale(double scale, double sigma) const {
    for (const double common : units_.CommonScales()) {
      if (std::abs(scale / common - 1.0) < std::max(0.005, 2.0 * sigma)) return common;
    }
    return scale;
  }

  void AddOffset(const HandEye& hand_eye) {
    const double length = hand_eye.offset.norm();
    const std::string text = FormatText(
        "the body of the ground truth is at (%.3f, %.3f, %.3f) +- %.3f m in the camera's frame",
        hand_eye.offset.x(), hand_eye.offset.y(), hand_eye.offset.z(), hand_eye.offset_sigma);
    const Measurement measurement{length, "m"};
    if (!hand_eye.HasScale()) {
      findings_->push_back(
          Good("ground_truth.hand_eye",
               "body of the ground truth: not tested, the camera moves too little"));
      return;
    }
    findings_->push_back(MakeFinding(
        hand_eye.HasOffset() ? Severity::kWarning : Severity::kGood, "ground_truth.hand_eye", text,
        "transform the ground truth to the optical centre of the colour "
        "camera (hand-eye calibration)",
        measurement));
  }

  const MotionTrack& track_;
  const std::vector<TimedPose>& truth_;
  DepthUnits units_;
  bool is_calibrated_;
  Findings* findings_;
};

}  // namespace

void AddGroundTruthMotionFindings(const MotionTrack& track, const std::vector<TimedPose>& truth,
                                  const DepthUnits& units, bool is_calibrated, Findings* findings) {
  if (truth.empty()) return;
  GroundTruthComparison(track, truth, units, is_calibrated, findings).Run();
}

}  // namespace msc_vo
