// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/observations.h"

#include <cstdint>
#include <limits>

#include <pybind11/eigen.h>

#include "apps/python/arrays.h"

namespace msc_vo {

namespace py = pybind11;

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
