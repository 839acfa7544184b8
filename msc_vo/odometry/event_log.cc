// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/event_log.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/odometry/loss_cause.h"
#include "msc_vo/self_calibration/noise_estimator.h"

namespace msc_vo {

namespace {

spdlog::level::level_enum LevelOf(TrackingStatus status) {
  return status == TrackingStatus::kTracked ? spdlog::level::info : spdlog::level::warn;
}

bool HasLossCause(TrackingStatus status) {
  return status == TrackingStatus::kPredicted || status == TrackingStatus::kLost;
}

}  // namespace

void EventLog::LogStart(const OdometryOptions& options, const PinholeCamera& camera) {
  readout_time_ = options.mapping.readout_time.value_or(0.0);
  chooses_depth_sensor_ = options.features.depth_sensor == DepthSensor::kAuto;
  Log().info("odometry: mode {}, {} threads; camera {}x{}, fx {:.3f} fy {:.3f} cx {:.3f} cy {:.3f}",
             ToString(options.mode), options.threads, camera.width, camera.height, camera.fx,
             camera.fy, camera.cx, camera.cy);
}

void EventLog::LogDepthSensor(DepthSensor sensor) {
  if (sensor == depth_sensor_) return;
  depth_sensor_ = sensor;
  Log().info("depth sensor: {} ({})", ToString(sensor),
             chooses_depth_sensor_ ? "chosen from the depth images" : "given");
}

void EventLog::LogClippedDepth(int64_t id, const DepthLimits& limits) {
  const auto log = [id](const char* condition, float depth) {
    Log().warn(
        "depth is clipped at {:.3f} m: it is that value wherever the scene is {}; from image "
        "{} on it does not count as measured",
        depth, condition, id);
  };
  if (limits.HasNearest()) log("nearer", limits.nearest);
  if (limits.HasFarthest()) log("farther", limits.farthest);
}

void EventLog::LogFrame(const FrameResult& frame, bool relocalized) {
  LogStatus(frame, relocalized);
  if (frame.is_keyframe) {
    Log().debug("frame {} is a keyframe: {} points, {} lines; inliers: {} points, {} lines",
                frame.id, frame.num_points, frame.num_lines, frame.num_inlier_points,
                frame.num_inlier_lines);
  }
}

void EventLog::LogStatus(const FrameResult& frame, bool relocalized) {
  if (relocalized) Log().info("frame {} is relocalised in the map", frame.id);
  if (frame.status == status_) return;
  const std::optional<TrackingStatus> last_status = std::exchange(status_, frame.status);
  const int64_t num_before = frame.id - std::exchange(status_since_, frame.id);
  if (!Log().should_log(LevelOf(frame.status))) return;
  std::string event = "is " + std::string(ToString(frame.status));
  if (HasLossCause(frame.status) && frame.cause) {
    event += std::string(", image ") + Describe(*frame.cause);
  }
  if (last_status) {
    event += "; the " + std::to_string(num_before) + " before it: " + ToString(*last_status);
  }
  Log().log(LevelOf(frame.status), "frame {} ({:.6f} s) {}", frame.id, frame.timestamp, event);
}

void EventLog::LogSegment(int segment, SegmentStart start) {
  if (start == SegmentStart::kAfterLoss) {
    Log().warn("segment {} begins: the map of the one before cannot be found again", segment);
  } else if (start == SegmentStart::kReplacing) {
    Log().warn("segment {} begins again: no frame could be tracked after its first one", segment);
  }
}

void EventLog::LogMapping(const MappingStep& step) {
  const MappingSummary& summary = step.summary;
  // Both steps of a keyframe report its join.
  if (summary.join && std::exchange(last_moved_map_, summary.join->moved) != summary.join->moved) {
    Log().info("maps joined at keyframe {}: {} keyframes were found in both", summary.keyframe,
               summary.join->num_keyframes);
  }
  if (summary.num_refused_joins > num_refused_joins_) {
    num_refused_joins_ = summary.num_refused_joins;
    Log().info(
        "maps not joined at keyframe {}: several keyframes were found in both, but the motion of "
        "the camera or the Manhattan axes rule the join out",
        summary.keyframe);
  }
  if (summary.loop) LogLoop(*summary.loop);
  if (summary.num_refused_loops > num_refused_loops_) {
    num_refused_loops_ = summary.num_refused_loops;
    Log().info(
        "loop not closed at keyframe {}: several keyframes were found at an older place, but the "
        "correction is larger than drift can be, or contradicts the rest of the map",
        summary.keyframe);
  }
  if (summary.axes_state != axes_state_ || summary.num_axes_refinements != num_axes_refinements_) {
    axes_state_ = summary.axes_state;
    num_axes_refinements_ = summary.num_axes_refinements;
    Log().info("Manhattan axes at keyframe {}: {}; refinements: {}", summary.keyframe,
               ToString(axes_state_), num_axes_refinements_);
  }
  if (summary.calibration) LogCalibration(step);
  if (step.snapshot && step.snapshot->readout_time != readout_time_) {
    const bool was_known = std::exchange(readout_time_, step.snapshot->readout_time) != 0.0;
    Log().log(was_known ? spdlog::level::debug : spdlog::level::info,
              "readout time {} at keyframe {}: {:.2f} ms", was_known ? "updated" : "accepted",
              summary.keyframe, 1000.0 * readout_time_);
  }
}

void EventLog::LogLoop(const LoopClosure& loop) {
  const Rigid3& correction = loop.new_from_old_camera;
  Log().info(
      "loop closed at keyframe {}: {} keyframes show the place of keyframe {}; corrected by "
      "{:.1f} mm and {:.2f} degrees",
      loop.keyframe, loop.num_keyframes, loop.reference, 1000.0 * correction.translation().norm(),
      RadiansToDegrees(LogSO3(correction.rotation()).norm()));
}

void EventLog::LogCalibration(const MappingStep& step) {
  using S = SensorCorrection;
  const CameraIntrinsics& intrinsics = *step.snapshot->intrinsics;
  const PinholeCamera& camera = intrinsics.distortion.Recorded(intrinsics.camera);
  const S::Vector& sigma = step.summary.calibration->estimate.sigma;
  const double f = camera.FocalLength();
  Log().info(
      "calibration corrected at keyframe {}: fx {:.2f} +- {:.2f} fy {:.2f} cx {:.2f} +- {:.2f} cy "
      "{:.2f} +- {:.2f} k1 {:.4f} +- {:.4f} k2 {:.4f} +- {:.4f}",
      step.summary.keyframe, camera.fx, f * sigma(S::kFocalLength), camera.fy, camera.cx,
      f * sigma(S::kCenterX), camera.cy, f * sigma(S::kCenterY), intrinsics.distortion.k[0],
      sigma(S::kK1), intrinsics.distortion.k[1], sigma(S::kK2));
  if (!intrinsics.registration) return;
  const S::Vector& depth = *intrinsics.registration;
  Log().info(
      "depth images are not registered: scale {:.4f} +- {:.4f}, shift {:.1f}, {:.1f} px, rotation "
      "{:.2f} +- {:.2f} degrees, parallax {:.1f}, {:.1f} mm",
      std::exp(depth(S::kDepthFocalLength)), sigma(S::kDepthFocalLength), f * depth(S::kDepthX),
      f * depth(S::kDepthY), RadiansToDegrees(depth(S::kDepthRoll)),
      RadiansToDegrees(sigma(S::kDepthRoll)), 1000.0 * depth(S::kDepthParallaxX),
      1000.0 * depth(S::kDepthParallaxY));
}

void EventLog::LogFinish(const NoiseScale& noise_scale, double readout_time, int num_frames) const {
  Log().info(
      "{} frames; noise scales: point depth {:.2f}, line pixels {:.2f}, line depth {:.2f}; readout "
      "time {:.2f} ms",
      num_frames, noise_scale.point_depth, noise_scale.line_pixel, noise_scale.line_depth,
      1000.0 * readout_time);
  const double largest = std::max(noise_scale.point_depth, noise_scale.line_depth);
  if (largest >= NoiseEstimator::kMaxScale) {
    Log().warn(
        "depth contradicts the images: its noise scale is at its bound of {:g}; check depth scale, "
        "registration and time stamps of depth (msc_vo check --deep)",
        NoiseEstimator::kMaxScale);
  }
}

}  // namespace msc_vo
