// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/observations.h"

#include <cstdint>
#include <limits>

#include <pybind11/eigen.h>

#include "apps/python/arrays.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// One number per item.
template <typename T, typename Items, typename Get>
py::array_t<T> Column(const Items& items, const Get& get) {
  py::array_t<T> column(static_cast<py::ssize_t>(items.size()));
  for (size_t i = 0; i < items.size(); ++i) column.mutable_at(i) = get(items[i]);
  return column;
}

}  // namespace

py::dict PointObservationArrays(const std::vector<WindowData::PointObservation>& items) {
  using Item = WindowData::PointObservation;
  RowMajorMatrix pixels(items.size(), 2);
  for (size_t i = 0; i < items.size(); ++i) pixels.row(i) = items[i].pixel.transpose();
  py::dict arrays;
  arrays["keyframes"] = Column<int64_t>(items, [](const Item& item) { return item.keyframe; });
  arrays["points"] = Column<int64_t>(items, [](const Item& item) { return item.point; });
  arrays["pixels"] = pixels;
  arrays["sigmas"] = Column<double>(items, [](const Item& item) { return item.sigma; });
  arrays["inverse_depths"] =
      Column<double>(items, [](const Item& item) { return item.inverse_depth; });
  arrays["inverse_depth_sigmas"] =
      Column<double>(items, [](const Item& item) { return item.inverse_depth_sigma; });
  return arrays;
}

py::dict LineObservationArrays(const std::vector<WindowData::LineObservation>& items) {
  using Item = WindowData::LineObservation;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  RowMajorMatrix segments(items.size(), 4);
  RowMajorMatrix depths = RowMajorMatrix::Constant(items.size(), 2, kNone);
  RowMajorMatrix covariances = RowMajorMatrix::Constant(items.size(), 4, kNone);
  for (size_t i = 0; i < items.size(); ++i) {
    const Item& item = items[i];
    segments.row(i) << item.segment.start.transpose(), item.segment.end.transpose();
    if (!item.has_depth) continue;
    depths.row(i) << item.depth.start, item.depth.end;
    covariances.row(i) << item.depth.covariance.row(0), item.depth.covariance.row(1);
  }
  py::dict arrays;
  arrays["keyframes"] = Column<int64_t>(items, [](const Item& item) { return item.keyframe; });
  arrays["lines"] = Column<int64_t>(items, [](const Item& item) { return item.line; });
  arrays["segments"] = segments;
  arrays["sigmas"] = Column<double>(items, [](const Item& item) { return item.sigma; });
  arrays["inverse_depths"] = depths;
  arrays["depth_covariances"] =
      py::cast(covariances).attr("reshape")(static_cast<py::ssize_t>(items.size()), 2, 2);
  return arrays;
}

py::dict LinePairArrays(const std::vector<WindowData::LinePair>& items) {
  using Item = WindowData::LinePair;
  py::dict arrays;
  arrays["a"] = Column<int64_t>(items, [](const Item& item) { return item.a; });
  arrays["b"] = Column<int64_t>(items, [](const Item& item) { return item.b; });
  arrays["sigmas"] = Column<double>(items, [](const Item& item) { return item.sigma; });
  arrays["counts"] = Column<int64_t>(items, [](const Item& item) { return item.count; });
  return arrays;
}

py::dict AxisAlignmentArrays(const std::vector<WindowData::AxisAlignment>& items) {
  using Item = WindowData::AxisAlignment;
  RowMajorMatrix axes(items.size(), 3);
  for (size_t i = 0; i < items.size(); ++i) axes.row(i) = items[i].axis.transpose();
  py::dict arrays;
  arrays["lines"] = Column<int64_t>(items, [](const Item& item) { return item.line; });
  arrays["axes"] = axes;
  arrays["sigmas"] = Column<double>(items, [](const Item& item) { return item.sigma; });
  return arrays;
}

}  // namespace msc_vo
