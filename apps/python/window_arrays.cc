// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/window_arrays.h"

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <pybind11/eigen.h>

#include "apps/python/arrays.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// Row i of an (N, 6) array as a line from start to end.
LineSegment3 SegmentOf(const RowMajorMatrix& rows, size_t i) {
  return {rows.row(i).head<3>().transpose(), rows.row(i).tail<3>().transpose()};
}

// (N, 2, 2) covariances as rows of four.
RowMajorMatrix CovarianceRows(py::handle value, const std::string& name, int size) {
  const py::array array = PlainArray(value, name);
  if (array.ndim() != 3 || array.shape(0) != size || array.shape(1) != 2 || array.shape(2) != 2) {
    throw std::invalid_argument(name + ": expected shape (" + std::to_string(size) +
                                ", 2, 2), not " + DescribeArray(array));
  }
  RowMajorMatrix rows(size, 4);
  CopyNumbers(array.attr("reshape")(size, 4), name, size, 4, rows.data());
  return rows;
}

}  // namespace

void AddKeyframes(WindowData* window, py::handle ids, py::handle cam_from_world, py::handle fixed) {
  const std::vector<Rigid3> poses = PosesArgument(cam_from_world, "cam_from_world");
  const int size = static_cast<int>(poses.size());
  const std::vector<int64_t> names = IdsArgument(ids, "ids", size);
  const std::vector<bool> is_fixed = FlagsArgument(fixed, "fixed", size);
  for (int i = 0; i < size; ++i) window->keyframes.push_back({names[i], poses[i], is_fixed[i]});
}

void AddPoints(WindowData* window, py::handle ids, py::handle positions, py::handle fixed,
               py::handle noise) {
  const RowMajorMatrix rows = MatrixArgument(positions, "positions", -1, 3);
  const int size = static_cast<int>(rows.rows());
  const std::vector<int64_t> names = IdsArgument(ids, "ids", size);
  const std::vector<bool> is_fixed = FlagsArgument(fixed, "fixed", size);
  const Eigen::VectorXd factor = PerRowArgument(noise, "noise", size);
  for (int i = 0; i < size; ++i) {
    window->points.push_back({names[i], rows.row(i).transpose(), is_fixed[i], factor[i]});
  }
}

void AddLines(WindowData* window, py::handle ids, py::handle segments, py::handle fixed,
              py::handle noise, py::handle depth_offsets) {
  const RowMajorMatrix rows = MatrixArgument(segments, "segments", -1, 6);
  const int size = static_cast<int>(rows.rows());
  const std::vector<int64_t> names = IdsArgument(ids, "ids", size);
  const std::vector<bool> is_fixed = FlagsArgument(fixed, "fixed", size);
  const Eigen::VectorXd factor = PerRowArgument(noise, "noise", size);
  const Eigen::VectorXd offset = PerRowArgument(depth_offsets, "depth_offsets", size);
  for (int i = 0; i < size; ++i) {
    window->lines.push_back({names[i], SegmentOf(rows, i), is_fixed[i], factor[i], offset[i]});
  }
}

void AddPointObservations(WindowData* window, py::handle keyframes, py::handle points,
                          py::handle pixels, py::handle sigmas, py::handle inverse_depths,
                          py::handle inverse_depth_sigmas) {
  const RowMajorMatrix rows = MatrixArgument(pixels, "pixels", -1, 2);
  const int size = static_cast<int>(rows.rows());
  const std::vector<int64_t> keyframe = IdsArgument(keyframes, "keyframes", size);
  const std::vector<int64_t> point = IdsArgument(points, "points", size);
  const Eigen::VectorXd sigma = PerRowArgument(sigmas, "sigmas", size);
  const Eigen::VectorXd depth = PerRowArgument(inverse_depths, "inverse_depths", size);
  const Eigen::VectorXd depth_sigma =
      PerRowArgument(inverse_depth_sigmas, "inverse_depth_sigmas", size);
  for (int i = 0; i < size; ++i) {
    window->point_observations.push_back({keyframe[i], point[i], rows.row(i).transpose(), sigma[i],
                                          depth[i], depth_sigma[i], false});
  }
}

void AddLineObservations(WindowData* window, py::handle keyframes, py::handle lines,
                         py::handle segments, py::handle sigmas, py::handle inverse_depths,
                         py::handle depth_covariances) {
  const RowMajorMatrix rows = MatrixArgument(segments, "segments", -1, 4);
  const int size = static_cast<int>(rows.rows());
  const std::vector<int64_t> keyframe = IdsArgument(keyframes, "keyframes", size);
  const std::vector<int64_t> line = IdsArgument(lines, "lines", size);
  const Eigen::VectorXd sigma = PerRowArgument(sigmas, "sigmas", size);
  const bool has_depth = !inverse_depths.is_none();
  if (has_depth == depth_covariances.is_none()) {
    throw std::invalid_argument("inverse_depths and depth_covariances: give both or neither");
  }
  RowMajorMatrix depth, covariance;
  if (has_depth) {
    depth.resize(size, 2);
    CopyNumbers(inverse_depths, "inverse_depths", size, 2, depth.data());
    covariance = CovarianceRows(depth_covariances, "depth_covariances", size);
  }
  for (int i = 0; i < size; ++i) {
    WindowData::LineObservation observation;
    observation.keyframe = keyframe[i];
    observation.line = line[i];
    observation.segment = {rows.row(i).head<2>().transpose(), rows.row(i).tail<2>().transpose()};
    observation.sigma = sigma[i];
    // Rows of nan are depths that are not measured; the solver refuses other numbers that are not
    // finite.
    observation.has_depth = has_depth && !(depth.row(i).array().isNaN().all() &&
                                           covariance.row(i).array().isNaN().all());
    if (observation.has_depth) {
      observation.depth.start = depth(i, 0);
      observation.depth.end = depth(i, 1);
      observation.depth.covariance << covariance(i, 0), covariance(i, 1), covariance(i, 2),
          covariance(i, 3);
    }
    window->line_observations.push_back(observation);
  }
}

void AddLinePairs(std::vector<WindowData::LinePair>* pairs, py::handle a, py::handle b,
                  py::handle sigmas, py::handle counts) {
  const std::vector<int64_t> first = IdsArgument(a, "a", -1);
  const int size = static_cast<int>(first.size());
  const std::vector<int64_t> second = IdsArgument(b, "b", size);
  const Eigen::VectorXd sigma = PerRowArgument(sigmas, "sigmas", size);
  std::vector<int64_t> count(size, 1);
  if (!counts.is_none()) count = IdsArgument(counts, "counts", size);
  constexpr int64_t kLargest = std::numeric_limits<int>::max();
  for (const int64_t n : count) {
    if (n < 0 || n > kLargest) {
      throw std::invalid_argument("counts: " + std::to_string(n) + " must be from 0 to " +
                                  std::to_string(kLargest));
    }
  }
  for (int i = 0; i < size; ++i) {
    pairs->push_back({first[i], second[i], sigma[i], static_cast<int>(count[i]), false});
  }
}

void AddAxisAlignments(WindowData* window, py::handle lines, py::handle axes, py::handle sigmas) {
  const RowMajorMatrix rows = MatrixArgument(axes, "axes", -1, 3);
  const int size = static_cast<int>(rows.rows());
  const std::vector<int64_t> line = IdsArgument(lines, "lines", size);
  const Eigen::VectorXd sigma = PerRowArgument(sigmas, "sigmas", size);
  for (int i = 0; i < size; ++i) {
    window->axis_alignments.push_back({line[i], rows.row(i).transpose(), sigma[i], false});
  }
}

void AddPosePrior(WindowData* window, int64_t keyframe, py::handle cam_from_world,
                  py::handle covariance) {
  window->pose_priors.push_back({keyframe, PoseArgument(cam_from_world, "cam_from_world"),
                                 MatrixArgument(covariance, "covariance", 6, 6)});
}

py::array_t<double> PosesOf(const WindowData& window) {
  return Matrices<4>(window.keyframes, [](const WindowData::Keyframe& keyframe) {
    return PoseMatrix(keyframe.cam_from_world);
  });
}

RowMajorMatrix PointsOf(const WindowData& window) {
  return Rows(window.points, 3,
              [](const WindowData::Point& point, auto row) { row = point.position.transpose(); });
}

RowMajorMatrix LinesOf(const WindowData& window) {
  return Rows(window.lines, 6,
              [](const WindowData::Line& line, auto row) { FillEndPoints(line.segment, row); });
}

py::dict PointObservationArrays(const std::vector<WindowData::PointObservation>& items) {
  using Item = WindowData::PointObservation;
  py::dict arrays;
  arrays["keyframes"] = Column<int64_t>(items, &Item::keyframe);
  arrays["points"] = Column<int64_t>(items, &Item::point);
  arrays["pixels"] =
      Rows(items, 2, [](const Item& item, auto row) { row = item.pixel.transpose(); });
  arrays["sigmas"] = Column<double>(items, &Item::sigma);
  arrays["inverse_depths"] = Column<double>(items, &Item::inverse_depth);
  arrays["inverse_depth_sigmas"] = Column<double>(items, &Item::inverse_depth_sigma);
  return arrays;
}

py::dict LineObservationArrays(const std::vector<WindowData::LineObservation>& items) {
  using Item = WindowData::LineObservation;
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  py::dict arrays;
  arrays["keyframes"] = Column<int64_t>(items, &Item::keyframe);
  arrays["lines"] = Column<int64_t>(items, &Item::line);
  arrays["segments"] =
      Rows(items, 4, [](const Item& item, auto row) { FillEndPoints(item.segment, row); });
  arrays["sigmas"] = Column<double>(items, &Item::sigma);
  arrays["inverse_depths"] = Rows(items, 2, [](const Item& item, auto row) {
    row.setConstant(kNone);
    if (item.has_depth) row << item.depth.start, item.depth.end;
  });
  arrays["depth_covariances"] = Matrices<2>(items, [](const Item& item) -> Eigen::Matrix2d {
    return item.has_depth ? item.depth.covariance : Eigen::Matrix2d::Constant(kNone);
  });
  return arrays;
}

py::dict LinePairArrays(const std::vector<WindowData::LinePair>& items) {
  using Item = WindowData::LinePair;
  py::dict arrays;
  arrays["a"] = Column<int64_t>(items, &Item::a);
  arrays["b"] = Column<int64_t>(items, &Item::b);
  arrays["sigmas"] = Column<double>(items, &Item::sigma);
  arrays["counts"] = Column<int64_t>(items, &Item::count);
  return arrays;
}

py::dict AxisAlignmentArrays(const std::vector<WindowData::AxisAlignment>& items) {
  using Item = WindowData::AxisAlignment;
  py::dict arrays;
  arrays["lines"] = Column<int64_t>(items, &Item::line);
  arrays["axes"] = Rows(items, 3, [](const Item& item, auto row) { row = item.axis.transpose(); });
  arrays["sigmas"] = Column<double>(items, &Item::sigma);
  return arrays;
}

}  // namespace msc_vo
