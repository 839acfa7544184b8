// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/arrays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "msc_vo/datasets/calibration.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

std::string SizeText(int size, const char* any) { return size < 0 ? any : std::to_string(size); }

using DoubleArray = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Numbers as doubles in C order. Copies only if they are not.
DoubleArray Doubles(py::handle value, const std::string& name) {
  return DoubleArray::ensure(NumberArray(value, name));
}

DoubleArray FiniteDoubles(py::handle value, const std::string& name) {
  const DoubleArray doubles = Doubles(value, name);
  const double* begin = doubles.data();
  for (py::ssize_t i = 0; i < doubles.size(); ++i) {
    if (!std::isfinite(begin[i])) FailArgument(name, "contains a number that is not finite");
  }
  return doubles;
}

RowMajorMatrix MatrixOf(const DoubleArray& array, const std::string& name, int num_rows,
                        int num_cols) {
  const bool is_vector = array.ndim() == 1 && num_cols == 1;
  if (!(is_vector || array.ndim() == 2) || (!is_vector && array.shape(1) != num_cols) ||
      (num_rows >= 0 && array.shape(0) != num_rows)) {
    FailArgument(name, "expected shape (" + SizeText(num_rows, "N") + ", " +
                           std::to_string(num_cols) + "), not " + DescribeArray(array));
  }
  return Eigen::Map<const RowMajorMatrix>(array.data(), array.shape(0), num_cols);
}

// Images share memory with OpenCV, so that their rows must be contiguous.
void CheckImage(const py::array& array, const std::string& name) {
  if ((array.flags() & py::array::c_style) == 0) {
    FailArgument(name, "the array is not C-contiguous; pass numpy.ascontiguousarray(" + name + ")");
  }
  if (array.size() == 0) FailArgument(name, "the image is empty: " + DescribeArray(array));
}

bool HasType(const py::array& array, char kind, int bytes) {
  return array.dtype().kind() == kind && array.itemsize() == bytes;
}

std::string TypeText(const py::array& array) { return py::str(array.dtype()); }

py::array ByteArray(py::handle value, const std::string& name) {
  py::array array = PlainArray(value, name);
  if (!HasType(array, 'u', 1)) FailArgument(name, "must be uint8, is " + TypeText(array));
  return array;
}

// Refuses images with channels.
void CheckPlane(const py::array& array, const std::string& name) {
  if (array.ndim() == 2) return;
  FailArgument(name, "must be of shape (height, width), is " + DescribeArray(array));
}

// The pixels of the array, or a copy if `value` is something else, from which the array was made.
cv::Mat ImageOf(const py::array& array, py::handle value, int type) {
  // OpenCV has no read-only images; msc_vo does not write to its input.
  const cv::Mat image(static_cast<int>(array.shape(0)), static_cast<int>(array.shape(1)), type,
                      const_cast<void*>(array.data()));
  return array.is(value) ? image : image.clone();
}

}  // namespace

RowMajorMatrix MatrixArgument(py::handle value, const std::string& name, int num_rows,
                              int num_cols) {
  return MatrixOf(FiniteDoubles(value, name), name, num_rows, num_cols);
}

RowMajorMatrix TimedRowsArgument(py::handle value, const std::string& name, int num_cols) {
  const py::array array = NumberArray(value, name);
  RowMajorMatrix rows = MatrixOf(DoubleArray::ensure(array), name, -1, num_cols);
  CheckTimeType(array[py::make_tuple(py::ellipsis(), 0)], name);
  return rows;
}

Eigen::VectorXd VectorArgument(py::handle value, const std::string& name, int size) {
  const DoubleArray array = FiniteDoubles(value, name);
  if (array.ndim() != 1 || (size >= 0 && array.shape(0) != size)) {
    FailArgument(name,
                 "expected shape (" + SizeText(size, "N") + ",), not " + DescribeArray(array));
  }
  return Eigen::Map<const Eigen::VectorXd>(array.data(), array.shape(0));
}

Eigen::VectorXd PerRowArgument(py::handle value, const std::string& name, int size) {
  const DoubleArray array = FiniteDoubles(value, name);
  if (array.ndim() == 0) return Eigen::VectorXd::Constant(size, *array.data());
  return VectorArgument(value, name, size);
}

std::vector<int64_t> IdsArgument(py::handle value, const std::string& name, int size) {
  const py::array array = PlainArray(value, name);
  const bool is_empty = array.size() == 0;  // of which NumPy does not know that it holds integers
  if (!is_empty && array.dtype().kind() != 'i' && array.dtype().kind() != 'u') {
    FailArgument(name, "expected whole numbers, not " + DescribeArray(array));
  }
  if (array.ndim() != 1 || (size >= 0 && array.shape(0) != size)) {
    FailArgument(name,
                 "expected shape (" + SizeText(size, "N") + ",), not " + DescribeArray(array));
  }
  const auto ids = py::array_t<int64_t, py::array::c_style | py::array::forcecast>::ensure(array);
  const std::vector<int64_t> numbers(ids.data(), ids.data() + ids.size());
  const bool wraps = array.dtype().kind() == 'u' &&
                     std::any_of(numbers.begin(), numbers.end(), [](int64_t n) { return n < 0; });
  if (wraps) FailArgument(name, "contains a number that 64 bits with a sign cannot hold");
  return numbers;
}

std::vector<bool> FlagsArgument(py::handle value, const std::string& name, int size) {
  if (value.is_none()) return std::vector<bool>(size, false);
  const py::array array = PlainArray(value, name);
  if (array.ndim() != 1 || array.shape(0) != size || array.dtype().kind() != 'b') {
    FailArgument(name,
                 "expected " + std::to_string(size) + " truth values, not " + DescribeArray(array));
  }
  const auto flags = py::array_t<bool, py::array::c_style | py::array::forcecast>::ensure(array);
  return std::vector<bool>(flags.data(), flags.data() + flags.size());
}

Rigid3 PoseArgument(py::handle value, const std::string& name) {
  constexpr double kTolerance = 1e-6;
  const RowMajorMatrix matrix = MatrixArgument(value, name, 4, 4);
  const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();
  if ((matrix.row(3) - Eigen::RowVector4d(0, 0, 0, 1)).norm() > kTolerance) {
    FailArgument(name, "the last row of a pose must be 0 0 0 1");
  }
  if ((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm() > kTolerance ||
      rotation.determinant() < 0.0) {
    FailArgument(name, "the upper left 3x3 block must be a rotation, orthonormal to 1e-6");
  }
  return {Eigen::Quaterniond(rotation).normalized(), matrix.topRightCorner<3, 1>()};
}

std::vector<Rigid3> PosesArgument(py::handle value, const std::string& name) {
  const py::array array = PlainArray(value, name);
  if (array.ndim() != 3 || array.shape(1) != 4 || array.shape(2) != 4) {
    FailArgument(name, "expected shape (N, 4, 4), not " + DescribeArray(array));
  }
  std::vector<Rigid3> poses;
  for (py::ssize_t i = 0; i < array.shape(0); ++i) {
    poses.push_back(PoseArgument(array[py::int_(i)], name + "[" + std::to_string(i) + "]"));
  }
  return poses;
}

void CopyNumbers(py::handle value, const std::string& name, py::ssize_t rows, py::ssize_t cols,
                 double* to) {
  const DoubleArray array = Doubles(value, name);
  const bool fits = cols < 0
                        ? array.ndim() == 1 && array.shape(0) == rows
                        : array.ndim() == 2 && array.shape(0) == rows && array.shape(1) == cols;
  if (!fits) {
    FailArgument(name, "expected shape (" + std::to_string(rows) +
                           (cols < 0 ? "," : ", " + std::to_string(cols)) + "), not " +
                           DescribeArray(array));
  }
  std::copy_n(array.data(), array.size(), to);
}

cv::Mat GrayArgument(py::handle value, const std::string& name) {
  const py::array array = ByteArray(value, name);
  const bool is_rgb = array.ndim() == 3 && array.shape(2) == 3;
  if (!(array.ndim() == 2 || is_rgb)) {
    FailArgument(name, "must be of shape (height, width) or, RGB, (height, width, 3), is " +
                           DescribeArray(array));
  }
  CheckImage(array, name);
  if (!is_rgb) return ImageOf(array, value, CV_8UC1);
  cv::Mat gray;
  cv::cvtColor(ImageOf(array, value, CV_8UC3), gray, cv::COLOR_RGB2GRAY);
  return gray;
}

cv::Mat MaskArgument(py::handle value, const std::string& name) {
  const py::array array = ByteArray(value, name);
  CheckPlane(array, name);
  CheckImage(array, name);
  return ImageOf(array, value, CV_8UC1);
}

cv::Mat DepthArgument(py::handle value, py::handle depth_scale, const std::string& name) {
  const py::object filled = IsMasked(value) ? value.attr("filled")(0)  // not measured
                                            : py::reinterpret_borrow<py::object>(value);
  const py::array array = PlainArray(filled, name);
  const bool is_metric = HasType(array, 'f', 4);
  const bool is_raw = HasType(array, 'u', 2);
  if (!(is_metric || is_raw)) {
    FailArgument(name,
                 "must be float32 in metres, or uint16 with depth_scale, is " + TypeText(array));
  }
  CheckPlane(array, name);
  CheckImage(array, name);
  if (is_metric) {
    if (!depth_scale.is_none()) {
      FailArgument(name, "depth_scale is for uint16; float32 is in metres");
    }
    return ImageOf(array, value, CV_32FC1);
  }
  if (depth_scale.is_none()) {
    FailArgument(name, "uint16 needs depth_scale, the units per metre (such as 1000 or 5000)");
  }
  const double scale = NumberArgument(depth_scale, "depth_scale");
  std::string error;
  if (!IsValidDepthScale(scale, &error)) throw std::invalid_argument(error);
  const cv::Mat raw = ImageOf(array, value, CV_16UC1);
  cv::Mat metres;
  raw.convertTo(metres, CV_32F, 1.0 / scale);
  metres.setTo(0.0f, raw == std::numeric_limits<uint16_t>::max());  // no measurement
  return metres;
}

Eigen::Matrix<double, 4, 4, Eigen::RowMajor> PoseMatrix(const Rigid3& pose) {
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> matrix;
  matrix << pose.rotation().toRotationMatrix(), pose.translation(), 0.0, 0.0, 0.0, 1.0;
  return matrix;
}

RowMajorMatrix TrajectoryRows(const std::vector<TimedPose>& poses) {
  return Rows(poses, 8, [](const TimedPose& pose, auto row) {
    Eigen::Vector4d q = pose.world_from_cam.rotation().normalized().coeffs();
    if (q.w() < 0.0) q = -q;
    row << pose.timestamp, pose.world_from_cam.translation().transpose(), q.transpose();
  });
}

LensDistortion LensArgument(const pybind11::object& value, const std::string& name) {
  LensDistortion lens;
  if (value.is_none()) return lens;
  if (pybind11::isinstance<LensDistortion>(value)) return value.cast<LensDistortion>();
  const Eigen::VectorXd k = VectorArgument(value, name, -1);
  if (k.size() != 0 && k.size() != 4 && k.size() != 5) {
    throw std::invalid_argument(name + ": expected k1 k2 p1 p2 [k3] or a Lens, not " +
                                std::to_string(k.size()) + " numbers");
  }
  std::copy(k.begin(), k.end(), lens.k.begin());
  return lens;
}

}  // namespace msc_vo
