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
// no checkpoint contains.

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

// Defines FieldsOf() of a struct by the names of all its members in the order of their declaration,
// which is the order in a pickle. A structured binding names them, so that a list with a member too
// few or too many does not compile.
#define MSC_VO_FIELDS_OF(Type, ...)              \
  template <typename Archive>                    \
  void FieldsOf(Archive& archive, Type& value) { \
    auto& [__VA_ARGS__] = value;                 \
    AllFieldsOf(archive, __VA_ARGS__);           \
  }

MSC_VO_FIELDS_OF(TimedPose, timestamp, world_from_cam, is_estimated, segment, world)

// The result of a run.

MSC_VO_FIELDS_OF(SegmentJoin, frame, num_keyframes, rotation_sigma, translation_sigma)
MSC_VO_FIELDS_OF(Segment, first_frame, last_frame, num_estimated, world, join, is_earlier_session)
MSC_VO_FIELDS_OF(MapPoint, position, num_observations)
MSC_VO_FIELDS_OF(MapLine, segment, num_observations, in_last_window, axis, viewing_direction)
MSC_VO_FIELDS_OF(MapPlane, plane, extent, num_observations, axis)
MSC_VO_FIELDS_OF(MapAxes, state, num_refinements, world_from_axes, sigma, deviation)
MSC_VO_FIELDS_OF(DepthCamera, camera, depth_from_color, inverse_depth_offset, distortion)
MSC_VO_FIELDS_OF(SessionPath, name, world, world_from_cam)
MSC_VO_FIELDS_OF(OdometryResult, frames, segments, loops, map_world, keyframes, earlier_sessions,
                 points, lines, planes, axes, noise_scale, depth_sensor, readout_time,
                 readout_time_sigma, calibration, intrinsics, depth_camera, extra_blocks,
                 last_window, num_late_maps)

// Errors of a trajectory.

MSC_VO_FIELDS_OF(ErrorStatistics, count, rmse, mean, median, p95, max, min, std, sse)
MSC_VO_FIELDS_OF(RelativeError, translation, rotation)
MSC_VO_FIELDS_OF(PoseError, timestamp, translation, rotation)
MSC_VO_FIELDS_OF(TrajectoryError, usable, message, warnings, num_reference, num_estimate,
                 num_not_estimated, num_matched, num_reference_in_range, coverage,
                 coverage_in_range, path_length, alignment, reference_from_estimate, scale, ape,
                 rotation, ape_rotation, rpe, rpe_per_second, rpe_per_metre, per_pose,
                 matched_reference, matched_estimate)

// Windows of bundle adjustment.

MSC_VO_FIELDS_OF(WindowData::Keyframe, id, cam_from_world, fixed)
MSC_VO_FIELDS_OF(WindowData::Point, id, position, fixed, noise)
MSC_VO_FIELDS_OF(WindowData::Line, id, segment, fixed, noise, depth_offset)
MSC_VO_FIELDS_OF(WindowData::PointObservation, keyframe, point, pixel, sigma, inverse_depth,
                 inverse_depth_sigma, rejected, depth_rejected)
MSC_VO_FIELDS_OF(WindowData::LineObservation, keyframe, line, segment, sigma, has_depth, depth,
                 rejected, depth_rejected)
MSC_VO_FIELDS_OF(WindowData::LinePair, a, b, sigma, count, rejected)
MSC_VO_FIELDS_OF(WindowData::AxisAlignment, line, axis, sigma, rejected)
MSC_VO_FIELDS_OF(WindowData::PosePrior, keyframe, cam_from_world, covariance)
MSC_VO_FIELDS_OF(WindowAxes, world_from_axes, fixed)

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

MSC_VO_FIELDS_OF(WindowContext::Keyframe, id, timestamp, cam_from_world, fixed)
MSC_VO_FIELDS_OF(FrameContext, timestamp, last_timestamp, last_cam_from_world,
                 predicted_cam_from_world, world, extra_blocks)

#undef MSC_VO_FIELDS_OF

}  // namespace msc_vo
