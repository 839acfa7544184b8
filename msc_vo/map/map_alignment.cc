// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map_alignment.h"

#include <algorithm>
#include <utility>

#include <Eigen/Cholesky>

#include "msc_vo/factors/chi_square.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Tangent vector from `a` to `b` in Rigid3Manifold.
Vector6 Difference(const Rigid3& b, const Rigid3& a) {
  Vector6 difference;
  difference << LogSO3(b.rotation() * a.rotation().conjugate()), b.translation() - a.translation();
  return difference;
}

Rigid3 Plus(const Rigid3& pose, const Vector6& tangent) {
  return {(ExpSO3(tangent.head<3>()) * pose.rotation()).normalized(),
          pose.translation() + tangent.tail<3>()};
}

// Pose of the camera in map b relative to that in map a: the identity up to errors if `a_from_b` is
// right.
Rigid3 Mismatch(const FrameInTwoMaps& frame, const Rigid3& a_from_b) {
  return frame.cam_from_a * a_from_b * frame.cam_from_b.Inverse();
}

// Covariance of the mismatch of a frame.
Matrix6 MismatchCovariance(const FrameInTwoMaps& frame) {
  return frame.covariance_a + frame.covariance_b + 2.0 * ViewCovariance();  // both maps
}

Vector6 MismatchVector(const FrameInTwoMaps& frame, const Rigid3& a_from_b) {
  return Difference(Mismatch(frame, a_from_b), Rigid3());
}

// Which frames agree with the alignment by frame `chosen`, whose own errors count as well.
std::vector<bool> FindAgreeing(const std::vector<FrameInTwoMaps>& frames,
                               const std::vector<Matrix6>& covariances, size_t chosen) {
  const Rigid3 a_from_b = frames[chosen].cam_from_a.Inverse() * frames[chosen].cam_from_b;
  std::vector<bool> agreeing;
  for (size_t i = 0; i < frames.size(); ++i) {
    const Matrix6 covariance = covariances[i] + covariances[chosen];
    const Vector6 error = MismatchVector(frames[i], a_from_b);
    agreeing.push_back(error.dot(covariance.ldlt().solve(error)) < kOutlierChiSquare[6]);
  }
  return agreeing;
}

int Count(const std::vector<bool>& marks) {
  return static_cast<int>(std::count(marks.begin(), marks.end(), true));
}

// Gauss-Newton over the inliers; sets the pose and the covariance.
void Refine(const std::vector<FrameInTwoMaps>& frames, const std::vector<Matrix6>& covariances,
            MapAlignment* alignment) {
  constexpr int kIterations = 3;  // the start is within a few sigmas
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Matrix6 hessian = Matrix6::Zero();
    Vector6 gradient = Vector6::Zero();
    for (size_t i = 0; i < frames.size(); ++i) {
      if (!alignment->inliers[i]) continue;
      const Eigen::Matrix3d cam_from_a = frames[i].cam_from_a.rotation().toRotationMatrix();
      const Eigen::Vector3d center =
          alignment->a_from_b.rotation() * frames[i].cam_from_b.OriginInSource();
      Matrix6 jacobian = Matrix6::Zero();
      jacobian.topLeftCorner<3, 3>() = cam_from_a;
      jacobian.bottomLeftCorner<3, 3>() = -cam_from_a * Skew(center);
      jacobian.bottomRightCorner<3, 3>() = cam_from_a;
      const Eigen::LDLT<Matrix6> weight(covariances[i]);
      hessian += jacobian.transpose() * weight.solve(jacobian);
      gradient +=
          jacobian.transpose() * weight.solve(MismatchVector(frames[i], alignment->a_from_b));
    }
    const Eigen::LDLT<Matrix6> solver(hessian);
    alignment->a_from_b = Plus(alignment->a_from_b, -solver.solve(gradient));
    alignment->covariance = Count(alignment->inliers) * solver.solve(Matrix6::Identity());
  }
}

}  // namespace

PoseCovariance ViewCovariance() {
  constexpr double kSigma = 0.01;  // metres
  constexpr double kRotationSigma = DegreesToRadians(0.3);
  return IsotropicCovariance(kRotationSigma, kSigma);
}

std::optional<MapAlignment> AlignMaps(const std::vector<FrameInTwoMaps>& frames) {
  std::vector<Matrix6> covariances;
  for (const FrameInTwoMaps& frame : frames) {
    covariances.push_back(MismatchCovariance(frame));
  }
  MapAlignment best;
  for (size_t i = 0; i < frames.size(); ++i) {
    std::vector<bool> agreeing = FindAgreeing(frames, covariances, i);
    if (Count(agreeing) <= Count(best.inliers)) continue;
    best.inliers = std::move(agreeing);
    best.a_from_b = frames[i].cam_from_a.Inverse() * frames[i].cam_from_b;
  }
  const int num_inliers = Count(best.inliers);
  if (num_inliers < kMinAlignedFrames || 2 * num_inliers <= static_cast<int>(frames.size())) {
    return std::nullopt;
  }
  Refine(frames, covariances, &best);
  return best;
}

}  // namespace msc_vo
