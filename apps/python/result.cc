// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/odometry/localization.h"
#include "msc_vo/results/run_summary.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// Views of the vectors of a result, which does not change after Finish().

py::array MapPoints(const py::object& self) {
  const auto& points = self.cast<const OdometryResult&>().points;
  if (points.empty()) return py::cast(RowMajorMatrix(0, 3));
  return ArrayView(points[0].position.data(), {static_cast<py::ssize_t>(points.size()), 3},
                   {sizeof(MapPoint), sizeof(double)}, self);
}

py::array PointObservationsOf(const py::object& self) {
  const auto& points = self.cast<const OdometryResult&>().points;
  if (points.empty()) return py::array_t<int>(0);
  return ArrayView(&points[0].num_observations, {static_cast<py::ssize_t>(points.size())},
                   {sizeof(MapPoint)}, self);
}

py::array MapLines(const py::object& self) {
  static_assert(sizeof(LineSegment3) == 6 * sizeof(double), "start and end are adjacent");
  const auto& lines = self.cast<const OdometryResult&>().lines;
  if (lines.empty()) return py::cast(RowMajorMatrix(0, 6));
  return ArrayView(lines[0].segment.start.data(), {static_cast<py::ssize_t>(lines.size()), 6},
                   {sizeof(MapLine), sizeof(double)}, self);
}

py::array LineObservationsOf(const py::object& self) {
  const auto& lines = self.cast<const OdometryResult&>().lines;
  if (lines.empty()) return py::array_t<int>(0);
  return ArrayView(&lines[0].num_observations, {static_cast<py::ssize_t>(lines.size())},
                   {sizeof(MapLine)}, self);
}

// The Manhattan axes of lines or planes; -1: none.
template <typename Item>
py::array AxesOf(const std::vector<Item>& items) {
  return Column<int>(items, [](const Item& item) { return item.axis.value_or(-1); });
}

// (M, 4) rows n, d.
RowMajorMatrix PlanesOf(const OdometryResult& result) {
  return Rows(result.planes, 4,
              [](const MapPlane& plane, auto row) { row = plane.plane.params.transpose(); });
}

py::list PlaneExtentsOf(const OdometryResult& result) {
  py::list extents;
  for (const MapPlane& plane : result.planes) {
    extents.append(Rows(plane.extent, 3,
                        [](const Eigen::Vector3d& vertex, auto row) { row = vertex.transpose(); }));
  }
  return extents;
}

py::array EstimatedOf(const OdometryResult& result) {
  return Column<bool>(result.frames,
                      [](const FrameResult& frame) { return IsEstimated(frame.status); });
}

// One row per frame, also for those that have no pose.
RowMajorMatrix AllRows(const OdometryResult& result) {
  std::vector<TimedPose> poses;
  for (const FrameResult& frame : result.frames) {
    poses.push_back({frame.timestamp, frame.cam_from_world.Inverse()});
  }
  RowMajorMatrix rows = TrajectoryRows(poses);
  for (size_t i = 0; i < result.frames.size(); ++i) {
    if (result.frames[i].segment != kNoSegment) continue;
    rows.row(i).tail(7).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return rows;
}

// One per frame; nan where nothing determines the pose.
py::array_t<double> CovariancesOf(const OdometryResult& result,
                                  std::optional<PoseCovariance> FrameResult::*covariance) {
  return Matrices<6>(result.frames, [covariance](const FrameResult& frame) {
    return (frame.*covariance)
        .value_or(PoseCovariance::Constant(std::numeric_limits<double>::quiet_NaN()));
  });
}

py::object StatusOf(const OdometryResult& result) {
  py::list names;
  for (const FrameResult& frame : result.frames) names.append(ToString(frame.status));
  return py::module_::import("numpy").attr("array")(names, "U10");  // also if there are none
}

py::list SegmentsOf(const OdometryResult& result) {
  py::list segments;
  for (const Segment& segment : result.segments) {
    py::dict entry;
    entry["first_frame"] = segment.first_frame;
    entry["last_frame"] = segment.last_frame;
    entry["num_estimated"] = segment.num_estimated;
    entry["world"] = segment.world;
    entry["is_earlier_session"] = segment.is_earlier_session;
    segments.append(entry);
  }
  return segments;
}

py::list LoopsOf(const OdometryResult& result) {
  py::list loops;
  for (const Loop& loop : result.loops) {
    py::dict entry;
    entry["frame"] = loop.frame;
    entry["reference"] = loop.reference;
    entry["num_keyframes"] = loop.num_keyframes;
    entry["rotation"] = loop.rotation;
    entry["translation"] = loop.translation;
    loops.append(entry);
  }
  return loops;
}

py::list EarlierSessionsOf(const OdometryResult& result) {
  py::list sessions;
  for (const SessionPath& session : result.earlier_sessions) {
    py::list poses;
    for (const Rigid3& world_from_cam : session.world_from_cam)
      poses.append(PoseMatrix(world_from_cam));
    py::dict entry;
    entry["name"] = session.name;
    entry["world"] = session.world;
    entry["world_from_cam"] = poses;
    sessions.append(entry);
  }
  return sessions;
}

py::object WorldFromAxes(const OdometryResult& result) {
  if (result.axes.state == AxesState::kNone) return py::none();
  return py::cast(Eigen::Matrix3d(result.axes.world_from_axes.toRotationMatrix()));
}

py::dict ExtraBlocksOfResult(const OdometryResult& result) {
  py::dict blocks;
  for (const ExtraBlock& block : result.extra_blocks) blocks[py::int_(block.id)] = block.value;
  return blocks;
}

py::dict NoiseScaleOf(const OdometryResult& result) {
  py::dict scale;
  scale["point_depth"] = result.noise_scale.point_depth;
  scale["line_pixel"] = result.noise_scale.line_pixel;
  scale["line_depth"] = result.noise_scale.line_depth;
  return scale;
}

std::string DescribeResult(const OdometryResult& result) {
  return FormatText("<Result: %zu frames, %zu keyframes, %zu points, %zu lines>",
                    result.frames.size(), result.keyframes.size(), result.points.size(),
                    result.lines.size());
}

void Write(const OdometryResult& result, const py::object& path) {
  WriteTrajectory(PathArgument(path), TrajectoryOf(result));
}

using ResultClass = py::class_<OdometryResult, std::shared_ptr<OdometryResult>>;

void BindCalibrationOf(ResultClass* result) {
  using Result = OdometryResult;
  result->def_readonly("calibration", &Result::calibration, "What self-calibration found.")
      .def_property_readonly(
          "camera", [](const Result& self) { return self.intrinsics.camera; },
          "Camera of the undistorted images at the end of the run: as given, or corrected.")
      .def_property_readonly(
          "lens", [](const Result& self) { return self.intrinsics.distortion; },
          "Lens at the end of the run: as given, or corrected.")
      .def_readonly(
          "depth_camera", &Result::depth_camera,
          "DepthCamera of the depth images that were given; the colour camera if they are "
          "registered.")
      .def_readonly("readout_time", &Result::readout_time,
                    "Seconds, of the rolling shutter, given or estimated; 0: global shutter.")
      .def_readonly("readout_time_sigma", &Result::readout_time_sigma,
                    "Standard deviation of readout_time, seconds; 0 if it was given.")
      .def_property_readonly("noise_scale", &NoiseScaleOf,
                             "Estimated errors of 'point_depth', 'line_pixel' and 'line_depth' "
                             "relative to the sigmas of the features.")
      .def_property_readonly(
          "depth_sensor", [](const Result& self) { return ToString(self.depth_sensor); },
          "'structured-light', 'tof', 'stereo' or 'lidar'; 'auto': too little depth to tell.");
}

void BindPlanesOf(ResultClass* result) {
  using Result = OdometryResult;
  result
      ->def_property_readonly("planes", &PlanesOf,
                              "(M, 4) rows n, d of map planes n . x + d = 0: unit normal towards "
                              "the cameras, metres. Empty unless the run uses planes.")
      .def_property_readonly("plane_extents", &PlaneExtentsOf,
                             "M arrays (K, 3), the vertices of the observed part of each plane, "
                             "counter-clockwise seen from its front; K = 0: unknown.")
      .def_property_readonly("plane_observations",
                             ColumnGetter(&Result::planes, &MapPlane::num_observations),
                             "(M,) number of keyframes that observe each plane.")
      .def_property_readonly(
          "plane_axes", [](const Result& self) { return AxesOf(self.planes); },
          "(M,) the Manhattan axis (0, 1, 2) that the normal of a plane is "
          "parallel to; -1: none.");
}

void BindAxesOf(ResultClass* result) {
  using Result = OdometryResult;
  result
      ->def_property_readonly(
          "axes_state", [](const Result& self) { return ToString(self.axes.state); },
          "'none', 'coarse' or 'refined' Manhattan axes.")
      .def_property_readonly("world_from_axes", &WorldFromAxes,
                             "3x3 rotation; None without Manhattan axes.")
      .def_property_readonly(
          "axes_sigma", [](const Result& self) { return self.axes.sigma; },
          "Standard deviation of the least certain axis, radians.");
}

void BindCovariancesOf(ResultClass* result) {
  using Result = OdometryResult;
  result
      ->def_property_readonly(
          "covariances",
          [](const Result& self) { return CovariancesOf(self, &FrameResult::covariance); },
          "(N, 6, 6), one per frame, of cam_from_world as FrameResult.covariance; nan where "
          "nothing "
          "determines the pose.")
      .def_property_readonly(
          "world_covariances",
          [](const Result& self) { return CovariancesOf(self, &FrameResult::world_covariance); },
          "(N, 6, 6), as covariances, of FrameResult.world_covariance.")
      .def_property_readonly(
          "odometry_covariances",
          [](const Result& self) { return CovariancesOf(self, &FrameResult::odometry_covariance); },
          "(N, 6, 6), as covariances, of FrameResult.odometry_covariance.");
}

}  // namespace

void BindResult(py::module_* module) {
  ResultClass result(*module, "Result",
                     "The result of a run. Lengths in metres, in the world. Equal if all numbers "
                     "but the measured times are, bit by bit.");
  BindCalibrationOf(&result);
  BindAxesOf(&result);
  BindPlanesOf(&result);
  BindCovariancesOf(&result);
  result
      .def_property_readonly("trajectory", &AllRows,
                             "(N, 8) rows t tx ty tz qx qy qz qw, one per frame, camera in world; "
                             "nan in frames before "
                             "the first segment, which have no pose.")
      .def_property_readonly("status", &StatusOf, "(N,) str, FrameResult.status of every frame.")
      .def_property_readonly("segment",
                             ColumnGetter(&OdometryResult::frames, &FrameResult::segment),
                             "(N,) number of the segment that each frame belongs to; -1: none.")
      .def_property_readonly("segments", &SegmentsOf,
                             "One dict per segment: first_frame, last_frame, num_estimated, world, "
                             "is_earlier_session.")
      .def_property_readonly(
          "loops", &LoopsOf,
          "One dict per closed loop: frame and reference, indices of the frames that show one "
          "place, num_keyframes, and the correction at `frame`: rotation (radians), translation "
          "(metres).")
      .def_property_readonly("first_localized_frame", &FirstLocalizedFrame,
                             "Index of the first frame whose pose is in the world of a map that "
                             "was loaded; None if there is none.")
      .def_property_readonly("estimated", &EstimatedOf,
                             "(N,) bool: whether the pose is estimated from the image of its time.")
      .def_property_readonly(
          "keyframes", [](const OdometryResult& self) { return TrajectoryRows(self.keyframes); },
          "(K, 8), as trajectory, of the keyframes.")
      .def_readonly("frames", &OdometryResult::frames, "FrameResult objects with final poses.")
      .def_property_readonly("points", &MapPoints, "(P, 3) map points; read-only, not a copy.")
      .def_property_readonly("point_observations", &PointObservationsOf,
                             "(P,) number of keyframes that observe each point.")
      .def_property_readonly("lines", &MapLines,
                             "(L, 6) start and end of map lines; read-only, not a copy.")
      .def_property_readonly("line_observations", &LineObservationsOf,
                             "(L,) number of keyframes that observe each line.")
      .def_property_readonly(
          "line_axes", [](const OdometryResult& self) { return AxesOf(self.lines); },
          "(L,) the Manhattan axis (0, 1, 2) that a line is parallel to; -1: none.")
      .def_property_readonly("earlier_sessions", &EarlierSessionsOf,
                             "Sessions of the map that the run began with, by world: name, world "
                             "and world_from_cam, a list of the (4, 4) poses of their keyframes.")
      .def_readonly("map_world", &OdometryResult::map_world,
                    "Number of the world of keyframes, points, lines, planes and axes.")
      .def_readonly("last_window", &OdometryResult::last_window,
                    "WindowSummary of the last local bundle adjustment.")
      .def_readonly("num_late_maps", &OdometryResult::num_late_maps,
                    "Maps that were late in real time.")
      .def_property_readonly("extra_blocks", &ExtraBlocksOfResult,
                             "Estimates of the extra blocks by id.")
      .def("write_trajectory", &Write, py::arg("path"),
           "Writes trajectory.txt as `msc_vo replay` does.")
      .def("__repr__", &DescribeResult);
}

}  // namespace msc_vo
