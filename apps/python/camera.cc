// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <stdexcept>
#include <string>

#include <pybind11/eigen.h>

#include "apps/python/bindings.h"
#include "msc_vo/camera/pinhole_camera.h"
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

Eigen::Matrix3d MatrixOf(const PinholeCamera& camera) {
  Eigen::Matrix3d matrix;
  matrix << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  return matrix;
}

std::string Describe(const PinholeCamera& camera) {
  return FormatText("Camera(fx=%.10g, fy=%.10g, cx=%.10g, cy=%.10g, width=%d, height=%d)",
                    camera.fx, camera.fy, camera.cx, camera.cy, camera.width, camera.height);
}

}  // namespace

void BindCamera(py::module_* module) {
  py::class_<PinholeCamera>(*module, "Camera",
                            "A pinhole camera; all numbers in pixels, the centre of the upper left "
                            "pixel at (0, 0). fy may be negative (mirrored images).")
      .def(py::init(&MakeCamera), py::arg("fx"), py::arg("fy"), py::arg("cx"), py::arg("cy"),
           py::arg("width"), py::arg("height"), "Raises ValueError on impossible numbers.")
      .def_readonly("fx", &PinholeCamera::fx)
      .def_readonly("fy", &PinholeCamera::fy)
      .def_readonly("cx", &PinholeCamera::cx)
      .def_readonly("cy", &PinholeCamera::cy)
      .def_readonly("width", &PinholeCamera::width)
      .def_readonly("height", &PinholeCamera::height)
      .def_property_readonly("matrix", &MatrixOf, "The 3x3 intrinsic matrix.")
      .def("__repr__", &Describe);
}

}  // namespace msc_vo
