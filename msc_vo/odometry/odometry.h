// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "msc_vo/features/rgbd_image.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/odometry_options.h"

namespace msc_vo {

// A landmark as the result tells it.
struct MapPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // metres, world
  int num_observations = 0;
};

struct MapLine {
  LineSegment3 segment;  // metres, world
  int num_observations = 0;
  bool in_last_window = false;
};

// Everything that a run leaves behind.
struct OdometryResult {
  std::vector<FrameResult> frames;   // one per image, in order, with the final poses
  std::vector<TimedPose> keyframes;  // in order of time
  std::vector<MapPoint> points;
  std::vector<MapLine> lines;
};

// RGB-D visual odometry from points and lines (paper: PL-VO and MSC-VO).
//
//   Odometry odometry(options, camera, distortion);
//   while (source.Next(&image)) odometry.Process(image);
//   OdometryResult result = odometry.Finish();
//
// World is the camera of the first tracked frame. The same images give the same bytes at every run.
class Odometry {
 public:
  // Throws std::invalid_argument on options or a camera that are not valid.
  Odometry(const OdometryOptions& options, const PinholeCamera& camera,
           const LensDistortion& distortion);
  ~Odometry();

  // Tracks one image and returns what is known of it now. Poses get better until Finish().
  // Throws std::invalid_argument if the image does not fit the camera or time runs backwards.
  FrameResult Process(const RgbdImage& image);

  // Waits for the mapper and returns the trajectory re-expressed in the final keyframe poses. May
  // be called at any time, also after an interruption.
  OdometryResult Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace msc_vo
