// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The rational and the fisheye model, and the undistorted images of wide lenses.

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/eigen_matchers.h"
#include "tests/support/lenses.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/camera/undistorted_camera.h"

namespace msc_vo {
namespace {

using Eigen::Vector2d;

TEST(LensModel, NamesRoundTrip) {
  for (const LensModel model :
       {LensModel::kRadialTangential, LensModel::kRational, LensModel::kFisheye}) {
    EXPECT_EQ(LensModelFromName(LensModelName(model)), model);
  }
  EXPECT_EQ(LensModelFromName("Fisheye"), std::nullopt);
  EXPECT_EQ(LensModelNames(), "radial-tangential, rational, fisheye");
  EXPECT_EQ(LensCoefficientList(LensModel::kRational), "k1 k2 p1 p2 k3 k4 k5 k6");
}

TEST(LensModels, AppliesRationalCoefficients) {
  // x = (0.5, 0.2), r^2 = 0.29.
  const Vector2d x(0.5, 0.2);
  for (int i = 0; i < 3; ++i) {
    LensDistortion lens{{}, LensModel::kRational};
    lens.k[5 + i] = 0.1;
    EXPECT_THAT(lens.DistortNormalized(x),
                IsNear(Vector2d(x / (1.0 + 0.1 * std::pow(0.29, i + 1))), 1e-15));
  }
  LensDistortion rational = AzureKinectLens();
  for (int i = 5; i < 8; ++i) rational.k[i] = 0.0;
  LensDistortion polynomial = rational;
  polynomial.model = LensModel::kRadialTangential;
  EXPECT_EQ(rational.DistortNormalized(x), polynomial.DistortNormalized(x));
}

TEST(LensModels, FisheyeIsEquidistantWithoutCoefficients) {
  const LensDistortion lens{{}, LensModel::kFisheye};
  EXPECT_FALSE(lens.IsZero());
  for (const double degrees : {1e-5, 1.0, 45.0, 80.0}) {
    const double theta = degrees * M_PI / 180.0;
    const Vector2d x = std::tan(theta) * Vector2d(0.6, -0.8);
    EXPECT_THAT(lens.DistortNormalized(x), IsNear(Vector2d(theta * Vector2d(0.6, -0.8)), 1e-15));
  }
  LensDistortion bent = lens;
  bent.k = {0.1, 0.2, 0.3, 0.4};
  // theta = pi / 4.
  const double t = M_PI / 4.0;
  EXPECT_NEAR(
      bent.DistortNormalized({1.0, 0.0}).x(),
      t + 0.1 * std::pow(t, 3) + 0.2 * std::pow(t, 5) + 0.3 * std::pow(t, 7) + 0.4 * std::pow(t, 9),
      1e-15);
}

// The whole recorded image, for each lens.
TEST(LensModels, UndistortInvertsDistortTo1e9Pixels) {
  const auto check = [](const PinholeCamera& camera, const LensDistortion& lens) {
    const PinholeCamera& recorded = lens.Recorded(camera);
    double largest_shift = 0.0;
    for (int y = 0; y < recorded.height; y += 13) {
      for (int x = 0; x < recorded.width; x += 17) {
        const Vector2d pixel(x, y);
        const Vector2d undistorted = lens.Undistort(camera, pixel);
        EXPECT_THAT(lens.Distort(camera, undistorted), IsNear(pixel, 1e-9));
        largest_shift = std::max(largest_shift, (undistorted - pixel).norm());
      }
    }
    EXPECT_GT(largest_shift, 5.0);
  };
  check(AzureKinectCamera(), AzureKinectLens());
  for (const std::optional<double>& field_of_view : {std::optional<double>(), {70.0}, {125.0}}) {
    PinholeCamera camera = WideCamera();
    LensDistortion lens = WideLens();
    CropToFieldOfView(field_of_view, &lens, &camera);
    check(camera, lens);
  }
}

TEST(LensModels, JacobianMatchesFiniteDifferences) {
  constexpr double kStep = 1e-6;
  const LensDistortion fisheye{{0.05, -0.02, 0.01, -0.003}, LensModel::kFisheye};
  for (const LensDistortion& lens : {AzureKinectLens(), WideLens(), fisheye}) {
    for (const Vector2d& x :
         {Vector2d(0.5, -0.3), Vector2d(-0.02, 0.01), Vector2d(0.9, 0.8), Vector2d(0.0, 0.0)}) {
      Eigen::Matrix2d numeric;
      for (int i = 0; i < 2; ++i) {
        const Vector2d step = kStep * Vector2d::Unit(i);
        numeric.col(i) =
            (lens.DistortNormalized(x + step) - lens.DistortNormalized(x - step)) / (2.0 * kStep);
      }
      EXPECT_LT((lens.Jacobian(x) - numeric).norm(), 1e-8) << x.transpose();
    }
  }
}

TEST(LensModels, PixelsThatNoRayReachesAreFarOutside) {
  // r / (1 + r^2) is at most 1/2.
  LensDistortion rational{{}, LensModel::kRational};
  rational.k[5] = 1.0;
  const LensDistortion fisheye{{}, LensModel::kFisheye};  // at most pi / 2
  for (const LensDistortion& lens : {rational, fisheye}) {
    const Vector2d x = lens.UndistortNormalized(Vector2d(1.5, -1.0), 1e-12);
    EXPECT_TRUE(x.allFinite());
    EXPECT_GT(x.norm(), 100.0);
    EXPECT_GT(x.x(), 0.0);
  }
}

TEST(LensModels, FoldsAreRefused) {
  std::string error;
  EXPECT_TRUE(IsInvertible(AzureKinectLens(), AzureKinectCamera(), &error)) << error;
  LensDistortion rational = AzureKinectLens();
  std::swap(rational.k[2], rational.k[4]);  // k3 in the place of p1
  EXPECT_FALSE(IsInvertible(rational, AzureKinectCamera(), &error));
  EXPECT_THAT(error, Names("fold", "k1 k2 p1 p2 k3 k4 k5 k6"));

  // theta - 0.4 theta^3 has its maximum at 52.3 degrees.
  LensDistortion fisheye{{-0.4}, LensModel::kFisheye};
  PinholeCamera camera = WideCamera();
  CropToFieldOfView(100.0, &fisheye, &camera);
  EXPECT_FALSE(IsInvertible(fisheye, camera, &error));
  EXPECT_THAT(error, Names("fold", "k1 k2 k3 k4", "-0.4", "field_of_view"));
  camera = WideCamera();
  CropToFieldOfView(70.0, &fisheye, &camera);
  EXPECT_TRUE(IsInvertible(fisheye, camera, &error)) << error;
}

TEST(UndistortedCamera, KeepsWhatIsAskedFor) {
  PinholeCamera camera = WideCamera();
  LensDistortion lens = WideLens();
  EXPECT_NEAR(FieldOfView(lens, camera), 120.0, 5.0);
  CropToFieldOfView(90.0, &lens, &camera);
  ASSERT_TRUE(lens.recorded.has_value());
  EXPECT_EQ(lens.recorded->fx, WideCamera().fx);
  EXPECT_EQ(camera.width, WideCamera().width);
  EXPECT_NEAR(camera.fx, camera.cx, 1e-9);  // 45 degrees to each side
  EXPECT_NEAR(camera.fy / camera.fx, WideCamera().fy / WideCamera().fx, 1e-12);
  // What the two images show at the principal point is the optical axis.
  EXPECT_THAT(lens.Undistort(camera, {WideCamera().cx, WideCamera().cy}),
              IsNear(Vector2d(camera.cx, camera.cy), 1e-9));
}

TEST(UndistortedCamera, DefaultKeepsNoMoreThanWasRecorded) {
  PinholeCamera camera = WideCamera();
  LensDistortion lens = WideLens();
  CropToFieldOfView({}, &lens, &camera);
  EXPECT_NEAR(FieldOfView({}, camera), kMaxDefaultFieldOfView, 1e-9);

  PinholeCamera narrow = WideCamera();
  narrow.fx = narrow.fy = 525.0;
  LensDistortion narrow_lens = WideLens();
  const double recorded = FieldOfView(narrow_lens, narrow);
  EXPECT_LT(recorded, kMaxDefaultFieldOfView);
  CropToFieldOfView({}, &narrow_lens, &narrow);
  EXPECT_NEAR(FieldOfView({}, narrow), recorded, 1e-9);

  camera = AzureKinectCamera();
  lens = AzureKinectLens();
  CropToFieldOfView({}, &lens, &camera);
  EXPECT_FALSE(lens.recorded.has_value());
  EXPECT_EQ(camera.fx, AzureKinectCamera().fx);
}

TEST(UndistortedCamera, NamesValidRange) {
  std::string error;
  EXPECT_TRUE(IsValidFieldOfView(100.0, &error));
  EXPECT_FALSE(IsValidFieldOfView(180.0, &error));
  EXPECT_THAT(error, Names("field_of_view", "180", "10", "150"));
  EXPECT_FALSE(IsValidFieldOfView(std::nan(""), &error));
}

}  // namespace
}  // namespace msc_vo
