// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/pair_view.h"

#include <gtest/gtest.h>

#include "msc_vo/frame/rolling_shutter.h"

namespace msc_vo {
namespace {

// Points all over the image of a camera that turns by 29 degrees per second.
class PairViewTest : public testing::TestWithParam<double> {  // k1
 protected:
  PairViewTest() {
    lens_.k[0] = GetParam();
    frame_.camera = {500.0, 500.0, 320.0, 240.0, 640, 480};
    for (int i = 0; i < 20; ++i) {
      PointFeature point;
      point.pixel = {30.0 + 30.0 * i, 20.0 + 23.0 * i};
      point.inverse_depth = i % 2 == 0 ? 0.5 : 0.0;
      frame_.points.push_back(point);
    }
    velocity_.angular = {0.3, 0.4, -0.1};
    velocity_.linear = {0.2, 0.0, 0.1};
  }

  Eigen::Vector2d Recorded(const Eigen::Vector2d& pixel) const {
    return lens_.IsZero() ? pixel : lens_.Distort(frame_.camera, pixel);
  }

  LensDistortion lens_;
  CameraVelocity velocity_;
  Frame frame_;  // as recorded, not compensated
};

TEST_P(PairViewTest, FollowsTheCompensationOfTheRollingShutter) {
  const Frame known = CompensateRollingShutter(frame_, velocity_, 0.0);
  for (const double readout_time : {0.02, -0.01}) {
    const Frame compensated = CompensateRollingShutter(frame_, velocity_, readout_time);
    for (size_t i = 0; i < frame_.points.size(); ++i) {
      const auto view = MakePairView(lens_, known, known.points[i]);
      const Eigen::Vector2d expected = Recorded(compensated.points[i].pixel);
      EXPECT_GT((expected - view.pixel).norm(), i == 9 || i == 10 ? 0.0 : 0.1);
      EXPECT_LT((view.recorded_pixel + readout_time * view.pixel_rate - expected).norm(), 0.05);
    }
  }
}

TEST_P(PairViewTest, FindsTheRecordedPixelOfACompensatedPoint) {
  const Frame compensated = CompensateRollingShutter(frame_, velocity_, 0.02);
  for (size_t i = 0; i < frame_.points.size(); ++i) {
    const auto view = MakePairView(lens_, compensated, compensated.points[i]);
    EXPECT_LT((view.recorded_pixel - Recorded(frame_.points[i].pixel)).norm(), 0.1);
    EXPECT_LT((view.recorded_pixel + 0.02 * view.pixel_rate - view.pixel).norm(), 0.05);
  }
}

TEST_P(PairViewTest, PointsOfACameraAtRestDoNotMove) {
  const auto view = MakePairView(lens_, frame_, frame_.points[0]);
  EXPECT_EQ(view.pixel_rate, Eigen::Vector2d::Zero());
  EXPECT_EQ(view.recorded_pixel, view.pixel);
  EXPECT_EQ(SquaredShiftRate(frame_), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Lenses, PairViewTest, testing::Values(0.0, -0.1));

TEST(CommonVariance, GrowsWithTheUncertaintyOfTheShutter) {
  const PinholeCamera camera{500.0, 500.0, 319.5, 239.5, 640, 480};
  EXPECT_NEAR(CommonVariance(camera, 0.0, 0.02, 0.01), 0.04, 1e-12);
  // Ten percent of a shift of 5 px, and a shift of 2.5 px that is even over the rows.
  EXPECT_NEAR(CommonVariance(camera, 250.0 * 250.0, 0.02, 0.0), 0.04 + 0.25, 1e-12);
  EXPECT_NEAR(CommonVariance(camera, 250.0 * 250.0, 0.0, 0.01), 0.04 + 6.25 / 12.0, 1e-12);
}

TEST(CommonVariance, IsThatOfOneAngleInImagesOfEverySize) {
  const PinholeCamera camera{500.0, 500.0, 319.5, 239.5, 640, 480};
  const PinholeCamera small{250.0, 250.0, 159.5, 119.5, 320, 240};
  EXPECT_NEAR(CommonVariance(small, 125.0 * 125.0, 0.02, 0.01),
              0.25 * CommonVariance(camera, 250.0 * 250.0, 0.02, 0.01), 1e-12);
}

}  // namespace
}  // namespace msc_vo
