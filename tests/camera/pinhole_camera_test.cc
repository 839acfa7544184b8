// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/pinhole_camera.h"

#include <cmath>
#include <limits>
#include <string>

#include "tests/support/eigen_matchers.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

TEST(PinholeCamera, ProjectsWithEitherSignOfFy) {
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

TEST(PinholeCamera, BackProjectInvertsProject) {
  for (const double fy : {525.0, -480.0}) {
    PinholeCamera camera;
    camera.fy = fy;
    const Eigen::Vector3d x(0.4, -0.3, 2.5);
    EXPECT_THAT(camera.BackProject(camera.Project(x), 2.5), IsNear(x, 1e-14));
    EXPECT_DOUBLE_EQ(camera.Ray({17.0, 23.0}).z(), 1.0);
  }
}

TEST(PinholeCamera, IsInsideBetweenCentresOfBorderPixels) {
  const PinholeCamera camera;
  EXPECT_TRUE(camera.IsInside({0.0, 0.0}));
  EXPECT_TRUE(camera.IsInside({639.0, 479.0}));
  EXPECT_FALSE(camera.IsInside({639.1, 100.0}));
  EXPECT_FALSE(camera.IsInside({100.0, -0.1}));
  EXPECT_FALSE(camera.IsInside({3.0, 100.0}, 4.0));
  EXPECT_TRUE(camera.IsInside({4.0, 100.0}, 4.0));
}

TEST(PinholeCamera, NamesInvalidNumber) {
  std::string error;
  PinholeCamera camera;
  EXPECT_TRUE(camera.IsValid(&error));
  camera.fy = -480.0;
  EXPECT_TRUE(camera.IsValid(&error));
  camera.fy = 0.0;
  EXPECT_FALSE(camera.IsValid(&error));
  EXPECT_THAT(error, Names("fy"));
  camera = PinholeCamera();
  camera.cx = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(camera.IsValid(&error));
  EXPECT_THAT(error, Names("cx", "image size"));
  camera = PinholeCamera();
  camera.height = 0;
  EXPECT_FALSE(camera.IsValid(&error));
  EXPECT_THAT(error, Names("height"));
}

TEST(PinholeCamera, RejectsNumbersOutsidePhysicalRange) {
  const auto problem = [](PinholeCamera camera) {
    std::string error;
    return camera.IsValid(&error) ? std::string() : error;
  };
  EXPECT_EQ(problem({535.4, 539.2, 320.1, 247.6, 640, 480}), "");
  EXPECT_EQ(problem({481.2, -480.0, 319.5, 239.5, 640, 480}), "");  // ICL-NUIM
  EXPECT_THAT(problem({-535.4, 539.2, 320.1, 247.6, 640, 480}),
              Names("fx", "-535.4", "12.8", "128000"));
  EXPECT_THAT(problem({5.354, 5.392, 320.1, 247.6, 640, 480}), Names("fx", "5.354"));
  EXPECT_THAT(problem({1e9, 1e9, 320.1, 247.6, 640, 480}), Names("fx", "1e+09"));
  EXPECT_THAT(problem({535.4, 53.92, 320.1, 247.6, 640, 480}), Names("fy", "53.92"));
  EXPECT_THAT(problem({535.4, -5392, 320.1, 247.6, 640, 480}), Names("fy", "5392"));
  EXPECT_THAT(problem({535.4, 539.2, 3201.0, 247.6, 640, 480}), Names("cx", "3201"));
  EXPECT_THAT(problem({535.4, 539.2, 320.1, -1.0, 640, 480}), Names("cy", "-1"));
  EXPECT_THAT(problem({535.4, 539.2, 320.1, 247.6, 2147483647, 480}), Names("width"));
  EXPECT_THAT(problem({std::nan(""), 539.2, 320.1, 247.6, 640, 480}), Names("fx", "nan"));
}

}  // namespace
}  // namespace msc_vo
