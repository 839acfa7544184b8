// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/results/run_summary.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// The poses of the rows "t tx ty tz qx qy qz qw", read as a file without a header.
TrajectoryFile TrajectoryOfRows(const RowMajorMatrix& rows, const std::string& name) {
  TrajectoryFile trajectory;
  std::vector<TimedPose>& poses = trajectory.poses;
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    const auto pose = rows.row(i).tail<7>();
    if (std::isfinite(rows(i, 0)) && pose.array().isNaN().all()) continue;  // a frame without one
    if (!rows.row(i).allFinite()) {
      ++trajectory.num_left_out;
      continue;
    }
    const Eigen::Quaterniond q(rows(i, 7), rows(i, 4), rows(i, 5), rows(i, 6));
    if (std::abs(q.norm() - 1.0) > 0.05) {
      throw std::invalid_argument(name + ": row " + std::to_string(i) +
                                  ": the quaternion is not of unit length");
    }
    poses.push_back({rows(i, 0), Rigid3(q.normalized(), rows.row(i).segment<3>(1).transpose())});
  }
  SortByTime(&poses);
  return trajectory;
}

void Warn(const std::string& text) {
  if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

// A Result, a file, or an (N, 8) array.
TrajectoryFile TrajectoryArgument(const py::object& value, const std::string& name) {
  if (py::isinstance<py::str>(value) || py::hasattr(value, "__fspath__")) {
    return ReadTrajectoryFile(PathArgument(value));
  }
  if (!py::isinstance<OdometryResult>(value)) {
    return TrajectoryOfRows(TimedRowsArgument(value, name, 8), name);
  }
  TrajectoryFile trajectory;
  trajectory.unit = TimeUnit::kSeconds;
  trajectory.poses = TrajectoryOf(value.cast<const OdometryResult&>());
  return trajectory;
}

void RequirePoses(const std::string& name, const TrajectoryFile& file) {
  const std::string problem = file.DescribeLack();
  if (!problem.empty()) FailArgument(name, problem);
}

DeltaUnit UnitArgument(const std::string& name) {
  if (name == "frames") return DeltaUnit::kFrames;
  if (name == "metres") return DeltaUnit::kMetres;
  if (name == "seconds") return DeltaUnit::kSeconds;
  throw std::invalid_argument("rpe_unit: must be 'frames', 'metres' or 'seconds', not '" + name +
                              "'");
}

void RequireValid(const EvaluationOptions& options) {
  if (!(options.max_time_difference >= 0.0)) {
    FailArgument("max_dt", "must not be negative or nan");
  }
  const std::string problem = options.rpe_delta.Problem();
  if (!problem.empty()) FailArgument("rpe_delta", problem);
}

TrajectoryError EvaluatePoses(const py::object& gt, const py::object& est, const std::string& align,
                              double max_dt, bool all_poses, double rpe_delta,
                              const std::string& rpe_unit, bool rpe_all_pairs) {
  EvaluationOptions options;
  options.max_time_difference = max_dt;
  options.alignment = AlignmentFromString(align);
  options.all_poses = all_poses;
  options.rpe_delta = {rpe_delta, UnitArgument(rpe_unit), rpe_all_pairs};
  RequireValid(options);
  TrajectoryFile reference = TrajectoryArgument(gt, "gt");
  TrajectoryFile estimate = TrajectoryArgument(est, "est");
  RequirePoses("gt", reference);
  RequirePoses("est", estimate);
  std::vector<std::string> warnings;
  if (reference.num_left_out > 0) warnings.push_back("gt: " + reference.DescribeLeftOut());
  if (estimate.num_left_out > 0) warnings.push_back("est: " + estimate.DescribeLeftOut());
  ConvertToSeconds("gt", "est", &reference, &estimate, &warnings);
  ShareStamps("gt", "est", &reference, &estimate);
  TrajectoryError error = EvaluateTrajectory(reference.poses, estimate.poses, options);
  if (!error.usable) {
    for (const std::string& warning : warnings) Warn(warning);
    const std::string remedy = DescribeRemedy(error, "all_poses=True");
    throw std::invalid_argument(error.message + (remedy.empty() ? "" : "; " + remedy));
  }
  error.warnings.insert(error.warnings.begin(), warnings.begin(), warnings.end());
  for (const std::string& warning : error.warnings) Warn(warning);
  return error;
}

RowMajorMatrix PerPoseOf(const TrajectoryError& error) {
  return Rows(error.per_pose, 3, [](const PoseError& pose, auto row) {
    row << pose.timestamp, pose.translation, pose.rotation;
  });
}

std::string DescribeStatistics(const ErrorStatistics& statistics) {
  return FormatText(
      "ErrorStatistics(count=%d, rmse=%.6g, mean=%.6g, median=%.6g, p95=%.6g, "
      "max=%.6g)",
      statistics.count, statistics.rmse, statistics.mean, statistics.median, statistics.p95,
      statistics.max);
}

void BindStatistics(py::module_* module) {
  py::class_<ErrorStatistics>(*module, "ErrorStatistics", "Statistics of errors.")
      .def_readonly("count", &ErrorStatistics::count, "Number of errors.")
      .def_readonly("rmse", &ErrorStatistics::rmse, "Root of the mean square.")
      .def_readonly("mean", &ErrorStatistics::mean, "Mean.")
      .def_readonly("median", &ErrorStatistics::median, "Median.")
      .def_readonly("p95", &ErrorStatistics::p95, "95th percentile.")
      .def_readonly("min", &ErrorStatistics::min, "Smallest error.")
      .def_readonly("max", &ErrorStatistics::max, "Largest error.")
      .def_readonly("std", &ErrorStatistics::std, "Standard deviation about the mean.")
      .def_readonly("sse", &ErrorStatistics::sse, "Sum of squares.")
      .def("__repr__", &DescribeStatistics);
  py::class_<RelativeError>(*module, "RelativeError",
                            "Relative pose error (RPE) over a fixed interval or path length.")
      .def_readonly("translation", &RelativeError::translation, "Metres, or metres per metre.")
      .def_readonly("rotation", &RelativeError::rotation, "Radians, or radians per metre.");
}

void BindTrajectoryError(py::module_* module) {
  py::class_<TrajectoryError>(*module, "TrajectoryError",
                              "Errors of a trajectory; read them together with the coverage.")
      .def_readonly("ape", &TrajectoryError::ape, "Absolute position error, metres.")
      .def_readonly(
          "rotation", &TrajectoryError::rotation,
          "Radians, after alignment of the orientations; with 'origin' and 'none' as ape_rotation.")
      .def_readonly("ape_rotation", &TrajectoryError::ape_rotation, "Radians, after `align`.")
      .def_readonly(
          "rpe", &TrajectoryError::rpe,
          "Relative pose error over pairs of poses rpe_delta apart, by default from frame "
          "to frame.")
      .def_readonly("rpe_per_second", &TrajectoryError::rpe_per_second,
                    "Relative pose error over pairs of poses one second apart.")
      .def_readonly("rpe_per_metre", &TrajectoryError::rpe_per_metre,
                    "Relative pose error over pairs of poses one metre of path apart, divided by "
                    "their distance.")
      .def_readonly("num_reference", &TrajectoryError::num_reference, "Poses of the ground truth.")
      .def_readonly("num_estimate", &TrajectoryError::num_estimate,
                    "Poses of the estimate that are compared.")
      .def_readonly("num_not_estimated", &TrajectoryError::num_not_estimated,
                    "Poses that are left out because they are marked as not estimated.")
      .def_readonly("num_matched", &TrajectoryError::num_matched,
                    "Poses of the estimate with a reference pose at their time.")
      .def_readonly("coverage", &TrajectoryError::coverage, "Matched / reference poses, 0..1.")
      .def_readonly("coverage_in_range", &TrajectoryError::coverage_in_range,
                    "Matched / reference poses between the first and the last estimate, 0..1.")
      .def_readonly("scale", &TrajectoryError::scale,
                    "Factor of the estimate's positions; 1 unless align is 'sim3'.")
      .def_property_readonly(
          "matched_reference",
          [](const TrajectoryError& self) { return TrajectoryRows(self.matched_reference); },
          "(M, 8) rows t tx ty tz qx qy qz qw, the matched poses of the ground truth.")
      .def_property_readonly(
          "matched_estimate",
          [](const TrajectoryError& self) { return TrajectoryRows(self.matched_estimate); },
          "(M, 8), the matched poses of the estimate, aligned.")
      .def_readonly("path_length", &TrajectoryError::path_length,
                    "Metres, along the matched reference poses.")
      .def_readonly(
          "warnings", &TrajectoryError::warnings,
          "What makes the errors doubtful: an undetermined alignment, contradicting scales "
          "or orders of quaternions.")
      .def_property_readonly(
          "reference_from_estimate",
          [](const TrajectoryError& self) { return PoseMatrix(self.reference_from_estimate); },
          "4x4, world to world.")
      .def_property_readonly("per_pose", &PerPoseOf,
                             "(M, 3) rows time, position error (metres), rotation error (radians).")
      .def("__repr__", [](const TrajectoryError& self) {
        return FormatText("<TrajectoryError: APE RMSE %.6g m over %d poses, coverage %.4g>",
                          self.ape.rmse, self.num_matched, self.coverage);
      });
}

}  // namespace

void BindEvaluation(py::module_* module) {
  BindStatistics(module);
  BindTrajectoryError(module);
  module->def(
      "evaluate", &EvaluatePoses, py::arg("gt"), py::arg("est"), py::kw_only(),
      py::arg("align") = "se3", py::arg("max_dt") = 0.02, py::arg("all_poses") = false,
      py::arg("rpe_delta") = 1.0, py::arg("rpe_unit") = "frames", py::arg("rpe_all_pairs") = false,
      "Compares trajectories: a file, an (N, 8) array of rows t tx ty tz qx qy qz qw, or a Result. "
      "Rows with nan or inf are left out, and stamps in milliseconds, microseconds or nanoseconds "
      "are converted, both with a warning. "
      "align: 'se3' (Umeyama), 'sim3' (with scale), 'origin' (first poses) or 'none'. max_dt: "
      "seconds. rpe_delta, rpe_unit ('frames', 'metres', 'seconds'), rpe_all_pairs: the pairs of "
      "TrajectoryError.rpe, as --delta, --delta-unit and --all-pairs of `msc_vo evaluate`. "
      "Raises ValueError if fewer than three poses match or the alignment has no scale. Each of "
      "TrajectoryError.warnings is issued as a Python warning, too.");
}

}  // namespace msc_vo
