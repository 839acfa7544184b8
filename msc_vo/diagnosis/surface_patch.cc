// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/surface_patch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace msc_vo {

namespace {

// Least ratio of the cells of a patch that have a depth.
constexpr double kMinFill = 0.8;
// Largest correlation of neighbouring residuals: beyond, the patch is not smooth anyway.
constexpr double kMaxCorrelation = 0.9;
// Largest radius on the plane z = 1 of a sample: 72 degrees.
constexpr double kMaxRadius = 3.0;

using Coefficients = Eigen::Matrix<double, 6, 1>;

// Least squares for the quadratic polynomial c0 + c1 x + c2 y + c3 x^2 + c4 x y + c5 y^2.
class QuadraticFit {
 public:
  static constexpr int kNumParameters = 6;

  void Add(double x, double y, double value) {
    Coefficients basis;
    basis << 1.0, x, y, x * x, x * y, y * y;
    matrix_ += basis.lazyProduct(basis.transpose());  // faster than a rank update for six rows
    rhs_ += value * basis;
    ++count_;
  }
  int count() const { return count_; }

  // Returns false if the polynomial is not determined.
  bool Solve() {
    if (count_ <= rhs_.size()) return false;
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> ldlt(matrix_);
    coefficients_ = ldlt.solve(rhs_);
    covariance_ = ldlt.solve(Eigen::Matrix<double, 6, 6>::Identity());
    return coefficients_.allFinite() && covariance_.allFinite();
  }
  double At(double x, double y) const {
    Coefficients basis;
    basis << 1.0, x, y, x * x, x * y, y * y;
    return basis.dot(coefficients_);
  }
  // Sets the variance of the values, 1 by default.
  void SetVariance(double variance) { covariance_ *= variance; }

  double value() const { return coefficients_(0); }
  Eigen::Vector2d gradient() const { return coefficients_.segment<2>(1); }
  // The combination w0 f_xx + w1 f_xy + w2 f_yy of second derivatives and its standard deviation.
  double SecondDerivative(const Eigen::Vector3d& w, double* sigma) const {
    const Eigen::Vector3d by_coefficient(2.0 * w(0), w(1), 2.0 * w(2));
    *sigma = std::sqrt(by_coefficient.dot(covariance_.bottomRightCorner<3, 3>() * by_coefficient));
    return by_coefficient.dot(coefficients_.tail<3>());
  }

 private:
  Eigen::Matrix<double, 6, 6> matrix_ = Eigen::Matrix<double, 6, 6>::Zero();
  Coefficients rhs_ = Coefficients::Zero();
  int count_ = 0;
  Coefficients coefficients_;
  Eigen::Matrix<double, 6, 6> covariance_;
};

// The variance of independent values that determine a polynomial as well as those of a patch,
// whose residuals (NaN: no value) have it in common with their neighbours: a matcher of stereo
// images smooths its noise, rounded disparities form steps, edges bend all values beside them.
double VarianceOf(const cv::Mat_<double>& residuals, int num_parameters) {
  double squares = 0.0, by_x = 0.0, by_y = 0.0;
  int count = 0, count_x = 0, count_y = 0;
  for (int y = 0; y < residuals.rows; ++y) {
    for (int x = 0; x < residuals.cols; ++x) {
      const double r = residuals(y, x);
      if (std::isnan(r)) continue;
      squares += r * r;
      ++count;
      if (x > 0 && !std::isnan(residuals(y, x - 1))) {
        by_x += r * residuals(y, x - 1);
        ++count_x;
      }
      if (y > 0 && !std::isnan(residuals(y - 1, x))) {
        by_y += r * residuals(y - 1, x);
        ++count_y;
      }
    }
  }
  const double variance = squares / count;
  double factor = static_cast<double>(count) / (count - num_parameters);
  // Sum of a geometric autocorrelation along both axes.
  for (const double covariance : {by_x / std::max(1, count_x), by_y / std::max(1, count_y)}) {
    const double correlation = std::clamp(covariance / variance, 0.0, kMaxCorrelation);
    factor *= (1.0 + correlation) / (1.0 - correlation);
  }
  return factor * variance;
}

// `reference` was subtracted from the values; the coordinates of the fit are those of the plane
// z = 1, relative to `center` and in units of `unit`. Returns std::nullopt without a slope.
std::optional<SurfacePatch> MakePatch(const QuadraticFit& fit, double reference, double unit,
                                      const Eigen::Vector2d& center) {
  SurfacePatch patch;
  patch.center = center;
  patch.value = fit.value() + reference;
  patch.gradient = fit.gradient() / unit;
  const double slope = patch.gradient.norm();
  if (!(patch.value > 0.0) || !(slope > 0.0)) return std::nullopt;
  const Eigen::Vector2d n = patch.gradient / slope;
  const double per_unit = 1.0 / (unit * unit);
  double sigma = 0.0;
  const double second =
      fit.SecondDerivative({n.x() * n.x(), 2.0 * n.x() * n.y(), n.y() * n.y()}, &sigma);
  patch.bend = -second * per_unit / (slope * slope);
  patch.bend_sigma = sigma * per_unit / (slope * slope);
  const double laplacian = fit.SecondDerivative({1.0, 0.0, 1.0}, &sigma);
  const Eigen::Vector2d relative = patch.gradient / patch.value;
  patch.bowl = -laplacian * per_unit / patch.value + 2.0 * relative.squaredNorm();
  patch.bowl_sigma = sigma * per_unit / patch.value;
  return patch;
}

}  // namespace

double SurfacePatch::BowlOfRay() const {
  // Of w = (affine function) / rho, where rho = sqrt(1 + |x|^2).
  const double squared_radius = center.squaredNorm();
  const double rho = std::sqrt(1.0 + squared_radius);
  const double laplacian = (2.0 + squared_radius) / (rho * rho * rho);
  return (2.0 * gradient.dot(center) / (value * rho) - laplacian) / rho;
}

// Inverse depth w = 1/v is affine in u = x (1 + k |x|^2): its second derivative along a unit
// vector n is that of u, k (2 x + 4 (x.n) n), times dw/du; the Laplacian of u is 8 k x.
double SurfacePatch::BendOfLens(double k) const {
  const Eigen::Vector2d n = gradient.normalized();
  const Eigen::Vector2d second = k * (2.0 * center + 4.0 * center.dot(n) * n);
  return -2.0 / value - SlopeBeyondLens(k).dot(second) / gradient.squaredNorm();
}

double SurfacePatch::BowlOfLens(double k) const {
  return -SlopeBeyondLens(k).dot(8.0 * k * center) / value;
}

Eigen::Vector2d SurfacePatch::SlopeBeyondLens(double k) const {
  const Eigen::Matrix2d du_dx = (1.0 + k * center.squaredNorm()) * Eigen::Matrix2d::Identity() +
                                2.0 * k * center * center.transpose();
  return du_dx.transpose().inverse() * gradient;
}

std::optional<SurfacePatch> MeasurePatch(const cv::Mat_<float>& values,
                                         const cv::Mat_<cv::Vec2d>& rays, double rounding) {
  const cv::Point middle(values.cols / 2, values.rows / 2);
  const Eigen::Vector2d center(rays(middle)[0], rays(middle)[1]);
  const cv::Vec2d across = rays(middle.y, values.cols - 1) - rays(middle.y, 0);
  const double unit = 0.5 * std::hypot(across[0], across[1]);  // of the coordinates of the fit
  // Relative to a value of the patch, which keeps the digits.
  const double reference = values(middle);
  QuadraticFit fit;
  const auto for_each = [&](const auto& visit) {
    for (int y = 0; y < values.rows; ++y) {
      for (int x = 0; x < values.cols; ++x) {
        const Eigen::Vector2d ray(rays(y, x)[0], rays(y, x)[1]);
        if (!(values(y, x) > 0.0f) || !(ray.norm() < kMaxRadius)) continue;
        const Eigen::Vector2d local = (ray - center) / unit;
        visit(cv::Point(x, y), local.x(), local.y(), values(y, x) - reference);
      }
    }
  };
  for_each([&](const cv::Point&, double x, double y, double value) { fit.Add(x, y, value); });
  if (fit.count() < kMinFill * values.size().area() || !fit.Solve()) return std::nullopt;
  cv::Mat_<double> residuals(values.size(), std::numeric_limits<double>::quiet_NaN());
  for_each([&](const cv::Point& cell, double x, double y, double value) {
    residuals(cell) = fit.At(x, y) - value;
  });
  fit.SetVariance(
      std::max(rounding * rounding, VarianceOf(residuals, QuadraticFit::kNumParameters)));
  return MakePatch(fit, reference, unit, center);
}

}  // namespace msc_vo
