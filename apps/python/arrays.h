// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <pybind11/numpy.h>

#include "apps/python/plain_array.h"
#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

// NumPy arrays as arguments and results. All functions throw std::invalid_argument, in Python
// ValueError, that names the argument, its shape and the expected one.

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A matrix with `num_cols` columns, and `num_rows` rows unless that is negative. A vector counts
/// as a matrix with one column. Its numbers are finite.
RowMajorMatrix MatrixArgument(pybind11::handle value, const std::string& name, int num_rows,
                              int num_cols);
/// A matrix with `num_cols` columns, the first of which are times in seconds. Its numbers need not
/// be finite.
RowMajorMatrix TimedRowsArgument(pybind11::handle value, const std::string& name, int num_cols);
/// A vector; any length if `size` is negative.
Eigen::VectorXd VectorArgument(pybind11::handle value, const std::string& name, int size);
/// A vector of `size` numbers, or one number for all.
Eigen::VectorXd PerRowArgument(pybind11::handle value, const std::string& name, int size);
/// A vector of whole numbers; any length if `size` is negative.
std::vector<int64_t> IdsArgument(pybind11::handle value, const std::string& name, int size);
/// A vector of truth values; all false if `value` is None.
std::vector<bool> FlagsArgument(pybind11::handle value, const std::string& name, int size);
/// A 4x4 matrix with an orthonormal rotation.
Rigid3 PoseArgument(pybind11::handle value, const std::string& name);
/// Poses as 4x4 matrices, shape (N, 4, 4).
std::vector<Rigid3> PosesArgument(pybind11::handle value, const std::string& name);

/// Numbers of the shape (rows, cols), or (rows,) if `cols` is negative, written to `to`. They need
/// not be finite: a solver rejects a step to where a cost function is nan or inf.
void CopyNumbers(pybind11::handle value, const std::string& name, pybind11::ssize_t rows,
                 pybind11::ssize_t cols, double* to);

/// An 8-bit grey image from (height, width) or RGB (height, width, 3). Grey images share the memory
/// of the array.
cv::Mat GrayArgument(pybind11::handle value, const std::string& name);
/// A mask (height, width) of type uint8, which shares the memory of the array.
cv::Mat MaskArgument(pybind11::handle value, const std::string& name);
/// A depth image in metres: float32 in metres, which shares the memory of the array, or uint16 with
/// `depth_scale` units per metre (None with float32). Masked elements are not measured.
cv::Mat DepthArgument(pybind11::handle value, pybind11::handle depth_scale,
                      const std::string& name);

/// The 4x4 matrix of a transform.
Eigen::Matrix<double, 4, 4, Eigen::RowMajor> PoseMatrix(const Rigid3& pose);
/// Rows "t tx ty tz qx qy qz qw", camera in world, as in trajectory files: w >= 0.
RowMajorMatrix TrajectoryRows(const std::vector<TimedPose>& poses);

// Arrays with one row per item of a vector; without items, of length 0 with the same type and
// number of columns.

/// A number or truth value of every item, shape (N,). `get`: a function or a member of the item.
template <typename T, typename Item, typename Get>
pybind11::array_t<T> Column(const std::vector<Item>& items, const Get& get) {
  pybind11::array_t<T> column(static_cast<pybind11::ssize_t>(items.size()));
  T* to = column.mutable_data();
  for (const Item& item : items) *to++ = std::invoke(get, item);
  return column;
}
/// The getter of a property: a member of all items in a vector of an object.
template <typename Object, typename Item, typename T>
auto ColumnGetter(std::vector<Item> Object::*items, T Item::*member) {
  return [items, member](const Object& self) { return Column<T>(self.*items, member); };
}
/// Shape (N, num_cols). `fill(item, row)` writes a row.
template <typename Item, typename Fill>
RowMajorMatrix Rows(const std::vector<Item>& items, int num_cols, const Fill& fill) {
  RowMajorMatrix rows(static_cast<Eigen::Index>(items.size()), num_cols);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) fill(items[i], rows.row(i));
  return rows;
}
/// Square matrices of the items, shape (N, size, size).
template <int size, typename Item, typename Get>
pybind11::array_t<double> Matrices(const std::vector<Item>& items, const Get& get) {
  using Matrix = Eigen::Matrix<double, size, size, Eigen::RowMajor>;
  const auto num_items = static_cast<pybind11::ssize_t>(items.size());
  pybind11::array_t<double> matrices(std::vector<pybind11::ssize_t>{num_items, size, size});
  double* to = matrices.mutable_data();
  for (const Item& item : items) {
    Eigen::Map<Matrix> matrix(to);
    matrix = get(item);
    to += size * size;
  }
  return matrices;
}
/// Writes the end points of a LineSegment2 or LineSegment3 to a row.
template <typename Segment, typename Row>
void FillEndPoints(const Segment& segment, Row row) {
  row << segment.start.transpose(), segment.end.transpose();
}

/// A read-only array of shape `shape` over memory that `owner` keeps alive.
template <typename T>
pybind11::array ArrayView(const T* data, const std::vector<pybind11::ssize_t>& shape,
                          const std::vector<pybind11::ssize_t>& strides, pybind11::handle owner) {
  pybind11::array_t<T> array(shape, strides, data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// A copy of an image with one channel.
template <typename T>
pybind11::array ImageArray(const cv::Mat& image) {
  const std::vector<pybind11::ssize_t> strides = {static_cast<pybind11::ssize_t>(image.step[0]),
                                                  sizeof(T)};
  return pybind11::array_t<T>({image.rows, image.cols}, strides, image.ptr<T>());
}

/// A Lens, the coefficients k1 k2 p1 p2 [k3], or None. Throws std::invalid_argument that names the
/// argument.
LensDistortion LensArgument(const pybind11::object& value, const std::string& name);

}  // namespace msc_vo
