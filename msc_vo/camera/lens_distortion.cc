// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/lens_distortion.h"

#include <algorithm>

#include <Eigen/LU>

#include "msc_vo/camera/radial_profile.h"

namespace msc_vo {

namespace {

using Eigen::Vector2d;

struct Model {
  LensModel model;
  const char* name;
  std::vector<std::string> coefficients;
};

// In the order of LensModel.
const std::vector<Model>& Models() {
  static const auto* const models = new std::vector<Model>{
      {LensModel::kRadialTangential, "radial-tangential", {"k1", "k2", "p1", "p2", "k3"}},
      {LensModel::kRational, "rational", {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"}},
      {LensModel::kFisheye, "fisheye", {"k1", "k2", "k3", "k4"}},
  };
  return *models;
}

constexpr int kMaxSteps = 100;
// A fixed-point step that leaves a larger fraction of the residual is replaced by a Newton step.
constexpr double kMaxResidualRatio = 0.75;
// Radius on the plane z = 1 of a point that no recorded pixel shows: 89.9 degrees.
constexpr double kUnseenRadius = 1e3;
// A residual above this multiple of the tolerance means that no point was found.
constexpr double kMaxTolerances = 1e3;

Vector2d Unseen(const Vector2d& x_d) { return kUnseenRadius * x_d.stableNormalized(); }

// Radial factor of the two models with a polynomial in r^2, and its derivative with respect to
// r2 / 2.
double Radial(const LensDistortion& lens, double r2) {
  if (lens.model == LensModel::kRational) return RationalScale(lens.k.data(), r2);
  return 1.0 + r2 * (lens.k[0] + r2 * (lens.k[1] + r2 * lens.k[4]));
}

double RadialSlope(const LensDistortion& lens, double r2) {
  const auto& k = lens.k;
  const double slope = 2.0 * (k[0] + r2 * (2.0 * k[1] + r2 * 3.0 * k[4]));
  if (lens.model != LensModel::kRational) return slope;
  const double denominator = 1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7]));
  const double denominator_slope = 2.0 * (k[5] + r2 * (2.0 * k[6] + r2 * 3.0 * k[7]));
  return (slope - Radial(lens, r2) * denominator_slope) / denominator;
}

// Angle of a recorded ray of a fisheye lens, and its derivative with respect to that of the ray.
double FisheyeAngle(const LensDistortion& lens, double theta) {
  const double t2 = theta * theta;
  return theta * (1.0 + t2 * (lens.k[0] + t2 * (lens.k[1] + t2 * (lens.k[2] + t2 * lens.k[3]))));
}

double FisheyeAngleSlope(const LensDistortion& lens, double theta) {
  const double t2 = theta * theta;
  return 1.0 + t2 * (3.0 * lens.k[0] +
                     t2 * (5.0 * lens.k[1] + t2 * (7.0 * lens.k[2] + t2 * 9.0 * lens.k[3])));
}

// J = scale I + slope x x^T with scale = theta_d / r and slope = (d theta_d / d r - scale) / r^2.
Eigen::Matrix2d FisheyeJacobian(const LensDistortion& lens, const Vector2d& x) {
  const double r2 = x.squaredNorm();
  const double scale = FisheyeScale(lens.k.data(), r2);
  constexpr double kSeries = 1e-10;  // as in FisheyeScale()
  const double slope =
      r2 < kSeries ? 2.0 * (lens.k[0] - 1.0 / 3.0)
                   : (FisheyeAngleSlope(lens, std::atan(std::sqrt(r2))) / (1.0 + r2) - scale) / r2;
  return scale * Eigen::Matrix2d::Identity() + slope * x * x.transpose();
}

// The smallest theta with the recorded angle theta_d; 90 degrees if there is none. Beyond a fold,
// which IsInvertible() excludes inside the undistorted image, larger ones may exist.
double FisheyeTheta(const LensDistortion& lens, double theta_d) {
  constexpr double kRightAngle = 0.5 * M_PI;
  constexpr int kIntervals = 90;
  double low = 0.0, high = 0.0;
  for (int i = 1; i <= kIntervals; ++i) {
    high = i * kRightAngle / kIntervals;
    if (FisheyeAngle(lens, high) >= theta_d) break;
    low = high;
  }
  if (low == high) return kRightAngle;
  double theta = 0.5 * (low + high);
  for (int i = 0; i < kMaxSteps; ++i) {
    const double residual = theta_d - FisheyeAngle(lens, theta);
    (residual > 0.0 ? low : high) = theta;
    double next = theta + residual / FisheyeAngleSlope(lens, theta);
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == theta || high - low < 1e-16) break;
    theta = next;
  }
  return theta;
}

Vector2d UndistortFisheye(const LensDistortion& lens, const Vector2d& x_d) {
  constexpr double kSmall = 1e-8;  // recorded radius at which theta_d / r is 1
  const double theta_d = x_d.norm();
  if (theta_d < kSmall) return x_d;
  const double r = std::tan(FisheyeTheta(lens, theta_d));
  return r < kUnseenRadius ? Vector2d(r / theta_d * x_d) : Unseen(x_d);
}

}  // namespace

const char* LensModelName(LensModel model) { return Models()[static_cast<size_t>(model)].name; }

std::optional<LensModel> LensModelFromName(const std::string& name) {
  for (const Model& model : Models()) {
    if (model.name == name) return model.model;
  }
  return std::nullopt;
}

std::string LensModelNames() {
  std::string names;
  for (const Model& model : Models()) {
    if (!names.empty()) names += ", ";
    names += model.name;
  }
  return names;
}

const std::vector<std::string>& LensCoefficientNames(LensModel model) {
  return Models()[static_cast<size_t>(model)].coefficients;
}

std::string LensCoefficientList(LensModel model) {
  std::string list;
  for (const std::string& name : LensCoefficientNames(model)) {
    if (!list.empty()) list += " ";
    list += name;
  }
  return list;
}

Vector2d LensDistortion::DistortNormalized(const Vector2d& x) const {
  const double r2 = x.squaredNorm();
  if (model == LensModel::kFisheye) return FisheyeScale(k.data(), r2) * x;
  const double radial = Radial(*this, r2);
  const double xy2 = 2.0 * x.x() * x.y();
  return {radial * x.x() + k[2] * xy2 + k[3] * (r2 + 2.0 * x.x() * x.x()),
          radial * x.y() + k[3] * xy2 + k[2] * (r2 + 2.0 * x.y() * x.y())};
}

Eigen::Matrix2d LensDistortion::Jacobian(const Vector2d& x) const {
  if (model == LensModel::kFisheye) return FisheyeJacobian(*this, x);
  const double r2 = x.squaredNorm();
  const double radial = Radial(*this, r2);
  const double slope = RadialSlope(*this, r2);
  const double xy = slope * x.x() * x.y() + 2.0 * (k[2] * x.x() + k[3] * x.y());
  Eigen::Matrix2d jacobian;
  jacobian << radial + slope * x.x() * x.x() + 2.0 * k[2] * x.y() + 6.0 * k[3] * x.x(), xy,  //
      xy, radial + slope * x.y() * x.y() + 6.0 * k[2] * x.y() + 2.0 * k[3] * x.x();
  return jacobian;
}

Vector2d LensDistortion::UndistortNormalized(const Vector2d& target, double tolerance) const {
  if (model == LensModel::kFisheye) return UndistortFisheye(*this, target);
  Vector2d x = target;
  Vector2d residual = target - DistortNormalized(x);
  for (int i = 0; i < kMaxSteps && !(residual.norm() < tolerance); ++i) {
    // The fixed-point step suffices for nearly every lens; strong distortion needs Newton's.
    Vector2d step = residual;
    Vector2d next = target - DistortNormalized(x + step);
    if (!(next.norm() < kMaxResidualRatio * residual.norm())) {
      step = Jacobian(x).inverse() * residual;
      next = target - DistortNormalized(x + step);
    }
    while (!(next.norm() < residual.norm()) && step.norm() > tolerance) {
      step *= 0.5;
      next = target - DistortNormalized(x + step);
    }
    if (!(next.norm() < residual.norm())) break;
    x += step;
    residual = next;
  }
  const bool may_be_unseen = model == LensModel::kRational || recorded;
  if (may_be_unseen && !(residual.norm() < kMaxTolerances * tolerance)) return Unseen(target);
  return x + residual;
}

Vector2d LensDistortion::Distort(const PinholeCamera& camera, const Vector2d& pixel) const {
  const Vector2d x = DistortNormalized(camera.Ray(pixel).head<2>());
  const PinholeCamera& raw = Recorded(camera);
  return {raw.fx * x.x() + raw.cx, raw.fy * x.y() + raw.cy};
}

Vector2d LensDistortion::Undistort(const PinholeCamera& camera, const Vector2d& pixel) const {
  if (IsZero()) return pixel;
  const PinholeCamera& raw = Recorded(camera);
  const Vector2d x = UndistortNormalized(raw.Ray(pixel).head<2>(), 1e-9 / raw.FocalLength());
  return {camera.fx * x.x() + camera.cx, camera.fy * x.y() + camera.cy};
}

}  // namespace msc_vo
