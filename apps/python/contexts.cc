// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/contexts.h"

#include <vector>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "apps/python/arrays.h"

namespace msc_vo {

namespace py = pybind11;

namespace {

py::dict BlockValues(const std::vector<ExtraBlock>& blocks) {
  py::dict values;
  for (const ExtraBlock& block : blocks) values[py::int_(block.id)] = block.value;
  return values;
}

}  // namespace

void BindContexts(py::module_* module) {
  py::class_<WindowContext::Keyframe>(*module, "WindowKeyframe", "A keyframe of a WindowContext.")
      .def_readonly("id", &WindowContext::Keyframe::id, "Id for BlockId.pose().")
      .def_readonly("timestamp", &WindowContext::Keyframe::timestamp, "Seconds.")
      .def_readonly("fixed", &WindowContext::Keyframe::fixed,
                    "Whether the pose is held constant in this window.")
      .def_property_readonly(
          "cam_from_world",
          [](const WindowContext::Keyframe& self) { return PoseMatrix(self.cam_from_world); },
          "4x4.");
  py::class_<PyWindowContext, std::shared_ptr<PyWindowContext>>(
      *module, "WindowContext", "A window before its local bundle adjustment.")
      .def_property_readonly(
          "keyframes", [](const PyWindowContext& self) { return self.context.keyframes; },
          "In order of time.")
      .def_property_readonly(
          "world", [](const PyWindowContext& self) { return self.context.world; },
          "Number of the world of the poses.")
      .def_property_readonly(
          "world_from_axes",
          [](const PyWindowContext& self) -> std::optional<Eigen::Matrix3d> {
            if (!self.context.world_from_axes) return std::nullopt;
            return self.context.world_from_axes->toRotationMatrix();
          },
          "3x3 rotation, the block BlockId.axes(); None while no Manhattan axes are found.")
      .def_property_readonly(
          "extra_blocks",
          [](const PyWindowContext& self) { return BlockValues(self.context.extra_blocks); },
          "Present values of the extra blocks by id.")
      .def_property_readonly(
          "data", &PyWindowContext::Data,
          "WindowData with the points and lines of the window and their observations, a copy. "
          "Factors may use the ids of any of them. Raises RuntimeError after the callback, unless "
          "it was asked for before.");
  py::class_<FrameContext>(*module, "FrameContext", "A frame before its pose is estimated.")
      .def_readonly("timestamp", &FrameContext::timestamp, "Seconds.")
      .def_readonly("last_timestamp", &FrameContext::last_timestamp,
                    "Of the last frame whose pose was estimated from its image.")
      .def_property_readonly(
          "last_cam_from_world",
          [](const FrameContext& self) { return PoseMatrix(self.last_cam_from_world); },
          "4x4, the pose at last_timestamp.")
      .def_property_readonly(
          "predicted_cam_from_world",
          [](const FrameContext& self) { return PoseMatrix(self.predicted_cam_from_world); },
          "4x4, by constant velocity.")
      .def_readonly("world", &FrameContext::world, "Number of the world of the poses.")
      .def_property_readonly(
          "extra_blocks", [](const FrameContext& self) { return BlockValues(self.extra_blocks); },
          "Values of the extra blocks by id, as estimated in the map that the frame is tracked "
          "in.");
}

}  // namespace msc_vo
