// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/support/rendered_images.h"
#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/factors/rigid3_manifold.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

// The middle of a room of blank walls, floor and ceiling, from where walls, corner and floor are in
// view to where one wall is.
constexpr int kFirst = 31, kNumImages = 60;

SyntheticSequenceOptions BlankRoom() {
  SyntheticSequenceOptions options;
  options.scene = SceneKind::kBlank;
  return options;
}

std::vector<RgbdImage> ImagesOfBlankRoom() {
  std::vector<RgbdImage> images = RenderImages(BlankRoom(), kFirst + kNumImages);
  images.erase(images.begin(), images.begin() + kFirst);
  return images;
}

OdometryOptions WithoutPlanes() {
  OdometryOptions options;
  options.features.extract_planes = false;
  return options;
}

class PlanesTest : public ::testing::Test {
 protected:
  OdometryResult Track(const OdometryOptions& options) const {
    Odometry odometry(options, sequence_.camera(), LensDistortion());
    for (const RgbdImage& image : images_) odometry.Process(image);
    return odometry.Finish();
  }

  // Of the camera of image i, relative to the first.
  Rigid3 Error(const OdometryResult& result, int i) const {
    const Rigid3 truth = sequence_.PoseAt(kFirst + i).world_from_cam.Inverse() *
                         sequence_.PoseAt(kFirst).world_from_cam;
    const Rigid3 estimate =
        result.frames[i].cam_from_world * result.frames.front().cam_from_world.Inverse();
    return estimate * truth.Inverse();
  }

  const SyntheticSequence sequence_{BlankRoom()};
  const std::vector<RgbdImage> images_ = ImagesOfBlankRoom();
};

TEST_F(PlanesTest, HoldTheCameraWherePointsAndLinesDoNot) {
  const OdometryResult with = Track({}), without = Track(WithoutPlanes());
  int num_without = 0;
  for (int i = 0; i < kNumImages; ++i) {
    EXPECT_TRUE(IsEstimated(with.frames[i].status)) << "image " << i;
    num_without += IsEstimated(without.frames[i].status);
    const Rigid3 error = Error(with, i);
    EXPECT_LT(error.translation().norm(), 0.03) << "image " << i;
    EXPECT_LT(LogSO3(error.rotation()).norm(), 0.01) << "image " << i;
    // Honest: five sigmas of each coordinate.
    const Eigen::Vector3d sigma = with.frames[i].covariance->diagonal().tail<3>().cwiseSqrt();
    if (i == 0) continue;
    for (int k = 0; k < 3; ++k) {
      EXPECT_LT(std::abs(error.translation()[k]), 5.0 * sigma[k]) << "image " << i;
    }
  }
  EXPECT_LT(num_without, kNumImages / 2);
}

TEST_F(PlanesTest, AreInTheResultWithTheirExtents) {
  EXPECT_TRUE(Track(WithoutPlanes()).planes.empty());
  const OdometryResult result = Track({});
  ASSERT_GE(result.planes.size(), 3u);  // two walls and the floor
  int num_large = 0;
  std::ostringstream areas;
  for (const MapPlane& plane : result.planes) {
    EXPECT_GE(plane.extent.size(), 3u);
    EXPECT_GE(plane.num_observations, 1);
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (size_t i = 0; i < plane.extent.size(); ++i) {
      EXPECT_NEAR(plane.plane.normal().dot(plane.extent[i]) + plane.plane.offset(), 0.0, 1e-9);
      area += 0.5 * plane.extent[i].cross(plane.extent[(i + 1) % plane.extent.size()]);
    }
    EXPECT_GT(area.dot(plane.plane.normal()), 0.0) << "counter-clockwise from the front";
    areas << area.norm() << " ";
    num_large += area.norm() > 0.5;
  }
  EXPECT_GE(num_large, 3) << areas.str();
}

// Fitted to all keyframes, not as the last window left them.
TEST_F(PlanesTest, AreInTheResultAsInAMapFile) {
  Odometry odometry({}, sequence_.camera(), LensDistortion());
  for (const RgbdImage& image : images_) odometry.Process(image);
  const MapSnapshotPtr snapshot = odometry.Map();
  const std::optional<MapContents> maps = odometry.ShareMaps("run");
  const OdometryResult result = odometry.Finish();
  ASSERT_TRUE(maps && maps->submaps.size() == 1);
  const SavedSubMap& submap = maps->submaps[0];
  ASSERT_EQ(submap.planes.planes.size(), result.planes.size());
  double largest_change = 0.0;
  size_t i = 0;
  for (const auto& [id, hosted] : submap.planes.planes) {
    const Plane saved = submap.map.CamFromWorld(hosted.host).Inverse() * hosted.in_host;
    const Plane& plane = result.planes[i++].plane;
    EXPECT_LT((saved.params - plane.params).norm(), 1e-9);
    const PlaneLandmark& of_window = *snapshot->planes.Find(id);
    largest_change = std::max(largest_change, (of_window.plane.params - plane.params).norm());
  }
  EXPECT_GT(largest_change, 1e-5);
}

TEST_F(PlanesTest, GiveTheSamePosesAtAnyNumberOfThreadsAndAfterACheckpoint) {
  OdometryOptions one, two;
  one.threads = 1;
  two.threads = 2;
  const OdometryResult expected = Track(one), parallel = Track(two);
  Odometry resumed(one, sequence_.camera(), LensDistortion());
  {
    Odometry odometry(one, sequence_.camera(), LensDistortion());
    for (int i = 0; i < kNumImages / 2; ++i) odometry.Process(images_[i]);
    ObjectJournal journal;
    BinaryWriter writer(&journal);
    ASSERT_TRUE(odometry.Save(&writer));
    ObjectJournal loaded(journal.pending());
    BinaryReader reader(writer.bytes(), &loaded);
    resumed.Restore(&reader);
  }
  for (int i = kNumImages / 2; i < kNumImages; ++i) resumed.Process(images_[i]);
  const OdometryResult continued = resumed.Finish();
  for (int i = 0; i < kNumImages; ++i) {
    EXPECT_EQ(parallel.frames[i].cam_from_world.params, expected.frames[i].cam_from_world.params);
    EXPECT_EQ(continued.frames[i].cam_from_world.params, expected.frames[i].cam_from_world.params);
  }
}

// A blank wall comes before a poster: the images that show it begin at a pose that the wall left
// free, and are mapped there.
TEST(PosterTest, IsMappedWhereTheWallHasLeftTheCamera) {
  SyntheticSequenceOptions options;
  options.scene = SceneKind::kPoster;
  options.width = 320;
  options.height = 240;
  options.depth = SyntheticDepth::kStructuredLight;
  constexpr int kNumImages = 120;
  const SyntheticSequence sequence(options);
  Odometry odometry({}, sequence.camera(), LensDistortion());
  for (const RgbdImage& image : RenderImages(options, kNumImages)) odometry.Process(image);
  const OdometryResult result = odometry.Finish();
  const auto first = std::find_if(result.frames.begin(), result.frames.end(),
                                  [](const auto& frame) { return IsEstimated(frame.status); });
  ASSERT_NE(first, result.frames.end());
  int num_tracked = 0;
  for (auto frame = first; frame != result.frames.end(); ++frame) {
    if (!IsEstimated(frame->status) || frame == first) continue;
    num_tracked += frame->status == TrackingStatus::kTracked;
    const Rigid3 truth = sequence.PoseAt(static_cast<int>(frame->id)).world_from_cam.Inverse() *
                         sequence.PoseAt(static_cast<int>(first->id)).world_from_cam;
    const Rigid3 expected = truth * first->cam_from_world;
    Eigen::Matrix<double, 6, 1> error;
    Rigid3Manifold().Minus(frame->cam_from_world.params.data(), expected.params.data(),
                           error.data());
    constexpr double kMaxChiSquare = 16.81;  // 99 % quantile with six degrees of freedom
    EXPECT_LT(error.dot(frame->world_covariance->ldlt().solve(error)), kMaxChiSquare)
        << "image " << frame->id;
  }
  EXPECT_GE(num_tracked, 0.8 * static_cast<double>(result.frames.end() - first));
}

// The depth camera has its own light.
class DarkImagesTest : public RoomTest {
 protected:
  static OdometryResult RunInTheDark(const OdometryOptions& options) {
    std::vector<RgbdImage> images = *images_;
    for (int i = kFirstDark; i < kFirstBright; ++i) Blacken(&images[i]);
    Odometry odometry(options, camera_, LensDistortion());
    for (const RgbdImage& image : images) odometry.Process(image);
    return odometry.Finish();
  }
  static int NumEstimatedInTheDark(const OdometryResult& result) {
    int count = 0;
    for (int i = kFirstDark; i < kFirstBright; ++i) count += IsEstimated(result.frames[i].status);
    return count;
  }

  static constexpr int kFirstDark = 20, kFirstBright = 50;
};

TEST_F(DarkImagesTest, HaveThePoseOfTheirPlanes) {
  const OdometryResult with = RunInTheDark({}), without = RunInTheDark(WithoutPlanes());
  EXPECT_EQ(NumEstimatedInTheDark(without), 0);
  EXPECT_GE(NumEstimatedInTheDark(with), 25);
  EXPECT_LT(ApeRmse(with), 0.005);
}

}  // namespace
}  // namespace msc_vo
