// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/evaluation/alignment_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/rigid_alignment.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using Poses = std::vector<Rigid3>;

// Second moments of the positions about their means, square metres.
struct Moments {
  double reference = 0.0;
  double estimate = 0.0;
  // Of both, in the axes of the alignment; the last one is negative for a reflection.
  Eigen::Vector3d common = Eigen::Vector3d::Zero();
};

Eigen::Matrix3Xd CentredPositions(const Poses& poses, size_t begin, size_t end) {
  Eigen::Matrix3Xd positions(3, end - begin);
  for (size_t i = begin; i < end; ++i) {
    positions.col(static_cast<Eigen::Index>(i - begin)) = poses[i].translation();
  }
  const Eigen::Vector3d mean = positions.rowwise().mean();
  return positions.colwise() - mean;
}

Moments MomentsOf(const Poses& reference, const Poses& estimate, size_t begin, size_t end) {
  const Eigen::Matrix3Xd y = CentredPositions(reference, begin, end);
  const Eigen::Matrix3Xd x = CentredPositions(estimate, begin, end);
  const double count = static_cast<double>(end - begin);
  const Eigen::Matrix3d correlation = y * x.transpose() / count;
  Moments moments{y.squaredNorm() / count, x.squaredNorm() / count};
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(correlation);
  // Eigen leaves the singular values undefined if the squares overflow.
  if (svd.info() == Eigen::Success) moments.common = svd.singularValues();
  if (correlation.determinant() < 0.0) moments.common.z() *= -1.0;
  return moments;
}

// Positions are written with so many digits.
double Rounding(const Poses& poses) {
  double largest = 0.0;
  for (const Rigid3& pose : poses) {
    largest = std::max(largest, pose.translation().cwiseAbs().maxCoeff());
  }
  return 1e-9 * (1.0 + largest);
}

std::string Millimetres(double square_metres) {
  return FormatText("%.3g mm", 1e3 * std::sqrt(std::max(square_metres, 0.0)));
}

// Ends of parts of the reference path that have the same length.
std::vector<size_t> DividePath(const Poses& reference, int num_parts) {
  std::vector<double> lengths = {0.0};
  for (size_t i = 1; i < reference.size(); ++i) {
    lengths.push_back(lengths.back() +
                      (reference[i].translation() - reference[i - 1].translation()).norm());
  }
  std::vector<size_t> ends = {0};
  for (int part = 1; part < num_parts; ++part) {
    const double length = lengths.back() * part / num_parts;
    ends.push_back(static_cast<size_t>(std::lower_bound(lengths.begin(), lengths.end(), length) -
                                       lengths.begin()));
  }
  ends.push_back(reference.size());
  return ends;
}

// Residual of the orientations after alignment, radians (RMS).
double OrientationError(const Poses& reference, const Poses& estimate) {
  const Eigen::Quaterniond rotation(AlignPoses(estimate, reference).rotation());
  double sum = 0.0;
  for (size_t i = 0; i < reference.size(); ++i) {
    const double angle = Eigen::Quaterniond(reference[i].rotation())
                             .angularDistance(rotation * estimate[i].rotation());
    sum += angle * angle;
  }
  return std::sqrt(sum / static_cast<double>(reference.size()));
}

// Poses whose quaternions were in the file with the scalar first, but were read with the scalar
// last, or the other way round.
Poses Reordered(Poses poses, bool scalar_was_first) {
  for (Rigid3& pose : poses) {
    const Eigen::Vector4d c = Eigen::Quaterniond(pose.rotation()).coeffs();  // x y z w
    pose = Rigid3(scalar_was_first ? Eigen::Quaterniond(c(0), c(1), c(2), c(3))
                                   : Eigen::Quaterniond(c(2), c(3), c(0), c(1)),
                  pose.translation());
  }
  return poses;
}

}  // namespace

bool IsStatic(const Poses& poses) {
  const double rounding = Rounding(poses);
  return std::all_of(poses.begin(), poses.end(), [&](const Rigid3& pose) {
    return (pose.translation() - poses.front().translation()).norm() <= rounding;
  });
}

std::string DescribeUndetermined(const Poses& reference, const Poses& estimate, bool with_scale) {
  for (const auto& [poses, name] :
       {std::pair(&reference, "reference"), std::pair(&estimate, "estimate")}) {
    if (!IsStatic(*poses)) continue;
    return std::string("all positions of the ") + name +
           " are the same, which determines no rotation" + (with_scale ? " and no scale" : "") +
           " of the alignment";
  }
  const Moments moments = MomentsOf(reference, estimate, 0, reference.size());
  const double scale = with_scale ? moments.common.sum() / moments.estimate : 1.0;
  const double squares = moments.reference + scale * scale * moments.estimate;
  constexpr double kEpsilon = 1e-14;  // rounding of the moments
  const double error = std::max({squares - 2.0 * scale * moments.common.sum(), kEpsilon * squares,
                                 std::pow(Rounding(reference) + Rounding(estimate), 2.0)});
  if (!(scale * moments.common.sum() > error)) {  // also if the squares overflow
    return "the error of the positions (" + Millimetres(error) +
           ") exceeds the motion that both trajectories share (" +
           Millimetres(scale * moments.common.sum()) + "), which determines no rotation" +
           (with_scale ? " and no scale" : "") + " of the alignment";
  }
  if (scale * (moments.common.y() + moments.common.z()) <= error) {
    return "the positions are on a straight line up to their error, which determines no rotation "
           "of the alignment about that line";
  }
  return "";
}

std::string DescribeScaleContradiction(const Poses& reference, const Poses& estimate) {
  constexpr int kParts = 5;
  constexpr size_t kMinPoses = 3;         // of a part
  constexpr double kMinExplained = 0.75;  // of the variance: noise is at most half of the motion
  constexpr double kQuantile = 8.61;      // of the t-distribution, two-sided 99.9 %, kParts - 1 = 4
  const double sensor_error = std::log(1.1);  // above that of any depth sensor, a few percent
  std::array<double, kParts> bounds[2];       // as if the reference is longer, as if it is shorter
  const std::vector<size_t> ends = DividePath(reference, kParts);
  for (int i = 0; i < kParts; ++i) {
    if (ends[i + 1] < ends[i] + kMinPoses) return "";
    const Moments moments = MomentsOf(reference, estimate, ends[i], ends[i + 1]);
    const double common = moments.common.sum();
    const double explained = common * common / (moments.reference * moments.estimate);
    if (!(common > 0.0 && explained >= kMinExplained)) return "";
    bounds[0][i] = std::log(common / moments.estimate);
    bounds[1][i] = -std::log(moments.reference / common);
  }
  for (const std::array<double, kParts>& bound : bounds) {
    const Eigen::Map<const Eigen::Array<double, kParts, 1>> values(bound.data());
    const double mean = values.mean();
    const double sigma = std::sqrt((values - mean).square().sum() / (kParts * (kParts - 1)));
    if (mean - kQuantile * sigma <= sensor_error) continue;
    const bool is_longer = &bound == &bounds[0];
    const Moments all = MomentsOf(reference, estimate, 0, reference.size());
    const double ratio = std::sqrt(all.reference / all.estimate);
    const double factor = is_longer ? ratio : 1.0 / ratio;
    return FormatText(
        "the %s path is %.*f times as long as the %s: depth units? (depth_scale, or "
        "a reference that is not in metres)",
        is_longer ? "reference" : "estimated", factor < 100.0 ? 1 : 0, factor,
        is_longer ? "estimate" : "reference");
  }
  return "";
}

std::string DescribeQuaternionOrder(const Poses& reference, const Poses& estimate) {
  constexpr double kRounding = 0.01;  // radians, of quaternions with two decimals
  // The ratio of the variances is the 99 % quantile of the F-distribution with 5 and 5 degrees of
  // freedom, few because errors of a trajectory are correlated.
  constexpr double kBetter = 0.3;
  const double given = OrientationError(reference, estimate);
  if (given <= kRounding) return "";
  // Both trajectories agree just as well if the other one is misread in the same way.
  struct Reading {
    bool of_reference;
    bool scalar_was_first;
    double error;  // radians
  };
  std::vector<Reading> readings;
  double best = kBetter * given;
  for (const bool scalar_was_first : {true, false}) {
    for (const bool of_reference : {true, false}) {
      const Poses read = Reordered(of_reference ? reference : estimate, scalar_was_first);
      const double error =
          of_reference ? OrientationError(read, estimate) : OrientationError(reference, read);
      best = std::min(best, error);
      if (error < kBetter * given) readings.push_back({of_reference, scalar_was_first, error});
    }
  }
  std::string text;
  for (const Reading& reading : readings) {
    if (reading.error > std::max(best / kBetter, kRounding)) continue;
    text +=
        FormatText("%s of the %s seem to be in the order %s", text.empty() ? "" : ", or those",
                   reading.of_reference ? "reference" : "estimate",
                   reading.scalar_was_first ? "qw qx qy qz" : "qx qy qz qw, if qw was read first");
  }
  if (text.empty()) return "";
  return "the quaternions" + text +
         FormatText(
             ": read so, the orientations differ by %.2f degrees instead of %.2f; name the "
             "columns in a header, '# time tx ty tz qw qx qy qz'",
             RadiansToDegrees(best), RadiansToDegrees(given));
}

}  // namespace msc_vo
