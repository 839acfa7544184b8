// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <dlfcn.h>
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/modules/module_function.h"
#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/video/video_file.h"
#include "msc_vo/config/options_file.h"
#include "msc_vo/datasets/clipped_depth_search.h"
#include "msc_vo/datasets/image_masks.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/phone_recordings/folder_sequence.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

// The module for videos lies beside this one, whose libraries only recordings with a video need.
std::unique_ptr<VideoReader> LoadVideoReader() {
  Dl_info own = {};
  dladdr(reinterpret_cast<void*>(&LoadVideoReader), &own);
  const std::filesystem::path file = own.dli_fname == nullptr ? "" : own.dli_fname;
  const auto make = reinterpret_cast<MakeVideoReaderOfModule>(
      LoadModuleFunction({file.parent_path()}, kVideoModule, kMakeVideoReader,
                         "install the Python package msc_vo completely"));
  return std::unique_ptr<VideoReader>(make());
}

RgbdDecoder Open(const py::object& directory, const std::string& format, const std::string& camera,
                 const py::object& config, const py::object& mask, bool mask_zero) {
  const std::string folder = PathArgument(directory);
  const std::string config_file = config.is_none() ? "" : PathArgument(config);
  const std::string masks = mask.is_none() ? "" : PathArgument(mask);
  const py::gil_scoped_release release;
  Configuration configuration;
  if (!config_file.empty()) ReadConfiguration(config_file, &configuration);
  SequenceIndex index =
      OpenFolder(folder, format, {PhoneOptions().least_confidence, LoadVideoReader});
  Calibration calibration = ResolveCalibration(configuration.camera, camera, &index);
  index.clipped_depth = FindClippedDepth(index);
  index.masks = OpenMasks(masks, mask_zero, index);
  return {std::move(index), std::move(calibration)};
}

RgbdImage ImageAt(const RgbdDecoder& sequence, int index) {
  if (index < 0) index += sequence.size();
  if (index < 0 || index >= sequence.size()) throw py::index_error("image index out of range");
  const py::gil_scoped_release release;
  return sequence.Decode(index);
}

py::array GrayOf(const py::object& self) {
  const cv::Mat& gray = self.cast<const RgbdImage&>().gray;
  return ArrayView(gray.ptr<uint8_t>(), {gray.rows, gray.cols},
                   {static_cast<py::ssize_t>(gray.step[0]), 1}, self);
}

py::array DepthOf(const py::object& self) {
  const cv::Mat& depth = self.cast<const RgbdImage&>().depth;
  return ArrayView(depth.ptr<float>(), {depth.rows, depth.cols},
                   {static_cast<py::ssize_t>(depth.step[0]), sizeof(float)}, self);
}

py::object MaskOf(const py::object& self) {
  const cv::Mat& mask = self.cast<const RgbdImage&>().mask;
  if (mask.empty()) return py::none();
  return ArrayView(mask.ptr<uint8_t>(), {mask.rows, mask.cols},
                   {static_cast<py::ssize_t>(mask.step[0]), 1}, self);
}

py::array_t<double> StampsOf(const RgbdDecoder& sequence) {
  return Column<double>(sequence.index().entries, &SequenceEntry::timestamp);
}

void BindImage(py::module_* module) {
  py::class_<RgbdImage, std::shared_ptr<RgbdImage>>(*module, "RgbdImage",
                                                    "A decoded image of a sequence.")
      .def_readonly("id", &RgbdImage::id, "Position in the sequence, from 0.")
      .def_readonly("timestamp", &RgbdImage::timestamp, "Seconds, of the colour image.")
      .def_readonly("depth_delay", &RgbdImage::depth_delay,
                    "Seconds from the colour image to the depth image.")
      .def_property_readonly("gray", &GrayOf, "(height, width) uint8, read-only, not a copy.")
      .def_property_readonly("depth", &DepthOf,
                             "(height, width) float32, metres, 0: not measured; read-only, not a "
                             "copy.")
      .def_property_readonly("mask", &MaskOf,
                             "(height, width) uint8, not 0: left out; read-only, not a copy. None: "
                             "all pixels are used.");
}

using SequenceClass = py::class_<RgbdDecoder>;

// Colour and depth camera of a sequence.
void BindSensors(SequenceClass* sequence) {
  (*sequence)
      .def_property_readonly(
          "camera", [](const RgbdDecoder& self) { return self.calibration().camera; },
          "Camera of the undistorted images.")
      .def_property_readonly(
          "depth_camera", [](const RgbdDecoder& self) { return self.calibration().depth_camera; },
          "DepthCamera of the recorded depth images, which sequence[i] has registered; None if "
          "they are recorded as registered.")
      .def_property_readonly(
          "distortion",
          [](const RgbdDecoder& self) { return self.calibration().distortion.Coefficients(); },
          "Coefficients of the lens: k1, k2, p1, p2, k3, unless the lens is of another model.")
      .def_property_readonly(
          "lens", [](const RgbdDecoder& self) { return self.calibration().distortion; },
          "Lens of the images.")
      .def_property_readonly(
          "depth_scale", [](const RgbdDecoder& self) { return self.calibration().depth_scale; },
          "Raw depth units per metre.")
      .def_property_readonly(
          "depth_sensor",
          [](const RgbdDecoder& self) { return ToString(self.index().GivenDepthSensor()); },
          "Name of the depth sensor that the sequence gives, for the option "
          "features.depth_sensor; 'auto' if it gives none.")
      .def_property_readonly(
          "readout_time", [](const RgbdDecoder& self) { return self.calibration().readout_time; },
          "Seconds from the first row to the last, 0: global shutter, None: unknown.");
}

}  // namespace

void BindSequence(py::module_* module) {
  BindImage(module);
  SequenceClass sequence(*module, "Sequence",
                         "A folder with RGB-D images in one of the layouts of docs/usage.md. "
                         "sequence[i] decodes image i and raises UnreadableImage if it is missing "
                         "or damaged.");
  BindSensors(&sequence);
  sequence
      .def(py::init(&Open), py::arg("directory"), py::arg("format") = "auto",
           py::arg("camera") = "", py::arg("config") = py::none(), py::arg("mask") = py::none(),
           py::arg("mask_zero") = false,
           "format, camera, config, mask, mask_zero: as --format, --camera, --config, --mask and "
           "--mask-zero of `msc_vo replay`. Raises RuntimeError naming file, line and fix.")
      .def("__len__", &RgbdDecoder::size)
      .def("__getitem__", &ImageAt, py::arg("index"))
      .def("__iter__",
           [](const py::object& self) {
             return py::reinterpret_steal<py::object>(PySeqIter_New(self.ptr()));  // by __getitem__
           })
      .def_property_readonly("timestamps", &StampsOf, "(N,) seconds, of the colour images.")
      .def_property_readonly(
          "groundtruth",
          [](const RgbdDecoder& self) { return TrajectoryRows(self.index().ground_truth); },
          "(N, 8) rows t tx ty tz qx qy qz qw; no rows without ground truth.")
      .def_property_readonly(
          "directory", [](const RgbdDecoder& self) { return SystemText(self.index().directory); },
          "The folder.")
      .def_property_readonly(
          "format", [](const RgbdDecoder& self) { return self.index().format; },
          "Name of its layout, see --format of `msc_vo replay`.")
      .def_property_readonly(
          "warnings",
          [](const RgbdDecoder& self) {
            py::list texts;
            for (const std::string& warning : self.Warnings()) texts.append(SystemText(warning));
            return texts;
          },
          "What is doubtful about the sequence.")
      .def("__repr__", [](const RgbdDecoder& self) {
        return SystemText("<Sequence '" + self.index().directory +
                          "': " + std::to_string(self.size()) + " images>");
      });
}

}  // namespace msc_vo
