// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "msc_vo/camera/pinhole_camera.h"

namespace msc_vo {

/// Models of lens distortion, with the equations and the coefficients of OpenCV.
enum class LensModel {
  kRadialTangential,  ///< Brown-Conrady: k1 k2 p1 p2 k3
  kRational,          ///< Brown-Conrady over a second polynomial: k1 k2 p1 p2 k3 k4 k5 k6
  kFisheye,           ///< equidistant, Kannala-Brandt: k1 k2 k3 k4
};

/// "radial-tangential", "rational" or "fisheye".
const char* LensModelName(LensModel model);

/// Returns the model of this name; std::nullopt for any other name.
std::optional<LensModel> LensModelFromName(const std::string& name);

/// "radial-tangential, rational, fisheye", for messages.
std::string LensModelNames();

/// Names of the coefficients in OpenCV's order: {"k1", "k2", "p1", "p2", "k3"}.
const std::vector<std::string>& LensCoefficientNames(LensModel model);

/// "k1 k2 p1 p2 k3", for messages.
std::string LensCoefficientList(LensModel model);

/// Lens distortion of OpenCV's models: a map x -> x_d of the plane z = 1, with r = |x|.
///
/// - radial-tangential: x_d = R x + (2 p1 x y + p2 (r^2 + 2 x^2), p1 (r^2 + 2 y^2) + 2 p2 x y) with
///   R = 1 + k1 r^2 + k2 r^4 + k3 r^6.
/// - rational: the same with R = (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6).
/// - fisheye: x_d = theta_d / r x with theta = atan(r) and
///   theta_d = theta (1 + k1 theta^2 + k2 theta^4 + k3 theta^6 + k4 theta^8).
///
/// Everything behind the images uses the pinhole camera of the undistorted image. Its intrinsics
/// are those of the recorded image, unless the lens sees so much more than a pinhole camera of
/// these intrinsics that the undistorted image has its own, see UndistortedCamera().
struct LensDistortion {
  /// In the order of LensCoefficientNames(); the others are 0.
  std::array<double, 8> k = {};
  LensModel model = LensModel::kRadialTangential;
  /// Intrinsics and size of the recorded image, if they are not those of the undistorted image.
  std::optional<PinholeCamera> recorded = {};

  /// Tests whether recorded and undistorted image are the same.
  bool IsZero() const {
    return k == std::array<double, 8>{} && model != LensModel::kFisheye && !recorded;
  }
  /// Tests whether the undistorted image is a chosen part of what the lens sees, so that recorded
  /// pixels may belong to no pixel of it.
  bool IsCropped() const { return model == LensModel::kFisheye || recorded; }
  /// Coefficients of the model.
  std::vector<double> Coefficients() const {
    return {k.begin(), k.begin() + static_cast<long>(LensCoefficientNames(model).size())};
  }
  /// Intrinsics of the recorded image; `camera`: of the undistorted one.
  const PinholeCamera& Recorded(const PinholeCamera& camera) const {
    return recorded ? *recorded : camera;
  }

  /// Distorts a point of the plane z = 1.
  Eigen::Vector2d DistortNormalized(const Eigen::Vector2d& x) const;
  /// Derivative of DistortNormalized() with respect to `x`; symmetric.
  Eigen::Matrix2d Jacobian(const Eigen::Vector2d& x) const;
  /// Returns the point whose DistortNormalized() is `x_d`, to `tolerance`. Uses fixed-point
  /// iteration, with a Newton step where that converges slowly or not at all, at most 100 steps;
  /// for a fisheye lens Newton's method for theta. The result is finite for any lens, and correct
  /// for lenses that pass IsInvertible(); for rational and fisheye lenses it is a point far outside
  /// the image, in the direction of `x_d`, if no point is found.
  Eigen::Vector2d UndistortNormalized(const Eigen::Vector2d& x_d, double tolerance) const;

  /// Returns the recorded pixel of a pixel of the undistorted image of `camera`.
  Eigen::Vector2d Distort(const PinholeCamera& camera, const Eigen::Vector2d& pixel) const;
  /// Returns the undistorted pixel whose Distort() is `pixel`, to 1e-9 px, see
  /// UndistortNormalized().
  Eigen::Vector2d Undistort(const PinholeCamera& camera, const Eigen::Vector2d& pixel) const;
};

}  // namespace msc_vo
