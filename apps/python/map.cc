// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/map.h"

#include <map>
#include <memory>
#include <type_traits>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "msc_vo/map/window_selection.h"
#include "msc_vo/map_file/map_images.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

template <typename L>
void AddObservations(const Map& map, const L& landmark, WindowData* window) {
  for (const Observation& observation : landmark.observations) {
    const auto in_window =
        MakeObservation(*map.FindKeyframe(observation.keyframe), landmark, observation.feature);
    if constexpr (std::is_same_v<L, PointLandmark>) {
      window->point_observations.push_back(in_window);
    } else {
      window->line_observations.push_back(in_window);
    }
  }
}

std::map<KeyframeId, py::bytes> ReadImages(const py::object& file) {
  const std::string path = PathArgument(file);
  std::map<KeyframeId, std::string> jpegs;
  {
    const py::gil_scoped_release release;
    const MapImages images(path);
    for (const KeyframeId id : images.Keyframes()) jpegs.emplace(id, images.Read(id));
  }
  return {jpegs.begin(), jpegs.end()};
}

}  // namespace

PyMap CopyMap(const MapSnapshot& snapshot) {
  PyMap copy;
  if (snapshot.axes) copy.world_from_axes = snapshot.axes->world_from_axes;
  const Map& map = snapshot.map;
  for (const auto& [id, keyframe] : map.keyframes()) {
    copy.window.camera = keyframe.frame->camera;
    copy.window.keyframes.push_back({id, keyframe.cam_from_world, false});
    copy.timestamps.push_back(keyframe.frame->timestamp);
  }
  for (const auto& [id, point] : map.points()) {
    copy.window.points.push_back({id, point.position, false, point.noise});
    AddObservations(map, point, &copy.window);
  }
  for (const auto& [id, line] : map.lines()) {
    copy.window.lines.push_back({id, line.segment, false, line.noise, line.depth_offset});
    AddObservations(map, line, &copy.window);
  }
  return copy;
}

void BindMap(py::module_* module) {
  py::class_<PyMap>(*module, "Map",
                    "A copy of the map of an odometry: keyframes, landmarks and observations. Ids "
                    "are those of WindowContext and of later maps of the run.")
      .def_property_readonly(
          "window", [](const PyMap& self) { return std::make_shared<WindowData>(self.window); },
          "A WindowData with the keyframes, points, lines and their observations, for "
          "solve_window() (hold a keyframe fixed with WindowData.set_keyframe_fixed()) or "
          "window_covariance(), and with the arrays of all of them.")
      .def_property_readonly(
          "timestamps",
          [](const PyMap& self) {
            return py::array_t<double>(static_cast<py::ssize_t>(self.timestamps.size()),
                                       self.timestamps.data());
          },
          "(K,) seconds, of the keyframes.")
      .def_property_readonly(
          "world_from_axes",
          [](const PyMap& self) -> std::optional<Eigen::Matrix3d> {
            if (!self.world_from_axes) return std::nullopt;
            return self.world_from_axes->toRotationMatrix();
          },
          "3x3 rotation; None while no Manhattan axes are found.")
      .def("__repr__", [](const PyMap& self) {
        return FormatText("<Map: %zu keyframes, %zu points, %zu lines>",
                          self.window.keyframes.size(), self.window.points.size(),
                          self.window.lines.size());
      });
  module->def("map_images", &ReadImages, py::arg("file"),
              "The small images in a map file: a dict with the bytes of a JPEG file by id of the "
              "keyframe. RuntimeError if the file is no map, is damaged or in use.");
}

}  // namespace msc_vo
