// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/linearized_camera.h"

#include <cmath>

#include <Eigen/LU>

namespace msc_vo {

namespace {

using S = SensorCorrection;

// Of points of the plane z = 1.
constexpr double kTolerance = 1e-10;

}  // namespace

LinearizedCamera::LinearizedCamera(const CorrectedCamera& camera, const S::Vector& correction)
    : given_(camera.camera()),
      given_center_(given_.cx, given_.cy),
      lens_(camera.distortion()),
      offset_(correction(S::kDepthOffset)),
      bowl_(correction(S::kDepthBowl)) {
  const double f = given_.FocalLength();
  focal_ = std::exp(correction(S::kFocalLength)) * Eigen::Vector2d(given_.fx, given_.fy);
  center_ = given_center_ + f * correction.segment<2>(S::kCenterX);
  lens_.k[0] += correction(S::kK1);
  lens_.k[1] += correction(S::kK2);
  lens_by_k_ = {lens_, lens_};
  for (size_t i = 0; i < lens_by_k_.size(); ++i) lens_by_k_[i].k[i] += 1.0;
  const double scale = std::exp(correction(S::kDepthFocalLength));
  const double c = scale * std::cos(correction(S::kDepthRoll));
  const double s = scale * std::sin(correction(S::kDepthRoll));
  turn_ << c, -s, s, c;
  depth_center_ = given_center_ + f * correction.segment<2>(S::kDepthX);
  parallax_ = f * correction.segment<2>(S::kDepthParallaxX);
}

Eigen::Vector2d LinearizedCamera::Pixel(const Eigen::Vector2d& x) const {
  return focal_.cwiseProduct(lens_.DistortNormalized(x)) + center_;
}

Eigen::Matrix2d LinearizedCamera::PixelByPoint(const Eigen::Vector2d& x) const {
  return focal_.asDiagonal() * lens_.Jacobian(x);
}

LinearizedCamera::ColorJacobian LinearizedCamera::PixelByCamera(const Eigen::Vector2d& x) const {
  const Eigen::Vector2d distorted = lens_.DistortNormalized(x);
  const double f = given_.FocalLength();
  ColorJacobian jacobian;
  jacobian.col(S::kFocalLength) = focal_.cwiseProduct(distorted);
  jacobian.col(S::kCenterX) << f, 0.0;
  jacobian.col(S::kCenterY) << 0.0, f;
  // Every model is linear in these coefficients.
  for (int i = 0; i < 2; ++i) {
    jacobian.col(S::kK1 + i) = focal_.cwiseProduct(lens_by_k_[i].DistortNormalized(x) - distorted);
  }
  return jacobian;
}

Eigen::Vector2d LinearizedCamera::Ray(const Eigen::Vector2d& pixel) const {
  return lens_.UndistortNormalized((pixel - center_).cwiseQuotient(focal_), kTolerance);
}

LinearizedCamera::ColorJacobian LinearizedCamera::RayByCamera(const Eigen::Vector2d& x) const {
  return -PixelByPoint(x).inverse() * PixelByCamera(x);
}

double LinearizedCamera::InverseDepth(const RgbdPairReprojection::View& view,
                                      DepthJacobian* jacobian) const {
  const InverseDepthPlane& plane = view.surface;
  const Eigen::Vector2d at_infinity = DepthPixelAtInfinity(view.recorded_pixel);
  const double denominator = 1.0 - plane.gradient.dot(parallax_);
  const double measured =
      (plane.inverse_depth + plane.gradient.dot(at_infinity - plane.pixel)) / denominator;
  const double squared_radius = given_.Ray(view.recorded_pixel).head<2>().squaredNorm();
  const double by_measured = 1.0 - squared_radius * bowl_;
  if (jacobian != nullptr) {
    const auto at = [](int index) { return index - kColorSize; };
    const Eigen::Vector2d turned = at_infinity - depth_center_;
    const Eigen::Vector2d by_pixel = by_measured / denominator * plane.gradient;
    const double f = given_.FocalLength();
    (*jacobian)(at(S::kDepthFocalLength)) = by_pixel.dot(turned);
    jacobian->segment<2>(at(S::kDepthX)) = f * by_pixel;
    (*jacobian)(at(S::kDepthRoll)) = by_pixel.y() * turned.x() - by_pixel.x() * turned.y();
    jacobian->segment<2>(at(S::kDepthParallaxX)) = f * measured * by_pixel;
    (*jacobian)(at(S::kDepthOffset)) = -1.0;
    (*jacobian)(at(S::kDepthBowl)) = -squared_radius * measured;
  }
  return measured * by_measured - offset_;
}

}  // namespace msc_vo
