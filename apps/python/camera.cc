// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "msc_vo/camera/undistorted_camera.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

PinholeCamera MakeCamera(double fx, double fy, double cx, double cy, int width, int height) {
  const PinholeCamera camera{fx, fy, cx, cy, width, height};
  std::string error;
  if (!camera.IsValid(&error)) throw std::invalid_argument(error);
  return camera;
}

Eigen::Matrix3d IntrinsicMatrix(const PinholeCamera& camera) {
  Eigen::Matrix3d matrix;
  matrix << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  return matrix;
}

std::string DescribeCamera(const PinholeCamera& camera) {
  return FormatText("Camera(fx=%.10g, fy=%.10g, cx=%.10g, cy=%.10g, width=%d, height=%d)",
                    camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height);
}

LensDistortion MakeLens(const std::string& model, const py::object& coefficients) {
  const std::optional<LensModel> found = LensModelFromName(model);
  if (!found) {
    throw std::invalid_argument("Lens: unknown model '" + model + "'; known: " + LensModelNames());
  }
  const Eigen::VectorXd k = VectorArgument(coefficients, "coefficients", -1);
  const size_t expected = LensCoefficientNames(*found).size();
  if (static_cast<size_t>(k.size()) != expected) {
    throw std::invalid_argument("Lens: expected " + LensCoefficientList(*found) + " of the model " +
                                model + ", not " + std::to_string(k.size()) + " numbers");
  }
  LensDistortion lens;
  lens.model = *found;
  std::copy(k.begin(), k.end(), lens.k.begin());
  return lens;
}

std::string DescribeLens(const LensDistortion& lens) {
  std::string numbers;
  for (const double k : lens.Coefficients()) {
    numbers += FormatText("%s%.10g", numbers.empty() ? "" : ", ", k);
  }
  return "Lens('" + std::string(LensModelName(lens.model)) + "', [" + numbers + "])";
}

std::pair<PinholeCamera, LensDistortion> CroppedCamera(PinholeCamera camera, LensDistortion lens,
                                                       const std::optional<double>& field_of_view) {
  std::string error;
  if (field_of_view && !IsValidFieldOfView(*field_of_view, &error)) {
    throw std::invalid_argument(error);
  }
  camera = lens.Recorded(camera);
  CropToFieldOfView(field_of_view, &lens, &camera);
  return {camera, lens};
}

void BindLens(py::module_* module) {
  py::class_<LensDistortion>(*module, "Lens", "Lens distortion by one of OpenCV's models.")
      .def(py::init(&MakeLens), py::arg("model"), py::arg("coefficients"),
           "model: radial-tangential (k1 k2 p1 p2 k3), rational (k1 k2 p1 p2 k3 k4 k5 k6) or "
           "fisheye (k1 k2 k3 k4). Raises ValueError on another model or number of coefficients.")
      .def_property_readonly(
          "model", [](const LensDistortion& lens) { return LensModelName(lens.model); },
          "'radial-tangential', 'rational' or 'fisheye'.")
      .def_property_readonly("coefficients", &LensDistortion::Coefficients,
                             "Coefficients of the model.")
      .def_readonly("recorded", &LensDistortion::recorded,
                    "Camera of the recorded images, None if it is that of the undistorted ones.")
      .def("__repr__", &DescribeLens);
  module->def("undistorted_camera", &CroppedCamera, py::arg("camera"), py::arg("lens"),
              py::arg("field_of_view") = py::none(),
              "Returns (camera, lens) for Odometry from those of the recorded images: a fisheye "
              "lens, or one with a horizontal field_of_view (degrees), gets undistorted images of "
              "other intrinsics.");
}

}  // namespace

void BindCamera(py::module_* module) {
  py::class_<PinholeCamera>(*module, "Camera",
                            "A pinhole camera; all numbers in pixels, the centre of the upper left "
                            "pixel at (0, 0). fy may be negative (mirrored images).")
      .def(py::init(&MakeCamera), py::arg("fx"), py::arg("fy"), py::arg("cx"), py::arg("cy"),
           py::arg("width"), py::arg("height"), "Raises ValueError on impossible numbers.")
      .def_readonly("fx", &PinholeCamera::fx, "Horizontal focal length, pixels.")
      .def_readonly("fy", &PinholeCamera::fy, "Vertical focal length, pixels.")
      .def_readonly("cx", &PinholeCamera::cx, "Column of the principal point, pixels.")
      .def_readonly("cy", &PinholeCamera::cy, "Row of the principal point, pixels.")
      .def_readonly("width", &PinholeCamera::width, "Columns of the image.")
      .def_readonly("height", &PinholeCamera::height, "Rows of the image.")
      .def_property_readonly("matrix", &IntrinsicMatrix, "The 3x3 intrinsic matrix.")
      .def("__repr__", &DescribeCamera);
  BindLens(module);
}

}  // namespace msc_vo
