// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map_alignment.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

using testing::ElementsAre;
using Vector6 = Eigen::Matrix<double, 6, 1>;

class MapAlignmentTest : public testing::Test {
 protected:
  // A frame with errors of 1 mm and 1 mrad, times `sigmas`, in each map. Map b is 20 m from its
  // origin, where rotation errors have a long lever arm.
  FrameInTwoMaps MakeFrame(int index, double sigmas = 1.0) {
    const Rigid3 cam_from_b(ExpSO3({0.0, 0.1 * index, 0.05}), {0.1 * index, -20.0, 0.3});
    FrameInTwoMaps frame;
    frame.cam_from_b = Disturb(sigmas) * cam_from_b;
    frame.cam_from_a = Disturb(sigmas) * cam_from_b * a_from_b_.Inverse();
    frame.covariance_a = frame.covariance_b = IsotropicCovariance(1e-3, 1e-3);
    return frame;
  }
  Rigid3 Disturb(double sigmas) {
    std::normal_distribution<double> error(0.0, 1e-3 * sigmas);
    const Eigen::Vector3d w(error(random_), error(random_), error(random_));
    return {ExpSO3(w), {error(random_), error(random_), error(random_)}};
  }
  // Error of the alignment at the cameras.
  double PositionError(const MapAlignment& alignment) {
    const Eigen::Vector3d center = MakeFrame(1, 0.0).cam_from_b.OriginInSource();
    return (alignment.a_from_b * center - a_from_b_ * center).norm();
  }

  std::mt19937 random_{1};
  const Rigid3 a_from_b_{ExpSO3({0.4, -1.2, 0.7}), {5.0, 1.0, -2.0}};
};

TEST_F(MapAlignmentTest, AlignsByFramesThatAgree) {
  const auto alignment = AlignMaps({MakeFrame(0), MakeFrame(1), MakeFrame(2)});
  ASSERT_TRUE(alignment.has_value());
  EXPECT_THAT(alignment->inliers, ElementsAre(true, true, true));
  EXPECT_LT(PositionError(*alignment), 0.004);
  // Three frames agree, but share the errors of the maps: 1 cm in each.
  const FrameInTwoMaps frame = MakeFrame(1, 0.0);
  const PoseCovariance of_camera = CameraCovariance(
      frame.cam_from_b, ComposeCovariances(frame.cam_from_a, PoseCovariance::Zero(),
                                           alignment->a_from_b, alignment->covariance));
  EXPECT_NEAR(std::sqrt(of_camera(3, 3)), std::sqrt(2.0) * 0.01, 0.002);
}

TEST_F(MapAlignmentTest, ExactFramesGiveTheExactAlignment) {
  const auto alignment = AlignMaps({MakeFrame(0, 0.0), MakeFrame(3, 0.0), MakeFrame(6, 0.0)});
  ASSERT_TRUE(alignment.has_value());
  EXPECT_TRUE(alignment->a_from_b.params.isApprox(a_from_b_.params, 1e-9));
}

TEST_F(MapAlignmentTest, LeavesOutAFrameThatWasFoundInTheWrongPlace) {
  FrameInTwoMaps wrong = MakeFrame(3);
  wrong.cam_from_b.translation().x() += 0.3;
  const auto alignment = AlignMaps({MakeFrame(0), wrong, MakeFrame(1), MakeFrame(2)});
  ASSERT_TRUE(alignment.has_value());
  EXPECT_THAT(alignment->inliers, ElementsAre(true, false, true, true));
  EXPECT_LT(PositionError(*alignment), 0.004);
}

TEST_F(MapAlignmentTest, NeedsEnoughFramesThatAgree) {
  EXPECT_FALSE(AlignMaps({}).has_value());
  EXPECT_FALSE(AlignMaps({MakeFrame(0), MakeFrame(1)}).has_value());
  std::vector<FrameInTwoMaps> frames = {MakeFrame(0), MakeFrame(1), MakeFrame(2)};
  for (int i = 0; i < 3; ++i) {
    frames.push_back(MakeFrame(3 + i));
    frames.back().cam_from_b.translation().y() += 0.5 * (i + 1);
  }
  // Three of six are not more than half.
  EXPECT_FALSE(AlignMaps(frames).has_value());
}

}  // namespace
}  // namespace msc_vo
