// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <cmath>

#include <Eigen/Core>
#include <Eigen/LU>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/camera/radial_profile.h"

namespace msc_vo {

/// Corrections of the calibration of an RGB-D camera, as one parameter block. All zeros: the
/// calibration is right, and the depth of colour pixel (x, y) is depth(y, x).
struct SensorCorrection {
  /// Positions in the block.
  enum Index {
    kFocalLength,  ///< logarithm of the true over the given focal length, both axes
    kCenterX,      ///< focal lengths, true minus given principal point
    kCenterY,
    kK1,  ///< true minus given radial distortion
    kK2,
    kDepthFocalLength,  ///< logarithm of the magnification of the depth image
    kDepthX,            ///< focal lengths, shift of the depth image at infinity
    kDepthY,
    kDepthRoll,       ///< radians, rotation of the depth image
    kDepthParallaxX,  ///< metres, parallax of the depth image: pixels / focal length / 1/z
    kDepthParallaxY,
    kDepthOffset,  ///< 1/metres, measured minus true inverse depth
    kDepthBowl,    ///< inverse depths are too large by this times the squared radius (z = 1)
    kSize
  };

  /// Number of parameters of the colour camera, the first ones.
  static constexpr int kColorSize = kDepthFocalLength;

  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;

  /// The part that moves the depth images relative to the colour images.
  static Eigen::Matrix<double, kDepthOffset - kDepthFocalLength, 1> RegistrationOf(
      const Vector& correction) {
    return correction.segment<kDepthOffset - kDepthFocalLength>(kDepthFocalLength);
  }
};

/// An RGB-D camera with a correction of its calibration. Pixels are those of the recorded image,
/// with lens distortion. T: double or ceres::Jet.
class CorrectedCamera {
 public:
  template <typename T>
  using Vector2 = Eigen::Matrix<T, 2, 1>;

  /// `camera`: intrinsics of the undistorted image.
  CorrectedCamera(const PinholeCamera& camera, const LensDistortion& distortion)
      : camera_(distortion.Recorded(camera)), distortion_(distortion) {}

  /// Returns the recorded pixel of the point `x` of the plane z = 1.
  template <typename T>
  Vector2<T> Pixel(const Vector2<T>& x, const T* correction) const {
    using std::exp;
    const T scale = exp(correction[SensorCorrection::kFocalLength]);
    const Vector2<T> distorted = Distort<T>(x, correction);
    const Vector2<T> center = Center(correction);
    return {camera_.fx * scale * distorted.x() + center.x(),
            camera_.fy * scale * distorted.y() + center.y()};
  }

  /// Returns the point of the plane z = 1 whose Pixel() is `pixel`: by LensDistortion and a Newton
  /// step, which gives the derivatives.
  template <typename T>
  Vector2<T> Ray(const Eigen::Vector2d& pixel, const T* correction) const {
    using std::exp;
    constexpr double kTolerance = 1e-13;
    const T scale = exp(-correction[SensorCorrection::kFocalLength]);
    const Vector2<T> center = Center(correction);
    const Vector2<T> distorted((pixel.x() - center.x()) * scale / camera_.fx,
                               (pixel.y() - center.y()) * scale / camera_.fy);
    LensDistortion lens = distortion_;
    lens.k[0] += Scalar(correction[SensorCorrection::kK1]);
    lens.k[1] += Scalar(correction[SensorCorrection::kK2]);
    const Eigen::Vector2d x =
        lens.UndistortNormalized({Scalar(distorted.x()), Scalar(distorted.y())}, kTolerance);
    const Eigen::Matrix2d inverse = lens.Jacobian(x).inverse();
    const Vector2<T> at(T(x.x()), T(x.y()));
    return at + inverse.cast<T>() * (distorted - Distort<T>(at, correction));
  }

  /// Returns the pixel of the depth image that shows what colour pixel `pixel` shows, at inverse
  /// depth 0, and its change with the inverse depth (pixels times metres).
  template <typename T>
  void DepthPixel(const Eigen::Vector2d& pixel, const T* correction, Vector2<T>* at_infinity,
                  Vector2<T>* parallax) const {
    using std::cos;
    using std::exp;
    using std::sin;
    const T scale = exp(correction[SensorCorrection::kDepthFocalLength]);
    const T c = cos(correction[SensorCorrection::kDepthRoll]);
    const T s = sin(correction[SensorCorrection::kDepthRoll]);
    const T x = (pixel.x() - camera_.cx) * scale;
    const T y = (pixel.y() - camera_.cy) * scale;
    const double f = camera_.FocalLength();
    *at_infinity = {c * x - s * y + camera_.cx + f * correction[SensorCorrection::kDepthX],
                    s * x + c * y + camera_.cy + f * correction[SensorCorrection::kDepthY]};
    *parallax = {f * correction[SensorCorrection::kDepthParallaxX],
                 f * correction[SensorCorrection::kDepthParallaxY]};
  }

  /// Returns the true inverse depth (1/metres) of a measured one at recorded pixel `pixel`.
  template <typename T>
  T InverseDepth(const Eigen::Vector2d& pixel, const T& measured, const T* correction) const {
    const double squared_radius = camera_.Ray(pixel).head<2>().squaredNorm();
    return measured * (1.0 - squared_radius * correction[SensorCorrection::kDepthBowl]) -
           correction[SensorCorrection::kDepthOffset];
  }

  /// Intrinsics of the recorded image.
  const PinholeCamera& camera() const { return camera_; }
  const LensDistortion& distortion() const { return distortion_; }

 private:
  static double Scalar(double value) { return value; }
  template <typename Jet>
  static double Scalar(const Jet& value) {
    return value.a;
  }

  template <typename T>
  Vector2<T> Center(const T* correction) const {
    const double f = camera_.FocalLength();
    return {camera_.cx + f * correction[SensorCorrection::kCenterX],
            camera_.cy + f * correction[SensorCorrection::kCenterY]};
  }

  template <typename T>
  Vector2<T> Distort(const Vector2<T>& x, const T* correction) const {
    if (distortion_.model != LensModel::kRadialTangential) {
      return DistortByScale<T>(x, correction);
    }
    const T k1 = distortion_.k[0] + correction[SensorCorrection::kK1];
    const T k2 = distortion_.k[1] + correction[SensorCorrection::kK2];
    const T r2 = x.squaredNorm();
    const T radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * distortion_.k[4]));
    const T xy2 = 2.0 * x.x() * x.y();
    return {
        radial * x.x() + distortion_.k[2] * xy2 + distortion_.k[3] * (r2 + 2.0 * x.x() * x.x()),
        radial * x.y() + distortion_.k[3] * xy2 + distortion_.k[2] * (r2 + 2.0 * x.y() * x.y())};
  }

  template <typename T>
  Vector2<T> DistortByScale(const Vector2<T>& x, const T* correction) const {
    std::array<T, 8> k;
    for (size_t i = 0; i < k.size(); ++i) k[i] = T(distortion_.k[i]);
    k[0] += correction[SensorCorrection::kK1];
    k[1] += correction[SensorCorrection::kK2];
    const T r2 = x.squaredNorm();
    if (distortion_.model == LensModel::kFisheye) return FisheyeScale(k.data(), r2) * x;
    const T radial = RationalScale(k.data(), r2);
    const T xy2 = 2.0 * x.x() * x.y();
    return {radial * x.x() + k[2] * xy2 + k[3] * (r2 + 2.0 * x.x() * x.x()),
            radial * x.y() + k[3] * xy2 + k[2] * (r2 + 2.0 * x.y() * x.y())};
  }

  PinholeCamera camera_;  // of the recorded image
  LensDistortion distortion_;
};

}  // namespace msc_vo
