// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/bundle_adjustment/custom_factor.h"
#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/plane.h"
#include "msc_vo/geometry/plane_extent.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/map/map_contents.h"
#include "msc_vo/map/noise_scale.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/mapping/window_factors.h"
#include "msc_vo/mapping/window_observer.h"
#include "msc_vo/odometry/frame_result.h"
#include "msc_vo/odometry/loop_log.h"
#include "msc_vo/odometry/odometry_options.h"
#include "msc_vo/odometry/segment_log.h"
#include "msc_vo/odometry/tracking_observer.h"
#include "msc_vo/self_calibration/calibration_evidence.h"
#include "msc_vo/sensor/depth_camera.h"
#include "msc_vo/sensor/rgbd_image.h"
#include "msc_vo/structure/axes_estimator.h"
#include "msc_vo/tracking/pose_factor_callback.h"

namespace msc_vo {

class BinaryReader;
class BinaryWriter;

/// A point landmark of the final map.
struct MapPoint {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< metres, world
  int num_observations = 0;
};

/// A line landmark of the final map.
struct MapLine {
  LineSegment3 segment;  ///< metres, world
  int num_observations = 0;
  bool in_last_window = false;  ///< part of the last local bundle adjustment
  std::optional<int> axis;      ///< index 0..2 of the Manhattan axis that it is parallel to
  /// Mean direction from the cameras that observe the line to the line: unit vector, world.
  Eigen::Vector3d viewing_direction = Eigen::Vector3d::Zero();
};

/// A plane landmark of the final map.
struct MapPlane {
  Plane plane;               ///< world
  PlaneExtent extent;        ///< convex hull of its observations, metres, world
  int num_observations = 0;  ///< keyframes that observe it
  std::optional<int> axis;   ///< index 0..2 of the Manhattan axis that its normal is parallel to
};

/// The Manhattan axes of the scene.
struct MapAxes {
  AxesState state = AxesState::kNone;
  int num_refinements = 0;
  Eigen::Quaterniond world_from_axes = Eigen::Quaterniond::Identity();  ///< unless kNone
  double sigma = 0.0;      ///< standard deviation of the least certain direction, radians
  double deviation = 0.0;  ///< learnt scale of the angle between a line and its axis, radians
};

/// Result of a run.
struct OdometryResult {
  std::vector<FrameResult> frames;  ///< one per image, in order, with the final poses
  std::vector<Segment> segments;    ///< in order of time; one unless the map was left behind
  std::vector<Loop> loops;          ///< that were closed, in order of time
  /// The world (Segment::world) of keyframes, points, lines, planes and axes: the one with most
  /// estimated poses.
  int map_world = 0;
  std::vector<TimedPose> keyframes;  ///< of this run, in order of time
  /// Keyframes of earlier sessions (Odometry::SetMap()), by world, then by session.
  std::vector<SessionPath> earlier_sessions;
  std::vector<MapPoint> points;
  std::vector<MapLine> lines;
  std::vector<MapPlane> planes;  ///< empty unless OdometryOptions use planes
  MapAxes axes;
  NoiseScale noise_scale;  ///< of the sigmas of the features, self-calibrated
  /// The depth sensor of the options, or the one inferred from the depth images; kAuto: too little
  /// depth.
  DepthSensor depth_sensor = DepthSensor::kAuto;
  /// Readout time of the rolling shutter, seconds, given or self-calibrated; 0: global shutter.
  double readout_time = 0.0;
  /// Uncertainty of `readout_time`, seconds; 0 if it was given.
  double readout_time_sigma = 0.0;
  /// Self-calibration, relative to the given calibration.
  CorrectionEstimate calibration;
  CameraIntrinsics intrinsics;  ///< at the end of the run: as given, or corrected
  /// Camera of the depth images that were given to the odometry; the colour camera if they are
  /// registered.
  DepthCamera depth_camera;
  std::vector<ExtraBlock> extra_blocks;  ///< of the window factors, in order of their ids
  BundleAdjustmentSummary last_window;
  /// Maps that were not ready for the first frame that should have been tracked in them; 0 unless
  /// SnapshotOptions::realtime.
  int num_late_maps = 0;
};

/// RGB-D visual odometry from points and lines (paper: PL-VO and MSC-VO).
///
///   Odometry odometry(options, camera, distortion);
///   while (source.Next(&image)) odometry.Process(image);
///   OdometryResult result = odometry.Finish();
///
/// World 0 is the camera frame of the first tracked image. When the map cannot be found again, a
/// new segment begins with a map and a world of its own, placed where the camera was seen last;
/// when it meets an older map, the two are joined, and poses are in the world of the older one from
/// then on. When the camera returns to a place that it has left, the map is corrected (a loop is
/// closed). FrameResult::world names the world of each pose, and FrameResult::world_changed the
/// frames where it is another one, or was corrected. The result is deterministic: the same images
/// give the same poses, bit by bit. Events are logged to Log() (logging/logger.h).
///
/// Everything that is set up must be set before the first image: Set...(), SkipClippedDepthSearch()
/// and Restore() throw std::invalid_argument after Process() has accepted one, or Drop().
class Odometry {
 public:
  /// Throws std::invalid_argument on invalid options or an invalid camera.
  Odometry(const OdometryOptions& options, const PinholeCamera& camera,
           const LensDistortion& distortion);
  ~Odometry();

  /// Sets a function that is called with every window before it is solved, on the mapper's thread
  /// if there is one.
  void SetWindowObserver(WindowObserver observer);

  /// Sets a function that returns custom factors for every window of local bundle adjustment. Runs
  /// on the mapper's thread if there is one.
  void SetWindowFactors(WindowFactorCallback callback);

  /// Sets a function that returns custom factors over the pose of every frame (see
  /// Tracker::SetPoseFactors). Runs in Process(). A frame whose factors fail is tracked without
  /// them.
  void SetPoseFactors(PoseFactorCallback callback);

  /// Sets a function that is called with the features, the matches and the map of every tracked
  /// frame, for display. Its time is not part of StageTimes.
  void SetTrackingObserver(TrackingObserver observer);

  /// Begins with the map of earlier sessions (LoadMap()). The run begins in a world of its own, and
  /// enters that of the map when enough keyframes have been found in it, as if it were the map of
  /// an older segment: the submaps of `earlier` are the first segments and worlds of the result.
  /// The map is expressed in the camera of this run.
  void SetMap(MapContents earlier);

  /// States that depth images contain no clipped values, or 0 instead of them, as those of
  /// RgbdDecoder: by default, the odometry finds out from the images at which depths their driver
  /// clips.
  void SkipClippedDepthSearch();

  /// Tracks one image and returns its result, which may still improve until Finish().
  /// Images that are views of larger matrices are copied.
  ///
  /// An image that does not match the camera, whose depth is not in metres, or whose time stamp
  /// does not ascend or is beyond 1e11 seconds, is refused with std::invalid_argument: it is as if
  /// it had not been given, and may be given again after it has been corrected. All other
  /// exceptions are thrown after the frame is complete: it is the last one of frames(), and giving
  /// the image again is refused. They are those of a keyframe step whose map would have become
  /// visible (the map before remains in use), of the callback of the pose factors and of their
  /// evaluation, std::invalid_argument that names an invalid factor, and those of the tracking
  /// observer. Of several in one image, the first one is thrown, and the others are logged. If
  /// anything else fails, the frame is lost.
  FrameResult Process(const RgbdImage& image);

  /// Records a frame at `timestamp` (seconds) that is not processed, because its image came too
  /// late (kDropped) or could not be read (kUnreadable). It gets the pose of the previous frame,
  /// and in the result of Finish() the pose interpolated between its neighbours. Throws
  /// std::invalid_argument on time stamps that Process() refuses, or on another status.
  FrameResult Drop(int64_t id, double timestamp, TrackingStatus status = TrackingStatus::kDropped);

  /// Whether RunMapping() has work to do; false unless OdometryOptions::external_mapping.
  bool MappingPending() const;
  /// Runs local mapping of earlier keyframes, in slices, as long as the next slice is expected to
  /// end within `budget` seconds. Returns MappingPending(). The budget decides when the work runs,
  /// not which map a frame sees: an unfinished map that a frame needs is finished in Process(), or
  /// counts as late with SnapshotOptions::realtime. Callbacks of windows run here or there; their
  /// exceptions are those of the keyframe step, which Process() throws. Throws
  /// std::invalid_argument without OdometryOptions::external_mapping, and if the budget is negative
  /// or not a number.
  bool RunMapping(double budget);

  /// The frames so far, as Process() and Drop() returned them, with the times of their mapping.
  /// Frames of a start that was discarded since are lost.
  const std::vector<FrameResult>& frames() const;

  /// Waits for the mapper and returns the trajectory relative to the final keyframe poses, with
  /// poses that are estimated again (OdometryOptions::pose_refinement_delay). May be
  /// called at any time. `only_localized`: poses and map are those in worlds of earlier sessions
  /// (KeepLocalizedPoses()). Throws the exception of a keyframe step if Process() has not; the next
  /// call returns the result.
  OdometryResult Finish(bool only_localized = false);

  /// Waits for the mapper and returns the present map. Throws as Finish() does.
  MapSnapshotPtr Map();
  /// Waits for the mapper and returns all maps of this run and of earlier sessions, to be saved
  /// (SaveMap(), MapWriter). They share memory with the odometry, and nothing depends on the call.
  /// `session`: name of this run. std::nullopt if a keyframe step has failed and its exception is
  /// not thrown yet.
  std::optional<MapContents> ShareMaps(const std::string& session);

  /// Whether the mapper works on keyframes, so that Save() would wait.
  bool IsMapping();
  /// Waits for the mapper and writes the state of the run (checkpoint/checkpoint_file.h). A run
  /// that restores it continues with the same results, bit by bit. Writes nothing and returns false
  /// if a keyframe step has failed and its exception is not thrown yet. Custom factors have to save
  /// the state of their own, after this function has returned: the mapper calls them until then.
  bool Save(BinaryWriter* archive);
  /// Restores the state of a run with the same options, apart from `threads` and
  /// `external_mapping`, and the same camera. Throws std::runtime_error if the archive has no such
  /// state, std::invalid_argument if its camera is invalid; the object can then only be destroyed.
  void Restore(BinaryReader* archive);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace msc_vo
