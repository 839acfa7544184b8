// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/ground_truth_motion.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/SVD>

#include "msc_vo/geometry/quantile.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/text/enum_names.h"

namespace msc_vo {

namespace {

constexpr double kMaxGap = 0.3;  // seconds between poses that are interpolated
// Standard deviations of the hand-eye offset beforehand, metres: unknown, and none.
constexpr double kOffsetPrior = 0.5, kNoOffset = 1e-3;
constexpr double kMaxScaleSigma = 0.05;  // relative, with which an estimate decides nothing
constexpr double kMaxLever = 0.04;       // metres

// The offset is zero with standard deviation `offset_prior` (metres) beforehand.
HandEye FitWithPrior(const std::vector<MotionComparison>& comparisons,
                     const Eigen::Matrix3d& camera_from_body, double offset_prior) {
  // (R - I) offset + scale * t_image = t_true, in the camera frame, from M_camera X = X M_body
  // with X = (camera_from_body, offset).
  Eigen::Vector4d solution(0.0, 0.0, 0.0, 1.0);
  Eigen::Matrix4d matrix;
  double scale = 1.0;
  for (int iteration = 0; iteration < 15; ++iteration) {
    std::vector<Eigen::Vector3d> residuals;
    std::vector<double> errors;
    std::vector<Eigen::Matrix<double, 3, 4>> rows;
    for (const MotionComparison& c : comparisons) {
      Eigen::Matrix<double, 3, 4> row;
      row.leftCols<3>() = ExpSO3(c.image_rotation).toRotationMatrix() - Eigen::Matrix3d::Identity();
      row.col(3) = c.image_translation;
      rows.push_back(row);
      residuals.emplace_back(camera_from_body * c.true_translation - row * solution);
      errors.push_back(residuals.back().norm());
    }
    scale = std::max(1e-4, iteration == 0 ? 1e3 : Median(errors));
    // Rotations of a few degrees hardly determine the offset.
    matrix = Eigen::Matrix4d::Zero();
    matrix.diagonal().head<3>().setConstant(scale * scale / (offset_prior * offset_prior));
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (size_t i = 0; i < rows.size(); ++i) {
      const double weight = 1.0 / (1.0 + errors[i] * errors[i] / (4.0 * scale * scale));
      matrix += weight * rows[i].transpose() * rows[i];
      right += weight * rows[i].transpose() * (camera_from_body * comparisons[i].true_translation);
    }
    matrix += 1e-9 * Eigen::Matrix4d::Identity();
    solution = matrix.ldlt().solve(right);
  }
  const Eigen::Matrix4d covariance = scale * scale * matrix.inverse();
  HandEye result;
  result.offset = solution.head<3>();
  result.scale = solution(3);
  // Pairs overlap in time: count three of them as one.
  result.scale_sigma = 1.7 * std::sqrt(std::max(0.0, covariance(3, 3)));
  result.offset_sigma = 1.7 * std::sqrt(std::max(0.0, covariance.diagonal().head<3>().maxCoeff()));
  double product = 0.0, image = 0.0, truth = 0.0;
  for (const MotionComparison& c : comparisons) {
    const Eigen::Vector3d lever = ExpSO3(c.image_rotation) * result.offset - result.offset;
    const Eigen::Vector3d translation = camera_from_body * c.true_translation - lever;
    product += translation.dot(c.image_translation);
    image += c.image_translation.squaredNorm();
    truth += translation.squaredNorm();
  }
  result.correlation = product / std::sqrt(std::max(1e-12, image * truth));
  return result;
}

// Of the time offset.
constexpr double kTimeStep = 0.01;      // seconds, of the offsets that are tried
constexpr double kTurnInterval = 0.1;   // seconds, of the rotations that are compared
constexpr double kMinTurnScale = 1e-3;  // radians, of the errors of these rotations
// Fewest turns that are compared: two seconds of a camera with ten images per second.
constexpr size_t kMinTurns = 20;
// Radians, smallest median of the turns: an error of kMinTurnScale is then one of 25 milliseconds.
constexpr double kMinTurn = 0.004;

// The rotation of the camera between two images.
struct Turn {
  double begin;  // seconds
  double end;
  Eigen::Vector3d vector;  // of the later camera from the earlier one
};

std::vector<Turn> TurnsOf(const MotionTrack& track) {
  std::vector<Turn> turns;
  const std::vector<MotionImage>& images = track.images;
  for (size_t i = 0; i < images.size(); ++i) {
    for (size_t j = i + 1; j < images.size() && images[j].segment == images[i].segment; ++j) {
      if (images[j].timestamp - images[i].timestamp < kTurnInterval - 1e-3) continue;
      const Rigid3 motion = track.MotionOf({static_cast<int>(i), static_cast<int>(j)});
      turns.push_back({images[i].timestamp, images[j].timestamp, LogSO3(motion.rotation())});
      break;
    }
  }
  return turns;
}

// Errors of the turns at an offset, radians; -1 where the ground truth has no pose.
std::vector<double> TurnErrors(const std::vector<Turn>& turns, const std::vector<TimedPose>& truth,
                               const Eigen::Matrix3d& camera_from_body, double offset) {
  std::vector<double> errors;
  for (const Turn& turn : turns) {
    const auto begin = InterpolatePose(truth, turn.begin + offset);
    const auto end = InterpolatePose(truth, turn.end + offset);
    if (!begin || !end) {
      errors.push_back(-1.0);
      continue;
    }
    const Rigid3 motion = end->Inverse() * *begin;
    const Eigen::Vector3d vector = LogSO3(Eigen::Quaterniond(motion.rotation()));
    errors.push_back((turn.vector - camera_from_body * vector).norm());
  }
  return errors;
}

// Mean robust cost of the errors that exist.
double TurnCost(const std::vector<double>& errors, double scale) {
  double sum = 0.0;
  size_t count = 0;
  for (const double error : errors) {
    if (error < 0.0) continue;
    sum += std::log1p(error * error / (scale * scale));
    ++count;
  }
  return count >= kMinTurns ? sum / static_cast<double>(count) : 1e9;
}

}  // namespace

const char* Describe(PoseConvention convention) {
  return EnumName<PoseConvention::kScalarFirst>(
      convention, {"poses of the camera in the world", "inverse poses, world in camera",
                   "positions of the camera with rotations from world to camera",
                   "poses with quaternions in the order w x y z"});
}

std::optional<Rigid3> InterpolatePose(const std::vector<TimedPose>& poses, double timestamp) {
  const auto next =
      std::lower_bound(poses.begin(), poses.end(), timestamp,
                       [](const TimedPose& pose, double time) { return pose.timestamp < time; });
  if (next == poses.end()) return std::nullopt;
  if (next->timestamp == timestamp) return next->world_from_cam;
  if (next == poses.begin()) return std::nullopt;
  const TimedPose& before = *(next - 1);
  const double interval = next->timestamp - before.timestamp;
  if (interval > kMaxGap) return std::nullopt;
  const double ratio = (timestamp - before.timestamp) / interval;
  const Eigen::Quaterniond a(before.world_from_cam.rotation());
  const Eigen::Quaterniond b(next->world_from_cam.rotation());
  return Rigid3(a.slerp(ratio, b), (1.0 - ratio) * before.world_from_cam.translation() +
                                       ratio * next->world_from_cam.translation());
}

std::vector<TimedPose> ReadAs(PoseConvention convention, std::vector<TimedPose> poses) {
  for (TimedPose& pose : poses) {
    Rigid3& world_from_cam = pose.world_from_cam;
    switch (convention) {
      case PoseConvention::kWorldInCamera:
        world_from_cam = world_from_cam.Inverse();
        break;
      case PoseConvention::kInverseRotation:
        world_from_cam =
            Rigid3(world_from_cam.rotation().conjugate(), world_from_cam.translation());
        break;
      case PoseConvention::kScalarFirst: {
        const Eigen::Vector4d c = world_from_cam.params.head<4>();  // in the order of the file
        world_from_cam =
            Rigid3(Eigen::Quaterniond(c(0), c(1), c(2), c(3)), world_from_cam.translation());
        break;
      }
      default:
        break;
    }
  }
  return poses;
}

std::vector<MotionComparison> CompareMotions(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth, double offset) {
  std::vector<MotionComparison> comparisons;
  for (const MotionPair& pair : track.pairs) {
    const auto from = InterpolatePose(truth, track.images[pair.from].timestamp + offset);
    const auto to = InterpolatePose(truth, track.images[pair.to].timestamp + offset);
    if (!from || !to) continue;
    const Rigid3 motion = to->Inverse() * *from;
    const Rigid3 image_motion = track.MotionOf(pair);
    MotionComparison comparison;
    comparison.image_rotation = LogSO3(image_motion.rotation());
    comparison.image_translation = image_motion.translation();
    comparison.true_rotation = LogSO3(Eigen::Quaterniond(motion.rotation()));
    comparison.true_translation = motion.translation();
    comparisons.push_back(comparison);
  }
  return comparisons;
}

double RotationDisagreement(const std::vector<MotionComparison>& comparisons,
                            const Eigen::Matrix3d& camera_from_body) {
  std::vector<double> differences, rotations;
  for (const MotionComparison& c : comparisons) {
    differences.push_back((c.image_rotation - camera_from_body * c.true_rotation).norm());
    rotations.push_back(c.image_rotation.norm());
  }
  return Median(std::move(differences)) / std::max(1e-6, Median(std::move(rotations)));
}

Eigen::Matrix3d FitBodyRotation(const std::vector<MotionComparison>& comparisons) {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  for (int iteration = 0; iteration < 5; ++iteration) {
    Eigen::Matrix3d covariance = 1e-9 * Eigen::Matrix3d::Identity();
    std::vector<double> errors;
    for (const MotionComparison& c : comparisons) {
      errors.push_back((c.image_rotation - rotation * c.true_rotation).norm());
    }
    const double scale = std::max(1e-4, iteration == 0 ? 1e3 : Median(errors));
    for (size_t i = 0; i < comparisons.size(); ++i) {
      const double weight = 1.0 / (1.0 + errors[i] * errors[i] / (scale * scale));
      covariance +=
          weight * comparisons[i].image_rotation * comparisons[i].true_rotation.transpose();
    }
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                                Eigen::ComputeFullU | Eigen::ComputeFullV);
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    rotation = svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
  }
  return rotation;
}

double MedianTranslation(const std::vector<MotionComparison>& comparisons) {
  std::vector<double> lengths;
  for (const MotionComparison& c : comparisons) lengths.push_back(c.true_translation.norm());
  return Median(std::move(lengths));
}

// Without a scale, the offset explains what the scale leaves.
bool HandEye::HasScale() const { return scale_sigma <= kMaxScaleSigma * scale; }

bool HandEye::HasOffset() const {
  return HasScale() && offset.norm() > std::max(kMaxLever, kSignificantSigmas * offset_sigma);
}

HandEye FitHandEye(const std::vector<MotionComparison>& comparisons,
                   const Eigen::Matrix3d& camera_from_body) {
  return FitWithPrior(comparisons, camera_from_body, kOffsetPrior);
}

HandEye FitSignificantHandEye(const std::vector<MotionComparison>& comparisons,
                              const Eigen::Matrix3d& camera_from_body) {
  const HandEye free = FitWithPrior(comparisons, camera_from_body, kOffsetPrior);
  return free.HasOffset() ? free : FitWithPrior(comparisons, camera_from_body, kNoOffset);
}

std::optional<TimeOffset> EstimateTimeOffset(const MotionTrack& track,
                                             const std::vector<TimedPose>& truth,
                                             const Eigen::Matrix3d& camera_from_body,
                                             double reach) {
  const std::vector<Turn> turns = TurnsOf(track);
  if (turns.size() < kMinTurns) return std::nullopt;
  std::vector<double> magnitudes;
  for (const Turn& turn : turns) magnitudes.push_back(turn.vector.norm());
  const double median_rotation = Median(std::move(magnitudes));
  if (median_rotation < kMinTurn) return std::nullopt;
  const int count = static_cast<int>(std::lround(2.0 * reach / kTimeStep)) + 1;
  const double scale = std::max(kMinTurnScale, 0.2 * median_rotation);
  std::vector<double> costs;
  for (int i = 0; i < count; ++i) {
    costs.push_back(
        TurnCost(TurnErrors(turns, truth, camera_from_body, i * kTimeStep - reach), scale));
  }
  const auto best = std::min_element(costs.begin(), costs.end()) - costs.begin();
  if (costs[best] > 1e8) return std::nullopt;
  TimeOffset result;
  result.seconds = static_cast<double>(best) * kTimeStep - reach;
  // A parabola over +-3 steps: the cost is smooth, and interpolated poses make it wavy at the
  // interval of the images.
  const std::ptrdiff_t wing = 3;
  const bool is_inside =
      best >= wing && best + wing < count && costs[best - wing] < 1e8 && costs[best + wing] < 1e8;
  double curvature = 0.0;
  if (is_inside) {
    curvature = costs[best - wing] - 2.0 * costs[best] + costs[best + wing];
    if (curvature > 0.0) {
      result.seconds +=
          0.5 * (costs[best - wing] - costs[best + wing]) / curvature * wing * kTimeStep;
    }
  }
  std::vector<double> errors = TurnErrors(turns, truth, camera_from_body, result.seconds);
  errors.erase(std::remove(errors.begin(), errors.end(), -1.0), errors.end());
  result.disagreement = Median(std::move(errors)) / median_rotation;
  // Second derivative of the sum of the costs; consecutive rotations overlap threefold.
  const double second =
      curvature / (wing * kTimeStep * wing * kTimeStep) * static_cast<double>(turns.size()) / 3.0;
  result.sigma = second > 0.0 ? 1.0 / std::sqrt(second) : reach;
  return result;
}

}  // namespace msc_vo
