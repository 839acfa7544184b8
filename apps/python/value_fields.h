// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "msc_vo/bundle_adjustment/window_data.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/mapping/window_factors.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/tracking/pose_factor_callback.h"

namespace msc_vo {

// FieldsOf() passes all fields of a value to a BinaryWriter or a BinaryReader, also of types that
// no checkpoint contains. A structured binding names all members, so that a new one that is not
// listed does not compile.

/// Types that list their fields themselves.
template <typename Archive, typename T>
void FieldsOf(Archive& archive, T& value) {
  archive(value);
}

template <typename Archive, typename T>
void FieldsOf(Archive& archive, std::vector<T>& values) {
  auto size = static_cast<uint64_t>(values.size());
  archive(size);
  values.resize(size);
  for (T& value : values) FieldsOf(archive, value);
}

template <typename Archive, typename T>
void FieldsOf(Archive& archive, std::optional<T>& value) {
  bool exists = value.has_value();
  archive(exists);
  if (exists && !value) value.emplace();
  if (exists) FieldsOf(archive, *value);
}

template <typename Archive, typename... Values>
void AllFieldsOf(Archive& archive, Values&... values) {
  (FieldsOf(archive, values), ...);
}

template <typename Archive>
void FieldsOf(Archive& archive, TimedPose& value) {
  auto& [timestamp, world_from_cam, is_estimated, segment, world] = value;
  archive(timestamp, world_from_cam, is_estimated, segment, world);
}

// The result of a run.

template <typename Archive>
void FieldsOf(Archive& archive, SegmentJoin& value) {
  auto& [frame, num_keyframes, rotation_sigma, translation_sigma] = value;
  archive(frame, num_keyframes, rotation_sigma, translation_sigma);
}

template <typename Archive>
void FieldsOf(Archive& archive, Segment& value) {
  auto& [first_frame, last_frame, num_estimated, world, join, is_earlier_session] = value;
  AllFieldsOf(archive, first_frame, last_frame, num_estimated, world, join, is_earlier_session);
}

template <typename Archive>
void FieldsOf(Archive& archive, MapPoint& value) {
  auto& [position, num_observations] = value;
  archive(position, num_observations);
}

template <typename Archive>
void FieldsOf(Archive& archive, MapLine& value) {
  auto& [segment, num_observations, in_last_window, axis, viewing_direction] = value;
  archive(segment, num_observations, in_last_window, axis, viewing_direction);
}

template <typename Archive>
void FieldsOf(Archive& archive, MapPlane& value) {
  auto& [plane, extent, num_observations, axis] = value;
  archive(plane, extent, num_observations, axis);
}

template <typename Archive>
void FieldsOf(Archive& archive, MapAxes& value) {
  auto& [state, num_refinements, world_from_axes, sigma, deviation] = value;
  archive(state, num_refinements, world_from_axes, sigma, deviation);
}

template <typename Archive>
void FieldsOf(Archive& archive, DepthCamera& value) {
  auto& [camera, depth_from_color, inverse_depth_offset, distortion] = value;
  archive(camera, depth_from_color, inverse_depth_offset, distortion);
}

template <typename Archive>
void FieldsOf(Archive& archive, SessionPath& value) {
  auto& [name, world, world_from_cam] = value;
  AllFieldsOf(archive, name, world, world_from_cam);
}

template <typename Archive>
void FieldsOf(Archive& archive, OdometryResult& value) {
  auto& [frames, segments, loops, map_world, keyframes, earlier_sessions, points, lines, planes,
         axes, noise_scale, depth_sensor, readout_time, readout_time_sigma, calibration, intrinsics,
         depth_camera, extra_blocks, last_window, num_late_maps] = value;
  AllFieldsOf(archive, frames, segments, loops, map_world, keyframes, earlier_sessions, points,
              lines, planes, axes, noise_scale, depth_sensor, readout_time, readout_time_sigma,
              calibration, intrinsics, depth_camera, extra_blocks, last_window, num_late_maps);
}

// Errors of a trajectory.

template <typename Archive>
void FieldsOf(Archive& archive, ErrorStatistics& value) {
  auto& [count, rmse, mean, median, p95, max, min, std, sse] = value;
  archive(count, rmse, mean, median, p95, max, min, std, sse);
}

template <typename Archive>
void FieldsOf(Archive& archive, RelativeError& value) {
  auto& [translation, rotation] = value;
  AllFieldsOf(archive, translation, rotation);
}

template <typename Archive>
void FieldsOf(Archive& archive, PoseError& value) {
  auto& [timestamp, translation, rotation] = value;
  archive(timestamp, translation, rotation);
}

template <typename Archive>
void FieldsOf(Archive& archive, TrajectoryError& value) {
  auto& [usable, message, warnings, num_reference, num_estimate, num_not_estimated, num_matched,
         num_reference_in_range, coverage, coverage_in_range, path_length, alignment,
         reference_from_estimate, scale, ape, rotation, ape_rotation, rpe, rpe_per_second,
         rpe_per_metre, per_pose, matched_reference, matched_estimate] = value;
  AllFieldsOf(archive, usable, message, warnings, num_reference, num_estimate, num_not_estimated,
              num_matched, num_reference_in_range, coverage, coverage_in_range, path_length,
              alignment, reference_from_estimate, scale, ape, rotation, ape_rotation, rpe,
              rpe_per_second, rpe_per_metre, per_pose, matched_reference, matched_estimate);
}

// Windows of bundle adjustment.

template <typename Archive>
void FieldsOf(Archive& archive, WindowData::Keyframe& value) {
  auto& [id, cam_from_world, fixed] = value;
  archive(id, cam_from_world, fixed);
}

template <typename Archive>
void FieldsOf(Archive& archive, WindowData::Point& value) {
  auto& [id, position, fixed, noise] = value;
  archive(id, position, fixed, noise);
}

template <typename Archive>
void FieldsOf(Archive& archive, WindowData::Line& value) {
  auto& [id, segment, fixed, noise, depth_offset] = value;
  archive(id, segment, fixed, noise, depth_offset);
}

template <typename Archive>
void FieldsOf(Archive& archive, WindowData::PointObservation& value) {
  auto& [keyframe, point, pixel, sigma, inverse_depth, inverse_depth_sigma, rejected] = value;
  archive(keyframe, point, pixel, sigma, inverse_depth, inverse_depth_sigma, rejected);
}

template <typename Archive>
void FieldsOf(Archive& archive, WindowData::LineObservation& value) {
  auto& [keyframe, line, segment, sigma, has_depth, depth, rejected] = value;
  archive(keyframe, line, segment, sigma, has_depth, depth, rejected);
}

template <typename Archive>
void FieldsOf(Archive& archive, WindowData::LinePair& value) {
  auto& [a, b, sigma, count, rejected] = value;
  archive(a, b, sigma, count, rejected);
}

template <typename Archive>
void FieldsOf(Archive& archive, WindowData::AxisAlignment& value) {
  auto& [line, axis, sigma, rejected] = value;
  archive(line, axis, sigma, rejected);
}

template <typename Archive>
void FieldsOf(Archive& archive, WindowData::PosePrior& value) {
  auto& [keyframe, cam_from_world, covariance] = value;
  archive(keyframe, cam_from_world, covariance);
}

template <typename Archive>
void FieldsOf(Archive& archive, WindowAxes& value) {
  auto& [world_from_axes, fixed] = value;
  archive(world_from_axes, fixed);
}

/// Without extra blocks and custom factors, which hold code.
template <typename Archive>
void FieldsOf(Archive& archive, WindowData& value) {
  auto& [camera, keyframes, points, lines, point_observations, line_observations, parallel_pairs,
         perpendicular_pairs, axis_alignments, pose_priors, axes, extra_blocks, custom_factors] =
      value;
  static_cast<void>(extra_blocks);
  static_cast<void>(custom_factors);
  AllFieldsOf(archive, camera, keyframes, points, lines, point_observations, line_observations,
              parallel_pairs, perpendicular_pairs, axis_alignments, pose_priors, axes);
}

// Contexts of callbacks.

template <typename Archive>
void FieldsOf(Archive& archive, WindowContext::Keyframe& value) {
  auto& [id, timestamp, cam_from_world, fixed] = value;
  archive(id, timestamp, cam_from_world, fixed);
}

template <typename Archive>
void FieldsOf(Archive& archive, FrameContext& value) {
  auto& [timestamp, last_timestamp, last_cam_from_world, predicted_cam_from_world, world,
         extra_blocks] = value;
  AllFieldsOf(archive, timestamp, last_timestamp, last_cam_from_world, predicted_cam_from_world,
              world, extra_blocks);
}

}  // namespace msc_vo
