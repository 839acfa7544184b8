// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/landmark_fit.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "msc_vo/factors/camera_linearization.h"

namespace msc_vo {

namespace {

// Standard deviation relative to the distance above which a direction is held. Chosen by
// measurement, see docs/lab/bundle_adjustment.md.
constexpr double kMaxHeldSigma = 0.1;
// A fit ends with a step that lowers the sum of squares by less than a hundredth, which no limit of
// a test notices; bounds of the number of steps, and of shorter ones that are tried while the sum
// does not decrease.
constexpr double kMinDecrease = 1e-2;
constexpr int kMaxSteps = 8;
constexpr int kMaxTrials = 5;
constexpr double kShrinkage = 0.4;

template <int Points>
struct Equations {
  using Vector = Eigen::Matrix<double, 3 * Points, 1>;
  using Matrix = Eigen::Matrix<double, 3 * Points, 3 * Points>;
  Matrix hessian = Matrix::Zero();
  Matrix geometry = Matrix::Zero();  // the same with the normals of the projected line
  Vector gradient = Vector::Zero();
  double cost = 0.0;
};

// Directions in which a landmark moves: a point in all, the end points of a line across it.
Eigen::Matrix3d Basis(const Eigen::Vector3d&) { return Eigen::Matrix3d::Identity(); }

Eigen::Matrix<double, 6, 4> Basis(const Eigen::Matrix<double, 6, 1>& line) {
  const Eigen::Vector3d direction = (line.tail<3>() - line.head<3>()).normalized();
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = direction.unitOrthogonal();
  across.col(1) = direction.cross(across.col(0));
  Eigen::Matrix<double, 6, 4> basis = Eigen::Matrix<double, 6, 4>::Zero();
  basis.topLeftCorner<3, 2>() = basis.bottomRightCorner<3, 2>() = across;
  return basis;
}

template <int Points>
class LandmarkFitter {
 public:
  using View = LandmarkView<Points>;
  using Vector = Eigen::Matrix<double, 3 * Points, 1>;

  LandmarkFitter(const PinholeCamera& camera, const std::vector<View>& views, const Vector& start)
      : camera_(camera), views_(views), basis_(Basis(start)), x_(start), at_(Evaluate(start)) {}

  LandmarkFit<Points> Fit(bool fixed) {
    LandmarkFit<Points> fit;
    for (int i = 0; i < kMaxSteps && at_ && !fixed; ++i) {
      const double before = at_->cost;
      if (!TakeStep() || before - at_->cost < kMinDecrease) break;
    }
    fit.x = x_;
    if (at_) fit.cost = at_->cost;
    return fit;
  }

  double RelativeSigma() const {
    if (!at_ || views_.empty()) return std::numeric_limits<double>::infinity();
    const Eigen::SelfAdjointEigenSolver<Moves> eigen(Geometry(), Eigen::EigenvaluesOnly);
    return 1.0 / (std::sqrt(std::max(0.0, eigen.eigenvalues()[0])) * Distance(x_));
  }

 private:
  // Degrees of freedom of a point: 3, of a line: 4.
  using Moves = Eigen::Matrix<double, 2 + Points, 2 + Points>;

  Moves Geometry() const { return basis_.transpose() * at_->geometry * basis_; }

  // Moves in the determined directions. Returns whether the cost decreased.
  bool TakeStep() {
    const Eigen::SelfAdjointEigenSolver<Moves> eigen(Geometry());
    const double sigma = kMaxHeldSigma * Distance(x_);
    const auto count = (eigen.eigenvalues().array() * (sigma * sigma) > 1.0).count();
    if (count == 0) return false;
    const Eigen::MatrixXd moves = basis_ * eigen.eigenvectors().rightCols(count);
    const Vector step =
        moves *
        (moves.transpose() * at_->hessian * moves).ldlt().solve(moves.transpose() * at_->gradient);
    double scale = 1.0;
    for (int trial = 0; trial < kMaxTrials; ++trial, scale *= kShrinkage) {
      const Vector x = x_ - scale * step;
      const std::optional<Equations<Points>> next = Evaluate(x);
      if (!next || !(next->cost < at_->cost)) continue;
      x_ = x;
      at_ = next;
      return true;
    }
    return false;
  }

  // std::nullopt where a factor is undefined.
  std::optional<Equations<Points>> Evaluate(const Vector& x) const {
    Equations<Points> sum;
    for (const View& view : views_) {
      CameraPoints<Points> points;
      if (!points.Set(*view.reprojection, view.rotation, view.translation, x.data())) {
        return std::nullopt;
      }
      Add(view, *view.reprojection, points, &sum);
      if (view.depth != nullptr) Add(view, *view.depth, points, &sum);
    }
    if (!std::isfinite(sum.cost)) return std::nullopt;
    return sum;
  }

  template <typename Factor>
  void Add(const View& view, const Factor& factor, const CameraPoints<Points>& points,
           Equations<Points>* sum) const {
    const CameraLinearization<Factor> at = LinearizeInCamera(factor, points);
    for (int k = 0; k < Points; ++k) {
      for (int row = 0; row < Factor::kRowsPerPoint; ++row) {
        const Eigen::RowVector3d by_x = at.by_x[k].row(row);
        const Vector j = ByLandmark(view, k, by_x);
        const double r = at.residual[k * Factor::kRowsPerPoint + row];
        sum->hessian += j * j.transpose();
        sum->gradient += r * j;
        sum->cost += r * r;
        if constexpr (std::is_same_v<Factor, LineReprojection>) {
          const Vector ideal = ByLandmark(view, k, AcrossProjection(points, k, by_x));
          sum->geometry += ideal * ideal.transpose();
        } else {
          sum->geometry += j * j.transpose();
        }
      }
    }
  }

  static Vector ByLandmark(const View& view, int k, const Eigen::RowVector3d& by_x) {
    Vector j;
    for (int i = 0; i < Points; ++i) {
      j.template segment<3>(3 * i) =
          view.reprojection->Weight(k, i) * view.rotation.transpose() * by_x.transpose();
    }
    return j;
  }

  // The row `by_x` = a P, P the derivative of the projection, with the direction of `a` replaced by
  // the normal of the projected line.
  Eigen::RowVector3d AcrossProjection(const CameraPoints<Points>& points, int k,
                                      const Eigen::RowVector3d& by_x) const {
    const Eigen::Matrix<double, 2, 3> p = ProjectionJacobian(camera_, points.x[k]);
    const Eigen::Vector2d a = (p * p.transpose()).ldlt().solve(p * by_x.transpose());
    const Eigen::Vector2d along =
        (camera_.Project(points.x[Points - 1]) - camera_.Project(points.x[0])).normalized();
    return a.norm() * Eigen::RowVector2d(-along.y(), along.x()) * p;
  }

  // From the nearest camera, metres.
  double Distance(const Vector& landmark) const {
    double distance = std::numeric_limits<double>::infinity();
    for (const View& view : views_) {
      for (int k = 0; k < Points; ++k) {
        const Eigen::Vector3d end = landmark.template segment<3>(3 * k);
        distance = std::min(distance, (view.rotation * end + view.translation).norm());
      }
    }
    return distance;
  }

  const PinholeCamera& camera_;
  const std::vector<View>& views_;
  const decltype(Basis(Vector())) basis_;
  Vector x_;
  std::optional<Equations<Points>> at_;
};

}  // namespace

template <int Points>
LandmarkFit<Points> FitLandmark(const PinholeCamera& camera,
                                const std::vector<LandmarkView<Points>>& views,
                                const Eigen::Matrix<double, 3 * Points, 1>& start, bool fixed) {
  return LandmarkFitter<Points>(camera, views, start).Fit(fixed);
}

template <int Points>
double RelativeSigma(const PinholeCamera& camera, const std::vector<LandmarkView<Points>>& views,
                     const Eigen::Matrix<double, 3 * Points, 1>& landmark) {
  return LandmarkFitter<Points>(camera, views, landmark).RelativeSigma();
}

template double RelativeSigma(const PinholeCamera&, const std::vector<LandmarkView<1>>&,
                              const Eigen::Vector3d&);
template double RelativeSigma(const PinholeCamera&, const std::vector<LandmarkView<2>>&,
                              const Eigen::Matrix<double, 6, 1>&);
template LandmarkFit<1> FitLandmark(const PinholeCamera&, const std::vector<LandmarkView<1>>&,
                                    const Eigen::Vector3d&, bool);
template LandmarkFit<2> FitLandmark(const PinholeCamera&, const std::vector<LandmarkView<2>>&,
                                    const Eigen::Matrix<double, 6, 1>&, bool);

}  // namespace msc_vo
