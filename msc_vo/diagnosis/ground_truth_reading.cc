// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/ground_truth_reading.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "msc_vo/evaluation/alignment_check.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr double kMaxOffset = 0.02;  // seconds
// Ratio of the disagreements by which another convention or other axes must be better.
constexpr double kBetter = 0.5;
// Disagreement of axes that the rotations alone show: free axes fit other sequences by chance at
// about 0.3.
constexpr double kSureDisagreement = 0.5 * kMaxDisagreement;
constexpr int kMaxIterations = 20;
constexpr double kOffsetResolution = 1e-3;  // seconds
constexpr double kResolution = 0.02;        // disagreement that errors of the images cause
// By which positions decide between readings, and for a reading with two changes. Wrong axes are
// off by 90 degrees or more, which lowers the correlation by about 1.
constexpr double kBetterCorrelation = 0.1, kMuchBetterCorrelation = 0.3;
constexpr double kMaxBodyAngle = 5.0;   // degrees
constexpr double kMaxAxisError = 15.0;  // degrees, of axes that are named

double Degrees(const Eigen::Matrix3d& rotation) {
  return RadiansToDegrees(Eigen::AngleAxisd(rotation).angle());
}

class ReadingSearch {
 public:
  ReadingSearch(const MotionTrack& track, const std::vector<TimedPose>& truth)
      : track_(track), truth_(truth) {}

  TruthReadings Run() const {
    TruthReading given;
    given.offset = OffsetOf(given);
    if (CompareMotions(track_, truth_, given).size() < kMinPairs) given.offset = 0.0;
    Rate(&given);
    std::vector<TruthReading> simple, combined;
    for (int c = 0; c < kNumPoseConventions; ++c) {
      TruthReading reading;
      reading.convention = static_cast<PoseConvention>(c);
      reading.offset = OffsetOf(reading);
      Rate(&reading);
      simple.push_back(reading);
      const TruthReading body = FitBody(reading);
      // Free axes fit other motions by chance; two changes at once more so.
      const bool is_supported = body.correlation.value_or(0.0) > kMinCorrelation ||
                                (c == 0 && body.disagreement < kSureDisagreement);
      if (Degrees(body.camera_from_body) > kMaxBodyAngle && is_supported &&
          body.disagreement < kBetter * reading.disagreement) {
        (c == 0 ? simple : combined).push_back(body);
      }
    }
    TruthReading best = Select(given, given, simple, kBetterCorrelation);
    // An inverse with other axes has the rotations of `w x y z`: prefer one change to two.
    std::vector<TruthReading> better;
    for (const TruthReading& reading : combined) {
      const bool has_better_rotations =
          best.disagreement > kResolution && reading.disagreement < kBetter * best.disagreement;
      const bool has_better_positions = reading.correlation.value_or(0.0) >
                                        best.correlation.value_or(1.0) + kMuchBetterCorrelation;
      if (has_better_rotations || has_better_positions) better.push_back(reading);
    }
    best = Select(given, best, better, kMuchBetterCorrelation);
    return {given, best};
  }

 private:
  // Several readings explain the rotations if the camera rotates about one or two axes only, or
  // differ only in the positions. The positions decide between them.
  static TruthReading Select(const TruthReading& given, TruthReading best,
                             const std::vector<TruthReading>& candidates,
                             double better_correlation) {
    for (const TruthReading& reading : candidates) {
      const bool is_better = reading.disagreement < kBetter * given.disagreement &&
                             reading.disagreement < kMaxDisagreement;
      if (is_better && reading.disagreement < best.disagreement) best = reading;
    }
    const double limit = std::max(best.disagreement, kResolution) / kBetter;
    for (const TruthReading& reading : candidates) {
      const bool is_better = reading.disagreement < kBetter * given.disagreement &&
                             reading.disagreement < std::min(limit, kMaxDisagreement);
      if (is_better && reading.correlation && best.correlation &&
          *reading.correlation > *best.correlation + better_correlation) {
        best = reading;
      }
    }
    return best;
  }

  // Axes of another body, as good as the free rotation shows.
  TruthReading FitBody(TruthReading reading) const {
    for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
      const std::vector<MotionComparison> comparisons = CompareMotions(track_, truth_, reading);
      if (comparisons.size() < kMinPairs) break;
      reading.camera_from_body = FitBodyRotation(comparisons);
      const double offset = OffsetOf(reading);
      if (std::abs(offset - reading.offset) < kOffsetResolution) break;
      reading.offset = offset;
    }
    Rate(&reading);
    TruthReading mirrored = reading;
    mirrored.is_mirrored = true;
    Rate(&mirrored);
    const bool is_mirrored = mirrored.disagreement < kSureDisagreement &&
                             mirrored.correlation.value_or(0.0) > kMinCorrelation;
    return is_mirrored ? mirrored : reading;
  }

  double OffsetOf(const TruthReading& reading) const {
    const std::optional<TimeOffset> offset = EstimateTimeOffset(track_, truth_, reading);
    return offset && offset->disagreement < kMaxDisagreement && IsSignificant(*offset)
               ? offset->seconds
               : 0.0;
  }

  void Rate(TruthReading* reading) const {
    const std::vector<MotionComparison> comparisons = CompareMotions(track_, truth_, *reading);
    if (comparisons.size() < kMinPairs) return;
    reading->disagreement = RotationDisagreement(comparisons, reading->camera_from_body);
    if (MedianTranslation(comparisons) < kMinTranslation) return;
    reading->correlation = FitSignificantHandEye(comparisons, reading->Axes()).correlation;
  }

  const MotionTrack& track_;
  const std::vector<TimedPose>& truth_;
};

// The closest matrix that permutes axes and changes their signs; zero columns if two axes are
// closest to the same one.
Eigen::Matrix3d NearestAxes(const Eigen::Matrix3d& axes) {
  Eigen::Matrix3d nearest = Eigen::Matrix3d::Zero();
  for (int column = 0; column < 3; ++column) {
    Eigen::Index row = 0;
    axes.col(column).cwiseAbs().maxCoeff(&row);
    if (nearest.row(row).isZero()) nearest(row, column) = axes(row, column) < 0.0 ? -1.0 : 1.0;
  }
  return nearest;
}

std::string NamesOf(const Eigen::Matrix3d& nearest) {
  std::string text;
  for (int column = 0; column < 3; ++column) {
    Eigen::Index row = 0;
    nearest.col(column).cwiseAbs().maxCoeff(&row);
    text += (column == 0 ? "its x, y, z are " : ", ") +
            std::string(nearest(row, column) < 0.0 ? "-" : "") + "xyz"[row];
  }
  return text + " of the camera";
}

// Names the camera axes of the body's axes if they are nearly parallel, and the turn otherwise.
std::string AxesText(const Eigen::Matrix3d& axes) {
  const Eigen::Matrix3d nearest = NearestAxes(axes);
  const Eigen::Matrix3d rest = nearest.transpose() * axes;
  const bool is_parallel = nearest.determinant() * axes.determinant() > 0.0 &&
                           !nearest.isIdentity() && Degrees(rest) < kMaxAxisError;
  if (is_parallel) {
    const double degrees = Degrees(rest);
    return NamesOf(nearest) +
           (degrees < kMaxBodyAngle ? "" : FormatText(" up to %.1f degrees", degrees));
  }
  if (axes.determinant() > 0.0) return "they are rotated by a " + DescribeTurn(axes);
  return "they are mirrored in all three axes and rotated by a " + DescribeTurn(-axes);
}

// Index of the only axis that is reversed; std::nullopt if others are changed.
std::optional<int> MirroredAxis(const Eigen::Matrix3d& axes) {
  const Eigen::Matrix3d nearest = NearestAxes(axes);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    signs(axis) = -1.0;
    const Eigen::Matrix3d mirror = signs.asDiagonal();
    if (nearest == mirror && Degrees(mirror * axes) < kMaxAxisError) return axis;
  }
  return std::nullopt;
}

ReadingDescription DescribeMirrored(const TruthReading& reading) {
  const std::optional<int> axis = MirroredAxis(reading.Axes());
  if (axis == 0) {
    return {"poses of a mirrored camera (images mirrored left to right, or a left-handed world)",
            "mirror the images or the poses"};
  }
  if (axis == 1) {
    return {"poses of a mirrored camera (wrong sign of fy, or a left-handed world)",
            "make fy negative if the images are mirrored top to bottom, as those of ICL-NUIM, and "
            "positive if they are not; or mirror the poses"};
  }
  return {"poses of a mirrored camera with other axes (mirrored images, or a left-handed world): " +
              AxesText(reading.Axes()),
          "convert the poses to a right-handed world and to a camera whose x points right, y down "
          "and z forward in the image"};
}

}  // namespace

std::vector<MotionComparison> CompareMotions(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             const TruthReading& reading) {
  return CompareMotions(track, ReadAs(reading.convention, truth), reading.offset);
}

std::optional<TimeOffset> EstimateTimeOffset(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             const TruthReading& reading) {
  return EstimateTimeOffset(track, ReadAs(reading.convention, truth), reading.camera_from_body,
                            kTimeOffsetReach);
}

bool IsSignificant(const TimeOffset& offset) {
  return std::abs(offset.seconds) > std::max(kMaxOffset, kSignificantSigmas * offset.sigma);
}

TruthReadings FindReading(const MotionTrack& track, const std::vector<TimedPose>& truth) {
  return ReadingSearch(track, truth).Run();
}

ReadingDescription DescribeReading(const TruthReading& reading) {
  const bool is_camera = reading.camera_from_body.isIdentity();
  const std::string convention =
      "the ground truth holds " + std::string(Describe(reading.convention));
  ReadingDescription description;
  if (reading.convention != PoseConvention::kCameraInWorld) {
    description = {convention,
                   "convert it to poses of the camera in the world, time tx ty tz qx qy qz qw"};
    if (is_camera) return description;
    description.text += ", and ";
    description.fix += "; ";
  }
  if (reading.is_mirrored) {
    const ReadingDescription mirrored = DescribeMirrored(reading);
    return {description.text + "the ground truth holds " + mirrored.text,
            description.fix + mirrored.fix};
  }
  description.text += "the axes of the ground truth are not those of the camera: " +
                      AxesText(reading.camera_from_body);
  description.fix += "rotate the poses, so that x points right, y down and z forward in the image";
  if (!reading.correlation) {
    description.fix +=
        ", unless the images are mirrored, which a camera that moves so little does not show";
  }
  return description;
}

}  // namespace msc_vo
