// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/false_depths.h"

#include <memory>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "msc_vo/map/window_selection.h"

namespace msc_vo {
namespace {

constexpr int kNumViews = 6;        // keyframes
constexpr double kBaseline = 0.08;  // metres from keyframe to keyframe
constexpr double kDistance = 3.0;   // metres, of the wall that all keyframes face
constexpr double kPixelSigma = 0.3;
constexpr double kDepthSigma = 0.003;  // 1/metres
constexpr KeyframeId kNewest = kNumViews - 1;

// A wall of points and lines, part of it behind a pane.
class FalseDepthsTest : public testing::Test {
 protected:
  // Landmarks begin where they are measured. `measured_over_true`: ratio of the depth that is
  // measured at a pixel of the newest keyframe to that of what it shows.
  template <typename Ratio>
  void Build(const Ratio& measured_over_true, double scale_of_motion = 1.0) {
    std::vector<Eigen::Vector3d> points;
    std::vector<LineSegment3> lines;
    for (double x = -1.5; x < 1.9; x += 0.12) {
      for (double y = -1.2; y < 1.2; y += 0.12) points.push_back({x, y, kDistance});
      lines.push_back({{x, -1.0, kDistance}, {x, -0.6, kDistance}});
    }
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < kNumViews; ++i) {
      auto frame = std::make_shared<Frame>();
      frame->camera = camera_;
      const Rigid3 pose = Pose(i, 1.0);
      for (const Eigen::Vector3d& point : points) {
        const Eigen::Vector3d in_cam = pose * point;
        PointFeature feature;
        feature.pixel =
            camera_.Project(in_cam) + kPixelSigma * Eigen::Vector2d(normal(random), normal(random));
        feature.sigma = kPixelSigma;
        feature.inverse_depth =
            1.0 / (measured_over_true(InNewest(point)) * in_cam.z()) + kDepthSigma * normal(random);
        feature.inverse_depth_sigma = kDepthSigma;
        frame->points.push_back(feature);
      }
      for (const LineSegment3& line : lines) {
        LineFeature feature;
        feature.segment = {camera_.Project(pose * line.start), camera_.Project(pose * line.end)};
        feature.sigma = kPixelSigma;
        LineDepth depth;
        depth.start = depth.end = 1.0 / (measured_over_true(InNewest(line.Midpoint())) * kDistance);
        depth.covariance = kDepthSigma * kDepthSigma * Eigen::Matrix2d::Identity();
        feature.depth = depth;
        frame->lines.push_back(feature);
      }
      map_.AddKeyframe(frame, Pose(i, scale_of_motion));
    }
    for (size_t i = 0; i < points.size(); ++i) {
      Add<PointLandmark>(i, measured_over_true(InNewest(points[i])) * points[i]);
    }
    for (size_t i = 0; i < lines.size(); ++i) {
      const double ratio = measured_over_true(InNewest(lines[i].Midpoint()));
      Add<LineLandmark>(i, {ratio * lines[i].start, ratio * lines[i].end});
    }
  }

  void Find() {
    WindowSelectionOptions options;
    FindFalseDepths(SelectWindow(options, map_, kNewest, WindowLinks::kLandmarks), kNewest, {},
                    &map_);
  }

  Eigen::Vector2d InNewest(const Eigen::Vector3d& point) const {
    return camera_.Project(Pose(kNewest, 1.0) * point);
  }
  template <typename L>
  int NumFalse() const {
    int count = 0;
    for (const auto& [id, landmark] : map_.landmarks<L>()) count += landmark.has_false_depth;
    return count;
  }

  // Expects flags where `is_false` holds for the pixel in the newest keyframe, and no others.
  // Pixels near the border of that region are skipped: their landmarks may project into the next
  // cell.
  template <typename L, typename IsFalse>
  void ExpectFalse(const IsFalse& is_false) const {
    constexpr double kBorder = 8.0;
    const Keyframe& newest = *map_.FindKeyframe(kNewest);
    const auto& slots = SlotsOf<L>(newest);
    for (size_t i = 0; i < slots.size(); ++i) {
      const Eigen::Vector2d pixel = FeaturesOf<L>(*newest.frame)[i].Center();
      bool is_at_border = false;
      for (const double x : {-kBorder, kBorder}) {
        for (const double y : {-kBorder, kBorder}) {
          is_at_border |= is_false(pixel + Eigen::Vector2d(x, y)) != is_false(pixel);
        }
      }
      if (is_at_border) continue;
      EXPECT_EQ(map_.Find<L>(slots[i])->has_false_depth, is_false(pixel)) << pixel.transpose();
    }
  }

  void ExpectNoFlags() const {
    EXPECT_EQ(NumFalse<PointLandmark>(), 0);
    EXPECT_EQ(NumFalse<LineLandmark>(), 0);
  }

  PinholeCamera camera_{525.0, 525.0, 319.5, 239.5, 640, 480};
  Map map_;

 private:
  static Rigid3 Pose(int i, double scale) {
    return Rigid3(Eigen::Quaterniond::Identity(), {-scale * kBaseline * i, 0.0, 0.0});
  }
  template <typename L>
  void Add(size_t feature, const typename L::Geometry& geometry) {
    const LandmarkId id = map_.Add<L>(0, static_cast<int>(feature), geometry);
    for (int i = 1; i < kNumViews; ++i) map_.Observe<L>(id, i, static_cast<int>(feature));
  }
};

// The right upper part of the image, as a pane in front of what it shows.
bool IsBehindPane(const Eigen::Vector2d& pixel) { return pixel.x() > 426.7 && pixel.y() < 240.0; }

TEST_F(FalseDepthsTest, FlagsLandmarksBehindPane) {
  Build([](const Eigen::Vector2d& pixel) { return IsBehindPane(pixel) ? 0.95 : 1.0; });
  Find();
  ExpectFalse<PointLandmark>(IsBehindPane);
  ExpectFalse<LineLandmark>(IsBehindPane);
  EXPECT_GT(NumFalse<PointLandmark>(), 50);
  EXPECT_GT(NumFalse<LineLandmark>(), 3);
}

// With two fifths of the depths too near, the motion of a window is too short: the excess of true
// depths is as far below the mean as that of false ones is above it.
TEST_F(FalseDepthsTest, FlagsLandmarksBehindPaneThatShortensTheMotion) {
  const auto is_behind_pane = [](const Eigen::Vector2d& pixel) { return pixel.x() > 426.7; };
  Build([&](const Eigen::Vector2d& pixel) { return is_behind_pane(pixel) ? 0.95 : 1.0; }, 0.98);
  Find();
  ExpectFalse<PointLandmark>(is_behind_pane);
  ExpectFalse<LineLandmark>(is_behind_pane);
}

TEST_F(FalseDepthsTest, FlagsSingleLandmark) {
  const Eigen::Vector2d place(140.0, 240.0);
  Build(
      [place](const Eigen::Vector2d& pixel) { return (pixel - place).norm() < 12.0 ? 0.85 : 1.0; });
  Find();
  EXPECT_EQ(NumFalse<PointLandmark>(), 1);
  EXPECT_EQ(NumFalse<LineLandmark>(), 0);
}

TEST_F(FalseDepthsTest, AcceptsAWrongLengthOfTheMotion) {
  Build([](const Eigen::Vector2d&) { return 1.0; }, 1.05);
  Find();
  ExpectNoFlags();
}

// The measured surface cannot be farther than the visible one.
TEST_F(FalseDepthsTest, AcceptsDepthsThatAreTooFar) {
  Build([](const Eigen::Vector2d& pixel) { return IsBehindPane(pixel) ? 1.05 : 1.0; });
  Find();
  ExpectNoFlags();
}

TEST_F(FalseDepthsTest, ClearsUnsupportedFlag) {
  Build([](const Eigen::Vector2d&) { return 1.0; });
  map_.SetHasFalseDepth<PointLandmark>(map_.points().begin()->first + 200, true);
  map_.SetHasFalseDepth<LineLandmark>(map_.lines().begin()->first + 10, true);
  Find();
  ExpectNoFlags();
}

TEST_F(FalseDepthsTest, ClearsFlagWithoutParallax) {
  Build([](const Eigen::Vector2d& pixel) { return IsBehindPane(pixel) ? 0.95 : 1.0; });
  Find();
  LandmarkId flagged = kNoId;
  for (const auto& [id, point] : map_.points()) {
    if (point.has_false_depth) flagged = id;
  }
  for (int i = 0; i < kNumViews - 1; ++i) {
    EXPECT_TRUE(map_.Find<PointLandmark>(flagged)->has_false_depth);
    map_.RemoveObservation<PointLandmark>(flagged, i);
  }
  EXPECT_FALSE(map_.Find<PointLandmark>(flagged)->has_false_depth);
}

TEST_F(FalseDepthsTest, LeavesOnlyThePixelsToWindows) {
  Build([](const Eigen::Vector2d&) { return 1.0; });
  const LandmarkId point = map_.points().begin()->first, line = map_.lines().begin()->first;
  map_.SetHasFalseDepth<PointLandmark>(point, true);
  map_.SetHasFalseDepth<LineLandmark>(line, true);
  const WindowData window = SelectWindow({}, map_, kNewest, WindowLinks::kLandmarks);
  for (const WindowData::PointObservation& o : window.point_observations) {
    EXPECT_EQ(o.inverse_depth > 0.0, o.point != point);
  }
  for (const WindowData::LineObservation& o : window.line_observations) {
    EXPECT_EQ(o.has_depth, o.line != line);
  }
}

}  // namespace
}  // namespace msc_vo
