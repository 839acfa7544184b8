// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/mapping/window_observer.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/odometry_options.h"
#include "msc_vo/sensor/rgbd_image.h"
#include "msc_vo/structure/axes_estimator.h"

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
  std::optional<int> axis;  // Manhattan axis 0, 1, 2 that it is parallel to
  // Unit vector, mean of the directions from the cameras that saw it to the line, world.
  Eigen::Vector3d viewing_direction = Eigen::Vector3d::Zero();
};

// The Manhattan axes of the scene.
struct MapAxes {
  AxesState state = AxesState::kNone;
  bool frozen = false;  // known well enough to stay
  int num_refinements = 0;
  Eigen::Quaterniond world_from_axes = Eigen::Quaterniond::Identity();  // unless kNone
  double sigma = 0.0;                                                   // radians
};

// Everything that a run leaves behind.
struct OdometryResult {
  std::vector<FrameResult> frames;   // one per image, in order, with the final poses
  std::vector<TimedPose> keyframes;  // in order of time
  std::vector<MapPoint> points;
  std::vector<MapLine> lines;
  MapAxes axes;
  NoiseScale noise_scale;     // of the sigmas of features, as learnt
  double readout_time = 0.0;  // of a rolling shutter, seconds, as known or learnt; 0: global
  BundleAdjustmentSummary last_window;
  int num_late_maps = 0;  // in real time: maps that came later than they should be seen
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

  // Is shown every window before it is solved, on the mapper's thread if it has one; to be set
  // before the first image.
  void SetWindowObserver(WindowObserver observer);

  // Tracks one image and returns what is known of it now. Poses get better until Finish().
  // Throws std::invalid_argument if the image does not fit the camera or time runs backwards, and
  // what a keyframe step of an earlier frame threw; the next call goes on without that step.
  FrameResult Process(const RgbdImage& image);

  // Records a frame without an image: one that came too late to be looked at (kDropped), or that
  // could not be read (kUnreadable). It gets the pose of the frame before, and in the result of
  // Finish() the one on the way between its neighbours. Throws std::invalid_argument if time runs
  // backwards or on another status.
  FrameResult Drop(int64_t id, double timestamp, TrackingStatus status = TrackingStatus::kDropped);

  // Waits for the mapper and returns the trajectory re-expressed in the final keyframe poses. May
  // be called at any time, also after an interruption. Throws what a keyframe step threw if
  // Process() did not yet; then it may be called again.
  OdometryResult Finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace msc_vo
