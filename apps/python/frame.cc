// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <optional>
#include <string>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "msc_vo/odometry/loss_cause.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

std::optional<RowMajor6d> CovarianceMatrix(const std::optional<PoseCovariance>& covariance) {
  return covariance ? std::make_optional<RowMajor6d>(*covariance) : std::nullopt;
}

py::object NewFromOld(const WorldChange& change) {
  return change.new_from_old ? py::cast(PoseMatrix(*change.new_from_old)) : py::none();
}

py::dict TimesOf(const FrameResult& frame) {
  py::dict times;
  times["features"] = frame.times.features;
  times["points"] = frame.times.points;
  times["lines"] = frame.times.lines;
  times["depth"] = frame.times.depth;
  times["matching"] = frame.times.matching;
  times["pose"] = frame.times.pose;
  times["waiting"] = frame.times.waiting;
  times["tracking"] = frame.times.tracking;
  times["mapping"] = frame.times.mapping;
  return times;
}

std::string DescribeFrame(const FrameResult& frame) {
  return FormatText("<FrameResult %lld at %.6f s: %s, %d points, %d lines>",
                    static_cast<long long>(frame.id), frame.timestamp, ToString(frame.status),
                    frame.num_inlier_points, frame.num_inlier_lines);
}

// The poses of a frame, and what they refer to.
void BindPoses(py::class_<FrameResult>* frame) {
  (*frame)
      .def_readonly("world", &FrameResult::world,
                    "Number of the world that cam_from_world refers to: that of the segment that "
                    "began it; -1: the frame has no pose.")
      .def_property_readonly(
          "world_changed",
          [](const FrameResult& self) -> py::object {
            if (!self.world_changed) return py::none();
            return py::make_tuple(self.world_changed->old_world, NewFromOld(*self.world_changed));
          },
          "None unless cam_from_world refers to another world than in the frame before; then the "
          "number of the old world and the 4x4 new_from_old, which is None where it is unknown.")
      .def_property_readonly(
          "cam_from_world", [](const FrameResult& self) { return PoseMatrix(self.cam_from_world); },
          "4x4; world 0 is the camera of the first tracked frame.")
      .def_property_readonly(
          "world_from_cam",
          [](const FrameResult& self) { return PoseMatrix(self.cam_from_world.Inverse()); }, "4x4.")
      .def_property_readonly(
          "cam_from_odometry",
          [](const FrameResult& self) { return PoseMatrix(self.cam_from_odometry); },
          "4x4 by integration of the motion between images: it drifts, but never jumps.")
      .def_property_readonly(
          "world_from_odometry",
          [](const FrameResult& self) { return PoseMatrix(self.WorldFromOdometry()); },
          "4x4; inv(cam_from_world) @ cam_from_odometry.");
}

void BindCovariances(py::class_<FrameResult>* frame) {
  frame
      ->def_property_readonly(
          "covariance", [](const FrameResult& self) { return CovarianceMatrix(self.covariance); },
          "6x6 of cam_from_world relative to the map nearby: rotation vector in the camera frame "
          "(radians), then translation (metres); None if nothing determines the pose, as in the "
          "frame that begins a world.")
      .def_property_readonly(
          "world_covariance",
          [](const FrameResult& self) { return CovarianceMatrix(self.world_covariance); },
          "6x6 of cam_from_world relative to the origin of the world, with the drift of the map; "
          "tangent and None as covariance.")
      .def_property_readonly(
          "odometry_covariance",
          [](const FrameResult& self) { return CovarianceMatrix(self.odometry_covariance); },
          "6x6 of cam_from_odometry, with the drift of the whole path; tangent and None as "
          "covariance.");
}

}  // namespace

void BindFrame(py::module_* module) {
  py::class_<FrameResult> frame(*module, "FrameResult",
                                "The result of one frame. Equal if all numbers but the measured "
                                "times are, bit by bit.");
  frame.def_readonly("id", &FrameResult::id, "Position in the sequence of images, from 0.")
      .def_readonly("timestamp", &FrameResult::timestamp, "Seconds.")
      .def_property_readonly(
          "status", [](const FrameResult& self) { return ToString(self.status); },
          "'tracked', 'weak', 'predicted', 'lost', 'dropped' or 'unreadable', see docs/usage.md.")
      .def_property_readonly(
          "is_estimated", [](const FrameResult& self) { return IsEstimated(self.status); },
          "Whether the pose comes from the image of this frame: tracked or weak.")
      .def_readonly("segment", &FrameResult::segment,
                    "Number of its segment; -1: it precedes the first one and has no pose.")
      .def_readonly("by_pose_factors", &FrameResult::by_pose_factors,
                    "Whether pose factors, not constant velocity, predict the pose.")
      .def_readonly("is_keyframe", &FrameResult::is_keyframe, "Whether it became a keyframe.")
      .def_property_readonly(
          "cause",
          [](const FrameResult& self) -> std::optional<std::string> {
            if (!self.cause) return std::nullopt;
            return ToString(*self.cause);
          },
          "Why the pose is weak, or was not estimated from the image: 'uniform_image', "
          "'few_features', 'no_depth', 'depth_out_of_range', 'no_match' or 'implausible'; None if "
          "the frame is tracked or has no image.")
      .def_readonly("num_points", &FrameResult::num_points, "Points in the image.")
      .def_readonly("num_lines", &FrameResult::num_lines, "Lines in the image.")
      .def_readonly("num_with_depth", &FrameResult::num_with_depth,
                    "Points and lines with a measured depth.")
      .def_readonly("num_inlier_points", &FrameResult::num_inlier_points,
                    "Points matched with the map and consistent with the pose.")
      .def_readonly("num_inlier_lines", &FrameResult::num_inlier_lines, "The same for lines.")
      .def_readonly("num_dynamic", &FrameResult::num_dynamic, "Matches on dynamic objects.")
      .def_property_readonly("times", &TimesOf, "Milliseconds by stage, as in frames.csv.")
      .def("__repr__", &DescribeFrame);
  BindPoses(&frame);
  BindCovariances(&frame);
}

}  // namespace msc_vo
