// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/pinhole_camera.h"

#include <limits>
#include <string>

#include "tests/support/eigen_matchers.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// Intrinsics and distortion of TUM RGB-D's freiburg1, as published with the data set.
PinholeCamera Freiburg1() {
  PinholeCamera camera;
  camera.fx = 517.306408;
  camera.fy = 516.469215;
  camera.cx = 318.643040;
  camera.cy = 255.313989;
  return camera;
}
const LensDistortion kFreiburg1{{0.262383, -0.953104, -0.005358, 0.002628, 1.163314}};

TEST(PinholeCamera, ProjectByHandWithEitherSignOfFy) {
  PinholeCamera camera;
  camera.fx = 500.0;
  camera.fy = 400.0;
  camera.cx = 320.0;
  camera.cy = 240.0;
  EXPECT_THAT(camera.Project({0.2, -0.1, 2.0}), IsNear(Eigen::Vector2d(370.0, 220.0), 1e-12));
  camera.fy = -400.0;
  EXPECT_THAT(camera.Project({0.2, -0.1, 2.0}), IsNear(Eigen::Vector2d(370.0, 260.0), 1e-12));
  EXPECT_DOUBLE_EQ(camera.FocalLength(), 450.0);
}

TEST(PinholeCamera, BackProjectUndoesProject) {
  for (const double fy : {525.0, -480.0}) {
    PinholeCamera camera;
    camera.fy = fy;
    const Eigen::Vector3d x(0.4, -0.3, 2.5);
    EXPECT_THAT(camera.BackProject(camera.Project(x), 2.5), IsNear(x, 1e-14));
    EXPECT_DOUBLE_EQ(camera.Ray({17.0, 23.0}).z(), 1.0);
  }
}

TEST(PinholeCamera, InsideMeansBetweenTheCentresOfTheOuterPixels) {
  const PinholeCamera camera;
  EXPECT_TRUE(camera.IsInside({0.0, 0.0}));
  EXPECT_TRUE(camera.IsInside({639.0, 479.0}));
  EXPECT_FALSE(camera.IsInside({639.1, 100.0}));
  EXPECT_FALSE(camera.IsInside({100.0, -0.1}));
  EXPECT_FALSE(camera.IsInside({3.0, 100.0}, 4.0));
  EXPECT_TRUE(camera.IsInside({4.0, 100.0}, 4.0));
}

TEST(PinholeCamera, ValidityNamesWhatIsWrong) {
  std::string error;
  PinholeCamera camera;
  EXPECT_TRUE(camera.IsValid(&error));
  camera.fy = -480.0;
  EXPECT_TRUE(camera.IsValid(&error));
  camera.fy = 0.0;
  EXPECT_FALSE(camera.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("fy"));
  camera = PinholeCamera();
  camera.cx = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(camera.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("cx"));
  camera = PinholeCamera();
  camera.height = 0;
  EXPECT_FALSE(camera.IsValid(&error));
  EXPECT_THAT(error, ::testing::HasSubstr("height"));
}

TEST(PinholeCamera, NumbersThatNoCameraHasAreNotValid) {
  const auto problem = [](PinholeCamera camera) {
    std::string error;
    return camera.IsValid(&error) ? std::string() : error;
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(problem({535.4, 539.2, 320.1, 247.6, 640, 480}), "");
  EXPECT_EQ(problem({481.2, -480.0, 319.5, 239.5, 640, 480}), "");  // ICL-NUIM
  EXPECT_THAT(problem({-535.4, 539.2, 320.1, 247.6, 640, 480}),
              HasSubstr("fx = -535.4 must be from 12.8 to 128000 pixels"));
  EXPECT_THAT(problem({5.354, 5.392, 320.1, 247.6, 640, 480}), HasSubstr("fx = 5.354"));
  EXPECT_THAT(problem({1e9, 1e9, 320.1, 247.6, 640, 480}), HasSubstr("fx = 1e+09"));
  EXPECT_THAT(problem({535.4, 53.92, 320.1, 247.6, 640, 480}), HasSubstr("fy = 53.92"));
  EXPECT_THAT(problem({535.4, -5392, 320.1, 247.6, 640, 480}), HasSubstr("fy = 5392"));
  EXPECT_THAT(problem({535.4, 539.2, 3201.0, 247.6, 640, 480}), HasSubstr("cx = 3201"));
  EXPECT_THAT(problem({535.4, 539.2, 320.1, -1.0, 640, 480}), HasSubstr("cy = -1"));
  EXPECT_THAT(problem({535.4, 539.2, 320.1, 247.6, 2147483647, 480}), HasSubstr("width"));
  EXPECT_THAT(problem({std::nan(""), 539.2, 320.1, 247.6, 640, 480}), HasSubstr("fx = nan"));
}

TEST(LensDistortion, NoLensChangesNothing) {
  const LensDistortion none;
  EXPECT_TRUE(none.IsZero());
  EXPECT_FALSE(kFreiburg1.IsZero());
  const Eigen::Vector2d pixel(12.5, 400.25);
  EXPECT_THAT(none.Distort(Freiburg1(), pixel), IsNear(pixel, 1e-12));
  EXPECT_EQ(none.Undistort(Freiburg1(), pixel), pixel);
}

TEST(LensDistortion, EachCoefficientByHand) {
  // fx = fy = 1 and no offset, so that pixels are the plane z = 1; x = (0.5, 0.2), r^2 = 0.29.
  PinholeCamera camera;
  camera.fx = camera.fy = 1.0;
  camera.cx = camera.cy = 0.0;
  const Eigen::Vector2d x(0.5, 0.2);
  const auto distort = [&](int i) {
    LensDistortion lens;
    lens.k[i] = 0.1;
    return Eigen::Vector2d(lens.Distort(camera, x) - x);
  };
  EXPECT_THAT(distort(0), IsNear(Eigen::Vector2d(0.0145, 0.0058), 1e-15));
  EXPECT_THAT(distort(1), IsNear(Eigen::Vector2d(0.004205, 0.001682), 1e-15));
  EXPECT_THAT(distort(4), IsNear(Eigen::Vector2d(0.00121945, 0.00048778), 1e-15));
  // p1: (2 x y, r^2 + 2 y^2); p2: (r^2 + 2 x^2, 2 x y).
  EXPECT_THAT(distort(2), IsNear(Eigen::Vector2d(0.02, 0.037), 1e-15));
  EXPECT_THAT(distort(3), IsNear(Eigen::Vector2d(0.079, 0.02), 1e-15));
}

TEST(LensDistortion, UndistortUndoesDistortOverTheWholeImage) {
  for (const double sign : {1.0, -1.0}) {
    PinholeCamera camera = Freiburg1();
    camera.fy *= sign;
    double most = 0.0;
    for (double v = 0.0; v <= 479.0; v += 47.9) {
      for (double u = 0.0; u <= 639.0; u += 63.9) {
        const Eigen::Vector2d seen(u, v);
        const Eigen::Vector2d ideal = kFreiburg1.Undistort(camera, seen);
        EXPECT_THAT(kFreiburg1.Distort(camera, ideal), IsNear(seen, 1e-6));
        most = std::max(most, (ideal - seen).norm());
      }
    }
    EXPECT_GT(most, 5.0);  // this lens is not to be ignored
  }
}

}  // namespace
}  // namespace msc_vo
