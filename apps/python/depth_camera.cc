// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_camera.h"

#include <stdexcept>
#include <string>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/sensor/depth_registration.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

DepthCamera MakeDepthCamera(const PinholeCamera& camera, const py::object& depth_from_color,
                            const py::object& distortion, const py::object& inverse_depth_offset) {
  const DepthCamera depth_camera{camera, PoseArgument(depth_from_color, "depth_from_color"),
                                 NumberArgument(inverse_depth_offset, "inverse_depth_offset"),
                                 LensArgument(distortion, "distortion")};
  std::string error;
  if (!depth_camera.IsValid(&error)) throw std::invalid_argument(error);
  return depth_camera;
}

// A registration, and the size of the images that it takes.
class PyDepthRegistration {
 public:
  PyDepthRegistration(const DepthCamera& depth_camera, const PinholeCamera& camera,
                      const py::object& distortion)
      : depth_camera_(depth_camera.camera),
        registration_(depth_camera, camera, ValidLens(distortion, camera)) {}

  py::array Register(const py::object& value, const py::object& depth_scale) const {
    const cv::Mat depth = DepthArgument(value, depth_scale, "depth");
    if (depth.cols != depth_camera_.width || depth.rows != depth_camera_.height) {
      throw std::invalid_argument(FormatText("depth: image is %dx%d, depth camera is %dx%d",
                                             depth.cols, depth.rows, depth_camera_.width,
                                             depth_camera_.height));
    }
    cv::Mat registered;
    {
      const py::gil_scoped_release release;
      registered = registration_.Register(depth);
    }
    return ImageArray<float>(registered);
  }

 private:
  static LensDistortion ValidLens(const py::object& distortion, const PinholeCamera& camera) {
    const LensDistortion lens = LensArgument(distortion, "distortion");
    std::string error;
    if (!IsInvertible(lens, camera, &error)) throw std::invalid_argument(error);
    return lens;
  }

  PinholeCamera depth_camera_;
  DepthRegistration registration_;
};

}  // namespace

void BindDepthCamera(py::module_* module) {
  py::class_<DepthCamera>(*module, "DepthCamera",
                          "A depth camera beside the colour camera, for depth images that are not "
                          "registered to the colour images.")
      .def(py::init(&MakeDepthCamera), py::arg("camera"), py::arg("depth_from_color"),
           py::arg("distortion") = py::none(), py::arg("inverse_depth_offset") = 0.0,
           "camera: of the depth images. depth_from_color: 4x4, colour camera frame to depth "
           "camera frame, metres. distortion: k1 k2 p1 p2 [k3], or a Lens, of the depth images. "
           "inverse_depth_offset: 1/metres, is added to every inverse depth. Raises ValueError on "
           "impossible numbers.")
      .def_readonly("camera", &DepthCamera::camera, "Camera of the depth images.")
      .def_property_readonly(
          "depth_from_color",
          [](const DepthCamera& self) { return PoseMatrix(self.depth_from_color); },
          "4x4, colour camera frame to depth camera frame, metres.")
      .def_readonly("distortion", &DepthCamera::distortion, "Lens of the depth images.")
      .def_readonly("inverse_depth_offset", &DepthCamera::inverse_depth_offset,
                    "1/metres, is added to every measured inverse depth.")
      .def("__repr__", [](const DepthCamera& self) {
        return FormatText("<DepthCamera %dx%d, %.4g m from the colour camera>", self.camera.width,
                          self.camera.height, self.depth_from_color.translation().norm());
      });
  py::class_<PyDepthRegistration>(*module, "DepthRegistration",
                                  "Registers the images of a depth camera to those of a colour "
                                  "camera.")
      .def(py::init<const DepthCamera&, const PinholeCamera&, const py::object&>(),
           py::arg("depth_camera"), py::arg("camera"), py::arg("distortion") = py::none(),
           "camera, distortion: of the colour images, as for Odometry.")
      .def("register", &PyDepthRegistration::Register, py::arg("depth"), py::kw_only(),
           py::arg("depth_scale") = py::none(),
           "Depth (float32, metres, 0: none) of the pixels of the colour image. depth, "
           "depth_scale: as for Odometry.process(). May be called by several threads. Raises "
           "ValueError on an image that does not fit the depth camera.");
}

}  // namespace msc_vo
