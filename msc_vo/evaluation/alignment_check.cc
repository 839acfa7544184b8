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
#include "msc_vo/geometry/so3.h"
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

// Residual of the positions after alignment without scale, square metres (mean).
double PositionVariance(const Poses& reference, const Poses& estimate) {
  const Moments m = MomentsOf(reference, estimate, 0, reference.size());
  return std::max(0.0, m.reference + m.estimate - 2.0 * m.common.sum());
}

std::string Millimetres(double square_metres) {
  const double value = 1e3 * std::sqrt(std::max(square_metres, 0.0));
  return FormatText(value >= 999.5 && value < 1e9 ? "%.0f mm" : "%.3g mm", value);
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

// Residual of the orientations for a rotation between the worlds, radians (RMS).
double OrientationError(const Eigen::Quaterniond& reference_from_estimate, const Poses& reference,
                        const Poses& estimate) {
  double sum = 0.0;
  for (size_t i = 0; i < reference.size(); ++i) {
    const double angle = Eigen::Quaterniond(reference[i].rotation())
                             .angularDistance(reference_from_estimate * estimate[i].rotation());
    sum += angle * angle;
  }
  return std::sqrt(sum / static_cast<double>(reference.size()));
}

// The same after alignment of the orientations.
double OrientationError(const Poses& reference, const Poses& estimate) {
  return OrientationError(Eigen::Quaterniond(AlignPoses(estimate, reference).rotation()), reference,
                          estimate);
}

// Rotation between the worlds that aligns the positions.
Eigen::Quaterniond AlignPositions(const Poses& reference, const Poses& estimate) {
  std::vector<Eigen::Vector3d> source, target;
  for (size_t i = 0; i < reference.size(); ++i) {
    source.emplace_back(estimate[i].translation());
    target.emplace_back(reference[i].translation());
  }
  return Eigen::Quaterniond(AlignRigid(source, target).rotation());
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

// The ratio of the variances is the 99 % quantile of the F-distribution with 5 and 5 degrees of
// freedom, few because errors of a trajectory are correlated.
constexpr double kBetter = 0.3;
constexpr double kRounding = 0.01;  // radians, of quaternions with two decimals

// A trajectory whose quaternions are read in the other order.
struct OrderReading {
  bool of_reference;
  bool scalar_was_first;
  double error;           // radians (RMS)
  double position_error;  // the same if positions align the worlds
};

// Both trajectories agree just as well if the other one is misread in the same way.
std::vector<OrderReading> ReadInOtherOrder(const Poses& reference, const Poses& estimate,
                                           bool estimate_is_own) {
  const Eigen::Quaterniond world = AlignPositions(reference, estimate);
  std::vector<OrderReading> readings;
  for (const bool scalar_was_first : {true, false}) {
    for (const bool of_reference : {true, false}) {
      if (estimate_is_own && !of_reference) continue;
      const Poses& read_reference =
          of_reference ? Reordered(reference, scalar_was_first) : reference;
      const Poses& read_estimate = of_reference ? estimate : Reordered(estimate, scalar_was_first);
      readings.push_back({of_reference, scalar_was_first,
                          OrientationError(read_reference, read_estimate),
                          OrientationError(world, read_reference, read_estimate)});
    }
  }
  return readings;
}

std::string DescribeOrders(const std::vector<OrderReading>& readings, double best, double given) {
  std::string text = "the quaternions";
  bool is_first = true;
  for (const OrderReading& reading : readings) {
    if (reading.error > std::min(std::max(best / kBetter, kRounding), kBetter * given)) continue;
    text +=
        FormatText("%s of the %s seem to be in the order %s", is_first ? "" : ", or those",
                   reading.of_reference ? "reference" : "estimate",
                   reading.scalar_was_first ? "qw qx qy qz" : "qx qy qz qw, if qw was read first");
    is_first = false;
  }
  return text + FormatText(
                    ": read so, the orientations differ by %.2f degrees instead of %.2f; name the "
                    "columns in a header, '# time tx ty tz qw qx qy qz'",
                    RadiansToDegrees(best), RadiansToDegrees(given));
}

// A constant rotation between the camera axes of two trajectories:
// reference = reference_from_estimate * estimate * turn.
struct AxesTurn {
  Eigen::Quaterniond turn;
  double error;           // radians (RMS), of the orientations after the turn
  double position_error;  // the same if positions align the worlds
};

Poses Turned(Poses poses, const Eigen::Quaterniond& turn) {
  for (Rigid3& pose : poses) pose = Rigid3(pose.rotation() * turn, pose.translation());
  return poses;
}

// The best turn for a rotation between the worlds.
Eigen::Quaterniond TurnFor(const Eigen::Quaterniond& reference_from_estimate,
                           const Poses& reference, const Poses& estimate) {
  Poses source, target;
  for (size_t i = 0; i < reference.size(); ++i) {
    source.push_back(
        Rigid3(reference_from_estimate * estimate[i].rotation(), Eigen::Vector3d::Zero())
            .Inverse());
    target.push_back(Rigid3(reference[i].rotation(), Eigen::Vector3d::Zero()).Inverse());
  }
  return Eigen::Quaterniond(AlignPoses(source, target).rotation()).conjugate();
}

// Improves a turn by alternating between both sides of the estimate.
AxesTurn Refined(Eigen::Quaterniond turn, const Poses& reference, const Poses& estimate) {
  for (int iteration = 0; iteration < 5; ++iteration) {
    turn = TurnFor(Eigen::Quaterniond(AlignPoses(Turned(estimate, turn), reference).rotation()),
                   reference, estimate);
  }
  const Poses turned = Turned(estimate, turn);
  return {turn, OrientationError(reference, turned),
          OrientationError(AlignPositions(reference, estimate), reference, turned)};
}

// The turn that maps rotation vectors of the reference to those of the estimate over quarters of
// the trajectory: turn * log(reference_i^-1 reference_j) = log(estimate_i^-1 estimate_j).
Eigen::Quaterniond TurnFromMotion(const Poses& reference, const Poses& estimate) {
  std::vector<Eigen::Vector3d> source, target;
  const auto motion = [](const Rigid3& from, const Rigid3& to) {
    return LogSO3(Eigen::Quaterniond(from.rotation()).conjugate() * to.rotation());
  };
  const size_t interval = std::max<size_t>(1, reference.size() / 4);
  for (size_t i = 0; i + interval < reference.size(); ++i) {
    for (const double sign : {1.0, -1.0}) {  // makes the mean zero, which AlignRigid() subtracts
      source.push_back(sign * motion(reference[i], reference[i + interval]));
      target.push_back(sign * motion(estimate[i], estimate[i + interval]));
    }
  }
  return Eigen::Quaterniond(AlignRigid(source, target).rotation());
}

AxesTurn FitAxesTurn(const Poses& reference, const Poses& estimate) {
  // Positions determine the turn even if the camera rotates about one axis only, but may be wrong.
  const Eigen::Quaterniond world = AlignPositions(reference, estimate);
  const AxesTurn by_positions = Refined(TurnFor(world, reference, estimate), reference, estimate);
  const AxesTurn by_motion = Refined(TurnFromMotion(reference, estimate), reference, estimate);
  return by_positions.error <= by_motion.error / kBetter ? by_positions : by_motion;
}

// `is_reflected`: the positions are mirror images of each other, as those of mirrored images are.
std::string DescribeAxes(const AxesTurn& axes, double given, bool estimate_is_own,
                         bool is_reflected) {
  return FormatText(
      "the axes of the reference poses differ from those of the %s by a %s: turned back, the "
      "orientations differ by %.2f degrees instead of %.2f; x must point right, y down and z "
      "forward in the image%s",
      estimate_is_own ? "camera" : "estimated poses",
      DescribeTurn(axes.turn.toRotationMatrix()).c_str(), RadiansToDegrees(axes.error),
      RadiansToDegrees(given), is_reflected ? ", which may not be mirrored" : "");
}

Poses Inverted(Poses poses) {
  for (Rigid3& pose : poses) pose = pose.Inverse();
  return poses;
}

// Says that one trajectory holds the inverse poses, if these agree better in positions and
// orientations, to `limit` (radians); empty otherwise.
std::string DescribeInverse(const Poses& reference, const Poses& estimate, bool estimate_is_own,
                            double limit) {
  const double max_variance = kBetter * kBetter * PositionVariance(reference, estimate);
  for (const bool of_reference : {true, false}) {
    if (estimate_is_own && !of_reference) continue;
    const Poses& a = of_reference ? Inverted(reference) : reference;
    const Poses& b = of_reference ? estimate : Inverted(estimate);
    if (OrientationError(a, b) >= limit || PositionVariance(a, b) >= max_variance) continue;
    return std::string("the poses of the ") + (of_reference ? "reference" : "estimate") +
           " are inverse, from the world to the camera; write poses from the camera to the world";
  }
  return "";
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
  // A wrong scale moves positions along their rays, which leaves the rotation determined.
  const double scale = moments.common.sum() / moments.estimate;
  const double squares = moments.reference + scale * scale * moments.estimate;
  constexpr double kEpsilon = 1e-14;  // rounding of the moments
  const double error = std::max({squares - 2.0 * scale * moments.common.sum(), kEpsilon * squares,
                                 std::pow(Rounding(reference) + scale * Rounding(estimate), 2.0)});
  if (!(scale * moments.common.sum() > error)) {  // also if the squares overflow
    const double used = with_scale ? error : std::max(error, PositionVariance(reference, estimate));
    return "the error of the positions (" + Millimetres(used) +
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

std::string DescribeTurn(const Eigen::Matrix3d& rotation) {
  const double parallel = std::cos(DegreesToRadians(3.0));
  const Eigen::AngleAxisd turn(rotation);
  const Eigen::Vector3d& axis = turn.axis();
  Eigen::Index largest = 0;
  const bool is_named = axis.cwiseAbs().maxCoeff(&largest) > parallel;
  // The sign of the axis means nothing for half a turn.
  const bool is_half = RadiansToDegrees(turn.angle()) > 179.5;
  const double sign = is_half && axis(largest) < 0.0 ? -1.0 : 1.0;
  const std::string name =
      is_named
          ? std::string(sign * axis(largest) < 0.0 ? "-" : "") + "xyz"[largest]
          : FormatText("(%.2f, %.2f, %.2f)", sign * axis.x(), sign * axis.y(), sign * axis.z());
  return FormatText("%.3g degree turn about %s", RadiansToDegrees(turn.angle()), name.c_str());
}

std::string DescribeOrientationContradiction(const Poses& reference, const Poses& estimate,
                                             bool estimate_is_own) {
  constexpr size_t kMinPoses = 8;         // for a turn
  constexpr double kMinTurn = 5.0;        // degrees
  constexpr double kSimpler = 0.8;        // an order has no parameters, a turn has three
  constexpr double kErrorOfRight = 0.05;  // radians, of a reading that is right
  const double given = OrientationError(reference, estimate);
  if (given <= kRounding) return "";
  const double limit = std::min(std::max(kErrorOfRight, 0.1 * given), kBetter * given);
  const std::string inverse = DescribeInverse(reference, estimate, estimate_is_own, limit);
  if (!inverse.empty()) return inverse;
  const std::vector<OrderReading> orders = ReadInOtherOrder(reference, estimate, estimate_is_own);
  const OrderReading* order = nullptr;
  for (const OrderReading& reading : orders) {
    if (reading.error < (order ? order->error : limit)) order = &reading;
  }
  if (reference.size() >= kMinPoses) {
    const AxesTurn axes = FitAxesTurn(reference, estimate);
    const double angle = RadiansToDegrees(Eigen::AngleAxisd(axes.turn).angle());
    // If the camera rotates about one axis, orientations do not distinguish both.
    const bool is_determined = DescribeUndetermined(reference, estimate, true).empty();
    const bool is_preferred =
        !order || axes.error < kSimpler * order->error ||
        (is_determined && axes.position_error < kBetter * order->position_error);
    if (axes.error < limit && angle > kMinTurn && is_preferred) {
      const bool is_reflected =
          MomentsOf(reference, estimate, 0, reference.size()).common.z() < 0.0;
      return DescribeAxes(axes, given, estimate_is_own, is_reflected);
    }
  }
  return order ? DescribeOrders(orders, order->error, given) : "";
}

}  // namespace msc_vo
