// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include <opencv2/core.hpp>

#include "msc_vo/odometry/tracking_observer.h"

namespace msc_vo {

// A frame with two points (the second without depth), a line along the x axis of the world, one in
// another direction, and one without depth, all matched with a map of that frame whose Manhattan
// axes are those of the world.
struct TrackedScene {
  TrackedScene() {
    image.gray = cv::Mat(480, 640, CV_8UC1, cv::Scalar(128));
    Frame frame;
    frame.points.resize(2);
    frame.points[0].pixel = {100.0, 50.0};
    frame.points[0].inverse_depth = 0.5;
    frame.points[1].pixel = {200.0, 60.0};
    AddLine({{100.0, 200.0}, {300.0, 200.0}}, {Eigen::Vector3d(-1, 0, 2), Eigen::Vector3d(0, 0, 2)},
            true, &frame);
    AddLine({{100.0, 300.0}, {300.0, 350.0}}, {Eigen::Vector3d(-1, 0, 2), Eigen::Vector3d(0, 1, 2)},
            true, &frame);
    AddLine({{400.0, 100.0}, {400.0, 400.0}}, {Eigen::Vector3d(1, 0, 2), Eigen::Vector3d(1, 1, 2)},
            false, &frame);
    tracked.frame = std::make_shared<Frame>(frame);
    const KeyframeId keyframe = map.map.AddKeyframe(tracked.frame, Rigid3());
    const LandmarkId point =
        map.map.Add<PointLandmark>(keyframe, 0, tracked.frame->PointInCamera(0));
    tracked.matches.points = {{0, point, Eigen::Vector3d::Zero()},
                              {1, kNoId, Eigen::Vector3d::Zero()}};
    for (int i = 0; i < 3; ++i) {
      tracked.matches.lines.push_back(
          {i, map.map.Add<LineLandmark>(keyframe, i, segments[i]), segments[i]});
    }
    map.newest_keyframe = keyframe;
    map.axes = AxesEstimate{Eigen::Quaterniond::Identity(), 0.001};
  }

  void AddLine(const LineSegment2& image_segment, const LineSegment3& segment, bool has_depth,
               Frame* frame) {
    LineFeature line;
    line.segment = image_segment;
    if (has_depth) {
      LineDepth depth;
      depth.start = 1.0 / segment.start.z();
      depth.end = 1.0 / segment.end.z();
      depth.covariance = 1e-8 * Eigen::Matrix2d::Identity();
      line.depth = depth;
    }
    frame->lines.push_back(line);
    segments.push_back(segment);
  }

  TrackedImage View() const { return {image, *tracked.frame, tracked, map, result, loops}; }

  RgbdImage image;
  TrackedFrame tracked;
  MapSnapshot map;
  FrameResult result;
  std::vector<Loop> loops;
  std::vector<LineSegment3> segments;
};

}  // namespace msc_vo
