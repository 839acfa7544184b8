// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/camera/lens_validity.h"

#include <limits>
#include <string>
#include <vector>

#include "tests/camera/freiburg1.h"
#include "tests/support/message_matchers.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

// The farthest corner of freiburg1 has radius 0.8 on the plane z = 1.
std::string Problem(const LensDistortion& lens, const PinholeCamera& camera = kFreiburg1) {
  std::string error;
  return IsInvertible(lens, camera, &error) ? "" : error;
}

TEST(IsInvertible, AcceptsRealLenses) {
  EXPECT_EQ(Problem({}), "");
  EXPECT_EQ(Problem(kFreiburg1Lens), "");
  EXPECT_EQ(Problem({{0.231222, -0.784899, -0.003257, -0.000105, 0.917205}}), "");
  EXPECT_EQ(Problem({{-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0}},
                    {458.654, 457.296, 367.215, 248.375, 752, 480}),
            "");  // wide angle, barrel distortion
  EXPECT_EQ(Problem({{-0.2, 0.0, 0.0, 0.0, 0.0}}), "");
  EXPECT_EQ(Problem({{0.4, 0.0, 0.0, 0.0, 0.0}}), "");
}

TEST(IsInvertible, NamesFoldRadiusAndCoefficientOrder) {
  // r (1 - 0.3 r^2) has its maximum 0.703 at r = 1.054, and no recorded pixel lies beyond it.
  EXPECT_THAT(Problem({{-0.3, 0.0, 0.0, 0.0, 0.0}}),
              Names("fold", "1.05", "545", "0.703", "363", "k1 k2 p1 p2 k3"));
  // 1 + 3 k1 r^2 + 5 k2 r^4 = 0 at r = 0.740.
  EXPECT_THAT(Problem({{0.262383, -0.953104, 0.0, 0.0, 0.0}}), Names("fold", "0.741"));
}

TEST(IsInvertible, RejectsMisplacedCoefficients) {
  for (const LensDistortion& lens : std::vector<LensDistortion>{
           {{0.262383, -0.953104, 1.163314, -0.005358, 0.002628}},  // k1 k2 k3 p1 p2
           {{0.262383, -9.53104, -0.005358, 0.002628, 1.163314}},   // misplaced decimal
           {{-2.62383, -0.953104, -0.005358, 0.002628, 1.163314}},
           {{0.262383, -0.953104, -0.5358, 0.002628, 1.163314}},
           {{0.262383, -0.953104, -0.005358, 0.002628, 0.0}},  // without k3
           {{-1e6, 0.0, 0.0, 0.0, 0.0}},
           {{0.0, 0.0, 1e300, 0.0, 1e300}},
           {{-1e308, 1e308, 0.0, 0.0, 1e308}}}) {
    EXPECT_THAT(Problem(lens), Names("fold"));
  }
  EXPECT_THAT(Problem({{std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0, 0.0, 0.0}}),
              Names("finite"));
}

// Accepted lenses are inverted by LensDistortion::Undistort at every pixel.
TEST(IsInvertible, AcceptedLensesUndistortWholeImage) {
  int num_accepted = 0;
  for (const double k1 : {-0.25, -0.2, -0.1, 0.3, 1.0, 3.0}) {
    for (const double k2 : {-0.1, 0.0, 0.5, 5.0}) {
      const LensDistortion lens{{k1, k2, 0.003, -0.004, 0.0}};
      if (!Problem(lens).empty()) continue;
      ++num_accepted;
      for (int y = 0; y < kFreiburg1.height; y += 53) {
        for (int x = 0; x < kFreiburg1.width; x += 71) {
          const Eigen::Vector2d distorted(x, y);
          const Eigen::Vector2d undistorted = lens.Undistort(kFreiburg1, distorted);
          EXPECT_LT((lens.Distort(kFreiburg1, undistorted) - distorted).norm(), 1e-6)
              << k1 << " " << k2 << " at " << distorted.transpose();
        }
      }
    }
  }
  EXPECT_GE(num_accepted, 15);
}

}  // namespace
}  // namespace msc_vo
