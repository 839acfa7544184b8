// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_bounds.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "msc_vo/self_calibration/calibration_evidence.h"

namespace msc_vo {
namespace {

using S = SensorCorrection;

const CameraIntrinsics kGivenIntrinsics{{525.0, 525.0, 319.5, 239.5, 640, 480}, {}};

std::string Describe(int index, double value, const CameraIntrinsics& given = kGivenIntrinsics) {
  S::Vector correction = S::Vector::Zero();
  correction(index) = value;
  return DescribeImplausible(given, correction);
}

TEST(CalibrationBounds, ContainWrongCalibrations) {
  EXPECT_EQ(DescribeImplausible(kGivenIntrinsics, S::Vector::Zero()), "");
  for (int i = 0; i < S::kSize; ++i) {
    for (const double sigmas : {-2.0, 2.0}) {
      EXPECT_EQ(Describe(i, sigmas * WrongCalibrationSigma()(i)), "") << i;
    }
  }
}

TEST(CalibrationBounds, NameWhatNoCameraHas) {
  struct Case {
    int index;
    double value;
    const char* words;
  };
  const std::vector<Case> cases = {{S::kFocalLength, std::log(2.28), "2.28 times"},
                                   {S::kFocalLength, -0.5, "0.61 times"},
                                   {S::kCenterX, 0.25, "middle of the image"},
                                   {S::kCenterY, -0.2, "middle of the image"},
                                   {S::kK1, 0.6, "outwards by"},
                                   {S::kK1, -0.9, "folds over"},
                                   {S::kDepthFocalLength, 0.7, "magnified"},
                                   {S::kDepthX, 0.2, "shifted"},
                                   {S::kDepthY, -0.2, "shifted"},
                                   {S::kDepthRoll, 0.15, "turned by 8.6 degrees"},
                                   {S::kDepthParallaxY, -0.4, "40 cm"},
                                   {S::kDepthOffset, 0.3, "0.300 1/m"},
                                   {S::kDepthBowl, -0.5, "-50 %"}};
  for (const Case& c : cases) {
    EXPECT_THAT(Describe(c.index, c.value), testing::HasSubstr(c.words)) << c.index;
    EXPECT_NE(Describe(c.index, std::nan("")), "") << c.index;
  }
}

TEST(CalibrationBounds, FollowTheGivenCamera) {
  // A narrow camera, a cropped image, a lens of its own.
  CameraIntrinsics narrow = kGivenIntrinsics, cropped = kGivenIntrinsics, lens = kGivenIntrinsics;
  narrow.camera.fx = narrow.camera.fy = 1200.0;
  cropped.camera.cx = 60.0;
  lens.distortion.k[0] = 0.7;
  for (const CameraIntrinsics& given : {narrow, cropped, lens}) {
    EXPECT_EQ(DescribeImplausible(given, S::Vector::Zero()), "");
  }
  EXPECT_NE(Describe(S::kFocalLength, 0.05, narrow), "");
  EXPECT_EQ(Describe(S::kFocalLength, -0.05, narrow), "");
  EXPECT_EQ(Describe(S::kCenterX, 0.4, cropped), "");
  EXPECT_EQ(Describe(S::kK1, -0.6, lens), "");
}

}  // namespace
}  // namespace msc_vo
