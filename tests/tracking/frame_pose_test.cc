// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/frame_pose.h"

#include <cmath>
#include <random>

#include "tests/support/synthetic_frames.h"
#include "tests/support/synthetic_map.h"
#include <Eigen/LU>
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

PointFeature PointAt(const PinholeCamera& camera, const Eigen::Vector3d& in_cam) {
  PointFeature point;
  point.pixel = camera.Project(in_cam);
  point.inverse_depth = 1.0 / in_cam.z();
  point.inverse_depth_sigma = 1.425e-3;
  return point;
}

LineFeature LineAt(const PinholeCamera& camera, const LineSegment3& in_cam) {
  LineFeature line;
  line.segment = {camera.Project(in_cam.start), camera.Project(in_cam.end)};
  line.depth = LineDepth();
  line.depth->start = 1.0 / in_cam.start.z();
  line.depth->end = 1.0 / in_cam.end.z();
  return line;
}

// A last frame with two points and two lines; the first of each is matched with a landmark. World
// and camera of the last frame are 0.1 m apart.
class CandidatesFromFrameTest : public ::testing::Test {
 protected:
  CandidatesFromFrameTest() {
    Frame frame;
    frame.points = {PointAt(frame.camera, points_[0]), PointAt(frame.camera, points_[1])};
    frame.lines = {LineAt(frame.camera, lines_[0]), LineAt(frame.camera, lines_[1])};
    frame.points[0].descriptor.fill(0x11);
    frame.points[0].level = 3;
    frame.lines[1].descriptor.fill(0x22);
    SetFrame(frame);
    auto keyframe = std::make_shared<Frame>();
    keyframe->points.resize(1);
    keyframe->lines.resize(1);
    last_.reference = map_.AddKeyframe(keyframe, Rigid3());
    point_ = map_.Add<PointLandmark>(last_.reference, 0, landmark_);
    line_ = map_.Add<LineLandmark>(last_.reference, 0, landmark_line_);
    last_.cam_from_reference = last_from_world_;
    last_.matches.points = {{0, point_, Eigen::Vector3d::Zero(), true}};
    last_.matches.lines = {{0, line_, LineSegment3(), true}};
  }

  void SetFrame(const Frame& frame) { last_.frame = std::make_shared<Frame>(frame); }
  LocalMap Candidates(const Rigid3& cam_from_world = Rigid3()) const {
    return CandidatesFromFrame(map_, last_, cam_from_world);
  }

  const Eigen::Vector3d points_[2] = {{0.1, 0.0, 2.0}, {0.3, 0.1, 3.0}};  // metres, last camera
  const LineSegment3 lines_[2] = {{{0.0, -0.4, 2.0}, {0.0, 0.4, 2.0}},
                                  {{0.5, -0.4, 2.5}, {0.5, 0.4, 2.5}}};
  const Eigen::Vector3d landmark_{0.05, 0.02, 2.2};  // metres, world
  const LineSegment3 landmark_line_{{0.1, -0.4, 2.1}, {0.1, 0.4, 2.1}};
  const Rigid3 last_from_world_{Eigen::Quaterniond::Identity(), {0.1, 0.0, 0.0}};
  Map map_;
  LastFrame last_;
  LandmarkId point_ = kNoId, line_ = kNoId;
};

TEST_F(CandidatesFromFrameTest, UsesThePresentPositionsOfLandmarks) {
  const LocalMap candidates = Candidates();
  EXPECT_EQ(candidates.reference, last_.reference);
  ASSERT_THAT(candidates.points, SizeIs(2));
  EXPECT_EQ(candidates.points[0].id, point_);
  EXPECT_EQ(candidates.points[0].position, landmark_);
  EXPECT_TRUE(candidates.points[0].pixel.isApprox(last_.frame->camera.Project(landmark_)));
  ASSERT_THAT(candidates.lines, SizeIs(2));
  EXPECT_EQ(candidates.lines[0].id, line_);
  EXPECT_EQ(candidates.lines[0].segment.start, landmark_line_.start);
}

TEST_F(CandidatesFromFrameTest, UsesTheMeasuredPositionsOfOtherFeatures) {
  const LocalMap candidates = Candidates();
  const Rigid3 world_from_last = last_from_world_.Inverse();
  ASSERT_THAT(candidates.points, SizeIs(2));
  EXPECT_EQ(candidates.points[1].id, kNoId);
  EXPECT_TRUE(candidates.points[1].position.isApprox(world_from_last * points_[1], 1e-9));
  ASSERT_THAT(candidates.lines, SizeIs(2));
  EXPECT_EQ(candidates.lines[1].id, kNoId);
  EXPECT_TRUE(candidates.lines[1].segment.start.isApprox(world_from_last * lines_[1].start, 1e-9));
}

TEST_F(CandidatesFromFrameTest, UsesDescriptorsAndLevelsOfTheFrame) {
  const LocalMap candidates = Candidates();
  ASSERT_THAT(candidates.points, SizeIs(2));
  EXPECT_EQ(candidates.points[0].descriptor, last_.frame->points[0].descriptor);
  EXPECT_EQ(candidates.points[0].level, 3);
  ASSERT_THAT(candidates.lines, SizeIs(2));
  EXPECT_EQ(candidates.lines[1].descriptor, last_.frame->lines[1].descriptor);
}

TEST_F(CandidatesFromFrameTest, RequiresALandmarkOrADepth) {
  Frame frame = *last_.frame;
  for (PointFeature& point : frame.points) point.inverse_depth = 0.0;
  for (LineFeature& line : frame.lines) line.depth.reset();
  SetFrame(frame);
  const LocalMap candidates = Candidates();
  ASSERT_THAT(candidates.points, SizeIs(1));
  EXPECT_EQ(candidates.points[0].id, point_);
  ASSERT_THAT(candidates.lines, SizeIs(1));
  EXPECT_EQ(candidates.lines[0].id, line_);
}

TEST_F(CandidatesFromFrameTest, FallsBackToTheMeasurementOfARemovedLandmark) {
  map_.Remove<PointLandmark>(point_);
  map_.Remove<LineLandmark>(line_);
  const LocalMap candidates = Candidates();
  ASSERT_THAT(candidates.points, SizeIs(2));
  EXPECT_EQ(candidates.points[0].id, kNoId);
  EXPECT_TRUE(candidates.points[0].position.isApprox(last_from_world_.Inverse() * points_[0]));
  ASSERT_THAT(candidates.lines, SizeIs(2));
  EXPECT_EQ(candidates.lines[0].id, kNoId);
}

TEST_F(CandidatesFromFrameTest, ExcludesCandidatesOutsideTheNewImage) {
  const LocalMap candidates = Candidates({Eigen::Quaterniond::Identity(), {5.0, 0.0, 0.0}});
  EXPECT_THAT(candidates.points, IsEmpty());
  EXPECT_THAT(candidates.lines, IsEmpty());
}

// Two point features and two line features with equal descriptors, 100 pixels apart.
class MatchLocalMapTest : public ::testing::Test {
 protected:
  MatchLocalMapTest() {
    frame_.points.resize(2);
    frame_.lines.resize(2);
    for (int i = 0; i < 2; ++i) {
      frame_.points[i].pixel = Pixel(i);
      frame_.lines[i].segment = Segment(i);
    }
    frame_.grid = FeatureGrid(frame_.camera, frame_.points);
  }

  static Eigen::Vector2d Pixel(int place) { return {100.0 + 100.0 * place, 100.0}; }
  static LineSegment2 Segment(int place) {
    return {{100.0 + 100.0 * place, 200.0}, {100.0 + 100.0 * place, 300.0}};
  }
  // Adds a point and a line candidate where feature `place` is.
  void AddCandidates(LandmarkId id, int place) {
    PointCandidate point;
    point.id = id;
    point.pixel = Pixel(place);
    local_.points.push_back(point);
    LineCandidate line;
    line.id = id;
    line.image = Segment(place);
    local_.lines.push_back(line);
  }
  // Known matches of point feature and line feature `feature` with landmark `id`.
  static FrameMatches Known(int feature, LandmarkId id) {
    FrameMatches known;
    known.points.push_back({feature, id, Eigen::Vector3d::Zero(), true});
    known.lines.push_back({feature, id, LineSegment3(), true});
    return known;
  }
  // Expects the known match of feature 0 with landmark `known`, and one more: feature 1 with
  // landmark `id`; kNone: no other match.
  static constexpr LandmarkId kNone = -2;
  void ExpectMatches(const FrameMatches& matches, LandmarkId known, LandmarkId id) const {
    const size_t expected = id == kNone ? 1 : 2;
    ASSERT_THAT(matches.points, SizeIs(expected));
    ASSERT_THAT(matches.lines, SizeIs(expected));
    EXPECT_EQ(matches.points[0].feature, 0);
    EXPECT_EQ(matches.points[0].id, known);
    EXPECT_EQ(matches.lines[0].feature, 0);
    EXPECT_EQ(matches.lines[0].id, known);
    if (id == kNone) return;
    EXPECT_EQ(matches.points[1].feature, 1);
    EXPECT_EQ(matches.points[1].id, id);
    EXPECT_EQ(matches.lines[1].feature, 1);
    EXPECT_EQ(matches.lines[1].id, id);
  }
  FrameMatches Match(const FrameMatches& known, double radius = 4.0) const {
    return MatchLocalMap(TrackerOptions(), frame_, local_, radius, known);
  }

  Frame frame_;
  LocalMap local_;
};

TEST_F(MatchLocalMapTest, AddsNewMatchesToTheKnownOnes) {
  AddCandidates(7, 0);
  AddCandidates(8, 1);
  ExpectMatches(Match(Known(0, 7)), 7, 8);
}

TEST_F(MatchLocalMapTest, ExcludesKnownLandmarks) {
  AddCandidates(7, 1);
  ExpectMatches(Match(Known(0, 7)), 7, kNone);
}

TEST_F(MatchLocalMapTest, ExcludesFeaturesOfKnownMatches) {
  AddCandidates(8, 0);
  ExpectMatches(Match(Known(0, 7)), 7, kNone);
}

TEST_F(MatchLocalMapTest, MatchesSeveralCandidatesWithoutLandmark) {
  AddCandidates(kNoId, 1);
  ExpectMatches(Match(Known(0, kNoId)), kNoId, kNoId);
}

TEST_F(MatchLocalMapTest, SearchesWithinTheRadius) {
  AddCandidates(8, 1);
  local_.points[0].pixel.x() += 5.0;
  local_.lines[0].image.start.x() += 5.0;
  local_.lines[0].image.end.x() += 5.0;
  ExpectMatches(Match(Known(0, 7), 4.0), 7, kNone);
  ExpectMatches(Match(Known(0, 7), 6.0), 7, 8);
}

TEST(LandmarkInliers, KeepsInliersWithLandmarks) {
  FrameMatches matches;
  const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  matches.points = {{0, 5, origin, true}, {1, 6, origin, false}, {2, kNoId, origin, true}};
  matches.lines = {{0, kNoId, LineSegment3(), true},
                   {1, 7, LineSegment3(), false},
                   {2, 8, LineSegment3(), true}};
  const FrameMatches inliers = LandmarkInliers(matches);
  ASSERT_THAT(inliers.points, SizeIs(1));
  EXPECT_EQ(inliers.points[0].id, 5);
  ASSERT_THAT(inliers.lines, SizeIs(1));
  EXPECT_EQ(inliers.lines[0].id, 8);
  EXPECT_EQ(inliers.lines[0].feature, 2);
}

// The exact frame 0 matched with its own map; the true pose is the identity.
class EstimateFramePoseTest : public ::testing::Test {
 protected:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  EstimateFramePoseTest() {
    SyntheticFrames::Options options;
    options.pixel_noise = 0.0;
    options.inverse_depth_noise = 0.0;
    frame_ = SyntheticFrames(options).MakeFrame(0);
    map_ = MapOfOneKeyframe(frame_, Rigid3()).map;
    const Keyframe& keyframe = map_.keyframes().front().second;
    for (size_t i = 0; i < keyframe.landmarks.points.size(); ++i) {
      const LandmarkId id = keyframe.landmarks.points[i];
      matches_.points.push_back(
          {static_cast<int>(i), id, map_.Find<PointLandmark>(id)->position, true});
    }
    for (size_t i = 0; i < keyframe.landmarks.lines.size(); ++i) {
      const LandmarkId id = keyframe.landmarks.lines[i];
      matches_.lines.push_back(
          {static_cast<int>(i), id, map_.Find<LineLandmark>(id)->segment, true});
    }
  }

  // Estimates the pose from a prediction with an error of a centimetre.
  PoseSummary Estimate(const NoiseScale& scale = {}) {
    pose_ = Rigid3(Eigen::Quaterniond::Identity(), {0.01, -0.005, 0.01});
    const PoseSummary summary =
        EstimateFramePose(PoseOptions(), *frame_, map_, scale, {}, &pose_, &matches_);
    EXPECT_TRUE(summary.usable);
    return summary;
  }
  // Inverse of the covariance of the pose.
  Matrix6 Information(const NoiseScale& scale = {}) { return Estimate(scale).covariance.inverse(); }

  std::shared_ptr<const Frame> frame_;
  Map map_;
  FrameMatches matches_;
  Rigid3 pose_;
};

TEST_F(EstimateFramePoseTest, RecoversThePoseAndMarksOutliers) {
  matches_.points[3].position.x() += 0.5;
  matches_.lines[2].segment.start.y() += 0.4;
  matches_.lines[2].segment.end.y() += 0.3;
  const PoseSummary summary = Estimate();
  EXPECT_LT(PositionError(pose_, Rigid3()), 1e-5);
  for (size_t i = 0; i < matches_.points.size(); ++i) {
    EXPECT_EQ(matches_.points[i].inlier, i != 3) << i;
  }
  for (size_t i = 0; i < matches_.lines.size(); ++i) {
    EXPECT_EQ(matches_.lines[i].inlier, i != 2) << i;
  }
  EXPECT_EQ(summary.num_inliers.points, static_cast<int>(matches_.points.size()) - 1);
}

// The information is a sum of terms, each of which is divided by the square of its scale. A very
// large scale removes a term.
TEST_F(EstimateFramePoseTest, MultipliesSigmasByTheNoiseScale) {
  for (double NoiseScale::*member :
       {&NoiseScale::point_depth, &NoiseScale::line_pixel, &NoiseScale::line_depth}) {
    const auto with_scale = [&](double value) {
      NoiseScale scale;
      scale.*member = value;
      return Information(scale);
    };
    const Matrix6 other_terms = with_scale(1e4);
    const Matrix6 term = with_scale(1.0) - other_terms;
    EXPECT_GT(term.norm(), 1e-3 * other_terms.norm());
    EXPECT_LT((4.0 * (with_scale(2.0) - other_terms) - term).norm(), 1e-3 * term.norm());
  }
}

TEST_F(EstimateFramePoseTest, MultipliesSigmasByTheNoiseOfTheLandmark) {
  const Matrix6 nominal = Information();
  for (const auto& match : matches_.points) map_.SetNoise<PointLandmark>(match.id, 2.0);
  const Matrix6 noisy_points = Information();
  EXPECT_LT(noisy_points.trace(), 0.9 * nominal.trace());
  for (const auto& match : matches_.lines) map_.SetNoise<LineLandmark>(match.id, 2.0);
  const Matrix6 noisy = Information();
  EXPECT_LT(noisy.trace(), noisy_points.trace());
  EXPECT_LT((4.0 * noisy - nominal).norm(), 1e-3 * nominal.norm());
  // Matches without landmark have their nominal sigmas.
  for (auto& match : matches_.points) match.id = kNoId;
  for (auto& match : matches_.lines) match.id = kNoId;
  EXPECT_LT((Information() - nominal).norm(), 1e-3 * nominal.norm());
}

TEST_F(EstimateFramePoseTest, CorrectsTheDepthOffsetOfLines) {
  constexpr double kOffset = 0.02;  // metres, measured too far
  auto frame = std::make_shared<Frame>(*frame_);
  for (LineFeature& line : frame->lines) line.depth = Nearer(*line.depth, -kOffset);
  frame_ = frame;
  matches_.points.clear();
  Estimate();
  EXPECT_GT(PositionError(pose_, Rigid3()), 3e-3);
  for (const auto& match : matches_.lines) map_.SetDepthOffset(match.id, kOffset);
  Estimate();
  EXPECT_LT(PositionError(pose_, Rigid3()), 3e-4);
}

// A board at one metre covers the left half of the image and has moved by 3 cm; the static room
// covers the right half. Two keyframes confirm the room.
class ConfirmedLandmarksTest : public ::testing::Test {
 protected:
  static constexpr int kPerHalf = 400;

  // Error of the estimated position (metres); the true pose is the identity.
  static double EstimateError(bool is_board_confirmed) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * (random() / 4294967296.0);
    };
    Frame frame;
    std::vector<Eigen::Vector3d> landmarks;
    for (int i = 0; i < 2 * kPerHalf; ++i) {
      const bool is_board = i < kPerHalf;
      const Eigen::Vector2d pixel(is_board ? uniform(0.0, 340.0) : uniform(340.0, 639.0),
                                  uniform(0.0, 479.0));
      const Eigen::Vector3d in_cam =
          frame.camera.BackProject(pixel, is_board ? 1.0 : uniform(2.0, 5.0));
      frame.points.push_back(PointAt(frame.camera, in_cam));
      frame.points.back().pixel += 0.7 * Eigen::Vector2d{normal(random), normal(random)};
      landmarks.push_back(in_cam - Eigen::Vector3d(is_board ? 0.03 : 0.0, 0.0, 0.0));
    }
    Map map;
    const KeyframeId first = map.AddKeyframe(std::make_shared<Frame>(frame), Rigid3());
    const KeyframeId second = map.AddKeyframe(std::make_shared<Frame>(frame), Rigid3());
    FrameMatches matches;
    for (int i = 0; i < 2 * kPerHalf; ++i) {
      const LandmarkId id = map.Add<PointLandmark>(first, i, landmarks[i]);
      if (i >= kPerHalf || is_board_confirmed) map.Observe<PointLandmark>(id, second, i);
      matches.points.push_back({i, id, landmarks[i], true});
    }
    Rigid3 pose(Eigen::Quaterniond::Identity(), {4e-3, -2e-3, 3e-3});
    EstimateFramePose(PoseOptions(), frame, map, NoiseScale(), {}, &pose, &matches);
    return PositionError(pose, Rigid3());
  }
};

TEST_F(ConfirmedLandmarksTest, NeedTwoObservationsToOutvoteTheRoom) {
  EXPECT_LT(EstimateError(false), 0.01);
  EXPECT_GT(EstimateError(true), 0.02);
}

}  // namespace
}  // namespace msc_vo
