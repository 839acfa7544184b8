// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/ground_truth_findings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include <Eigen/Geometry>

#include "msc_vo/diagnosis/ground_truth_motion.h"
#include "msc_vo/diagnosis/time_offset.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr size_t kMinPairs = 8;
constexpr double kMinRotation = 0.03;  // radians, median of the pairs
// Disagreement of rotations up to which ground truth and images belong together, and ratio by which
// another convention must be better.
constexpr double kAgrees = 0.35, kBetter = 0.5;
constexpr double kMaxBodyAngle = 5.0;  // degrees
constexpr double kReach = 0.5;         // seconds, of the search for a time offset
constexpr double kMaxOffset = 0.02;    // seconds
constexpr double kMaxScaleError = 0.025;
constexpr double kMaxScaleSigma = 0.05;  // relative, with which an estimate decides nothing
constexpr double kMaxLever = 0.04;       // metres
// Standard deviations of the hand-eye offset beforehand, metres: unknown, and none.
constexpr double kOffsetPrior = 0.5, kNoOffset = 1e-3;
constexpr double kMinCorrelation = 0.6;   // of translations
constexpr double kMinTranslation = 0.03;  // metres, median of the pairs
constexpr double kSigmas = 4.0;

// How the ground truth must be read.
struct Reading {
  PoseConvention convention = PoseConvention::kCameraInWorld;
  Eigen::Matrix3d camera_from_body = Eigen::Matrix3d::Identity();
  double offset = 0.0;        // seconds
  double disagreement = 1e9;  // of the rotations
};

class GroundTruthComparison {
 public:
  GroundTruthComparison(const MotionTrack& track, const std::vector<TimedPose>& truth,
                        double depth_scale, bool is_calibrated, Findings* findings)
      : track_(track),
        truth_(truth),
        depth_scale_(depth_scale),
        is_calibrated_(is_calibrated),
        findings_(findings) {}

  void Run() {
    const std::vector<MotionComparison> given = Compare(Reading());
    if (given.size() < kMinPairs || MedianRotation(given) < kMinRotation) {
      findings_->push_back(Good("ground_truth.convention",
                                "ground truth against motion: not tested, too few images with "
                                "ground truth match, or the camera turns too little"));
      return;
    }
    const std::optional<Reading> reading = FindReading();
    if (!reading) return;
    AddTimeOffset(*reading);
    AddTranslations(*reading);
  }

 private:
  std::vector<MotionComparison> Compare(const Reading& reading) const {
    return CompareMotions(track_, ReadAs(reading.convention, truth_), reading.convention,
                          reading.offset);
  }

  static double MedianRotation(const std::vector<MotionComparison>& comparisons) {
    std::vector<double> rotations;
    for (const MotionComparison& c : comparisons) rotations.push_back(c.image_rotation.norm());
    std::nth_element(rotations.begin(), rotations.begin() + rotations.size() / 2, rotations.end());
    return rotations[rotations.size() / 2];
  }

  // The best time offset and disagreement for a reading of the ground truth.
  void Rate(Reading* reading) const {
    const std::vector<MotionComparison> comparisons = Compare(*reading);
    reading->disagreement = comparisons.size() < kMinPairs
                                ? 1e9
                                : RotationDisagreement(comparisons, reading->camera_from_body);
  }

  // Adds the finding on the convention. Returns std::nullopt if no reading agrees with the images.
  std::optional<Reading> FindReading() {
    Reading given;
    given.offset = OffsetOf(given);
    Rate(&given);
    Reading best = given;
    for (int c = 1; c < kNumPoseConventions; ++c) {
      Reading reading;
      reading.convention = static_cast<PoseConvention>(c);
      reading.offset = OffsetOf(reading);
      Rate(&reading);
      if (reading.disagreement < kBetter * given.disagreement &&
          reading.disagreement < best.disagreement) {
        best = reading;
      }
    }
    if (best.convention == PoseConvention::kCameraInWorld) {
      // Axes of another body, as good as the free rotation shows.
      Reading body = given;
      body.camera_from_body = FitBodyRotation(Compare(body));
      const double degrees = Degrees(body.camera_from_body);
      Rate(&body);
      if (degrees > kMaxBodyAngle && body.disagreement < kBetter * given.disagreement) best = body;
    }
    return Judge(given, best);
  }

  std::optional<Reading> Judge(const Reading& given, const Reading& best) {
    const std::string check = "ground_truth.convention";
    const Measurement measurement{given.disagreement, "ratio"};
    if (best.disagreement > kAgrees) {
      findings_->push_back(
          Warning(check,
                  FormatText("the ground truth does not describe the motion of these images: its "
                             "rotations differ by %.0f %% from those of the images, whatever its "
                             "convention",
                             100.0 * given.disagreement),
                  "is it of another sequence or on another clock? Poses must be those of the "
                  "camera in the world, x right, y down, z forward",
                  measurement));
      return std::nullopt;
    }
    const std::string difference = FormatText(
        " (rotations differ by %.0f %% from those of the images as they are, by %.0f %% "
        "if read so)",
        100.0 * given.disagreement, 100.0 * best.disagreement);
    if (best.convention != PoseConvention::kCameraInWorld) {
      findings_->push_back(Warning(
          check, "the ground truth holds " + std::string(Describe(best.convention)) + difference,
          best.convention == PoseConvention::kMirrored
              ? "mirror the images or the poses; a negative fy tells of images that are mirrored "
                "top to bottom"
              : "convert it to poses of the camera in the world, time tx ty tz qx qy qz qw",
          measurement));
      return best;
    }
    if (!best.camera_from_body.isIdentity()) {
      findings_->push_back(
          Warning(check,
                  "the axes of the ground truth are not those of the camera: " +
                      AxesText(best.camera_from_body) + difference,
                  "rotate the poses, so that x points right, y down and z forward in the image",
                  measurement));
      return best;
    }
    findings_->push_back(Good(check,
                              FormatText("ground truth: camera in world, rotations differ by %.0f "
                                         "%% from those of the images",
                                         100.0 * given.disagreement),
                              measurement));
    return best;
  }

  static double Degrees(const Eigen::Matrix3d& rotation) {
    return Eigen::AngleAxisd(rotation).angle() * 180.0 / std::acos(-1.0);
  }

  // Names the camera axes of the body's axes if they are parallel, and the angle otherwise.
  static std::string AxesText(const Eigen::Matrix3d& camera_from_body) {
    constexpr double kParallel = 0.97;
    std::string text;
    for (int column = 0; column < 3; ++column) {
      Eigen::Index row = 0;
      const double value = camera_from_body.col(column).cwiseAbs().maxCoeff(&row);
      if (value < kParallel) {
        return FormatText("they are rotated by %.1f degrees", Degrees(camera_from_body));
      }
      text += (column == 0 ? "its x, y, z are " : ", ") +
              std::string(camera_from_body(row, column) < 0.0 ? "-" : "") + "xyz"[row];
    }
    return text + " of the camera";
  }

  double OffsetOf(const Reading& reading) const {
    const std::optional<TimeOffset> offset = Offset(reading);
    const bool significant =
        offset && offset->disagreement < kAgrees &&
        std::abs(offset->seconds) > std::max(kMaxOffset, kSigmas * offset->sigma);
    return significant ? offset->seconds : 0.0;
  }

  std::optional<TimeOffset> Offset(const Reading& reading) const {
    if (reading.convention == PoseConvention::kMirrored) return std::nullopt;
    return EstimateTimeOffset(track_, ReadAs(reading.convention, truth_), reading.camera_from_body,
                              kReach);
  }

  void AddTimeOffset(const Reading& reading) {
    const std::optional<TimeOffset> offset = Offset(reading);
    const std::string check = "ground_truth.time_offset";
    if (!offset) {
      findings_->push_back(Good(check,
                                "time offset of the ground truth: not tested, the camera "
                                "turns too little"));
      return;
    }
    const Measurement measurement{offset->seconds, "s"};
    const std::string text = FormatText("the ground truth is %.0f +- %.0f ms %s than the images",
                                        1e3 * std::abs(offset->seconds), 1e3 * offset->sigma,
                                        offset->seconds > 0.0 ? "later" : "earlier");
    if (std::abs(offset->seconds) <= std::max(kMaxOffset, kSigmas * offset->sigma)) {
      findings_->push_back(Good(check, text, measurement));
      return;
    }
    findings_->push_back(
        Warning(check, text,
                FormatText("%s %.3f s %s its stamps", offset->seconds > 0.0 ? "subtract" : "add",
                           std::abs(offset->seconds), offset->seconds > 0.0 ? "from" : "to"),
                measurement));
  }

  void AddTranslations(const Reading& reading) {
    const std::vector<MotionComparison> comparisons = Compare(reading);
    if (comparisons.size() < kMinPairs) return;
    std::vector<double> lengths;
    for (const MotionComparison& c : comparisons) lengths.push_back(c.true_translation.norm());
    std::nth_element(lengths.begin(), lengths.begin() + lengths.size() / 2, lengths.end());
    if (lengths[lengths.size() / 2] < kMinTranslation) return;
    const HandEye free = FitHandEye(comparisons, reading.camera_from_body, kOffsetPrior);
    // Turning about a near point resembles a translation: an offset that is not significant must
    // neither blur the scale nor explain wrong positions.
    const HandEye hand_eye =
        HasOffset(free) ? free : FitHandEye(comparisons, reading.camera_from_body, kNoOffset);
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
    AddOffset(free);
  }

  static bool HasScale(const HandEye& hand_eye) {
    return hand_eye.scale_sigma <= kMaxScaleSigma * hand_eye.scale;
  }

  // Without a scale, the offset explains what the scale leaves.
  static bool HasOffset(const HandEye& hand_eye) {
    return HasScale(hand_eye) &&
           hand_eye.offset.norm() > std::max(kMaxLever, kSigmas * hand_eye.offset_sigma);
  }

  void AddScale(const HandEye& hand_eye) {
    const double ratio = 1.0 / hand_eye.scale;  // of the lengths from depth to the true ones
    const double sigma = hand_eye.scale_sigma / (hand_eye.scale * hand_eye.scale);
    if (!HasScale(hand_eye)) {
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
    if (std::abs(ratio - 1.0) <= std::max(kMaxScaleError, kSigmas * sigma)) {
      findings_->push_back(Good("ground_truth.scale", text, measurement));
      return;
    }
    findings_->push_back(Warning(
        "ground_truth.scale", text,
        FormatText("depth_scale is probably %.0f raw units per metre, not %.1f (or the ground "
                   "truth is not in metres)",
                   NearestScale(depth_scale_ * ratio, sigma / ratio), depth_scale_),
        measurement));
  }

  // The common scale that an estimate with a relative standard deviation means, or the estimate.
  static double NearestScale(double scale, double sigma) {
    for (const double common : {1000.0, 5000.0, 5208.0, 6553.5, 256.0, 10000.0, 4000.0}) {
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
    if (!HasScale(hand_eye)) {
      findings_->push_back(
          Good("ground_truth.hand_eye",
               "body of the ground truth: not tested, the camera moves too little"));
      return;
    }
    if (!HasOffset(hand_eye)) {
      findings_->push_back(Good("ground_truth.hand_eye", text, measurement));
      return;
    }
    findings_->push_back(Warning("ground_truth.hand_eye", text,
                                 "transform the ground truth to the optical centre of the colour "
                                 "camera (hand-eye calibration)",
                                 measurement));
  }

  const MotionTrack& track_;
  const std::vector<TimedPose>& truth_;
  double depth_scale_;
  bool is_calibrated_;
  Findings* findings_;
};

}  // namespace

void AddGroundTruthMotionFindings(const MotionTrack& track, const std::vector<TimedPose>& truth,
                                  double depth_scale, bool is_calibrated, Findings* findings) {
  if (truth.empty()) return;
  GroundTruthComparison(track, truth, depth_scale, is_calibrated, findings).Run();
}

}  // namespace msc_vo
