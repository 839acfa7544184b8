// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/option_list.h"

#include <iterator>
#include <utility>

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

Range AnyNumber(const std::string& unit) {
  Range range;
  range.unit = unit;
  return range;
}

constexpr char kWhenUnknown[] = "Set it if neither the sequence nor a preset gives it.";

void ListDistortion(LensSettings* lens, bool is_basic, OptionLister* list) {
  constexpr const char* kNames[] = {"k1", "k2", "p1", "p2", "k3"};
  for (size_t i = 0; i < std::size(kNames); ++i) {
    const bool tangential = kNames[i][0] == 'p';
    Option& option = list->Add(kNames[i], &lens->coefficients[i], AnyNumber(""),
                               std::string(tangential ? "Tangential" : "Radial") +
                                   " distortion coefficient of OpenCV's model.");
    if (is_basic) option.MakeBasic("Set it if the images are distorted.");
  }
}

void ListLens(LensSettings* lens, OptionLister* list) {
  list->Add("lens", &lens->model,
            "Model of the lens: radial-tangential (k1 k2 p1 p2 k3), rational (k1 k2 p1 p2 k3 k4 k5 "
            "k6) or fisheye (k1 k2 k3 k4), as OpenCV's; if not set, radial-tangential.");
  list->Add("k4", &lens->coefficients[5], AnyNumber(""),
            "Radial distortion coefficient of the rational and the fisheye model.");
  list->Add("k5", &lens->coefficients[6], AnyNumber(""),
            "Radial distortion coefficient of the rational model.");
  list->Add("k6", &lens->coefficients[7], AnyNumber(""),
            "Radial distortion coefficient of the rational model.");
}

void ListDepthCamera(DepthCameraSettings* camera, OptionLister* list) {
  list->Add("fx", &camera->fx, AnyNumber("pixels"),
            "Focal length in x of a depth camera whose images are not registered to colour.");
  list->Add("fy", &camera->fy, AnyNumber("pixels"), "Its focal length in y.");
  list->Add("cx", &camera->cx, AnyNumber("pixels"), "Its principal point in x.");
  list->Add("cy", &camera->cy, AnyNumber("pixels"), "Its principal point in y.");
  list->Add("width", &camera->width, AnyNumber("pixels"),
            "Width of the depth images; if not set, that of the first one.");
  list->Add("height", &camera->height, AnyNumber("pixels"),
            "Height of the depth images; if not set, that of the first one.");
  list->AddList("translation", &camera->translation, 3,
                "Translation of depth_from_color, metres; if not set, zero.");
  list->AddList("rotation", &camera->rotation, 4,
                "Rotation of depth_from_color, quaternion x y z w; if not set, none.");
  list->Add("inverse_depth_offset", &camera->inverse_depth_offset, AnyNumber("1/metres"),
            "Added to every measured inverse depth; if not set, 0.");
  ListDistortion(&camera->lens, false, list);
  ListLens(&camera->lens, list);
}

void ListCamera(CameraSettings* camera, OptionLister* list) {
  list->Add("preset", &camera->preset,
            "Name of a built-in camera (msc_vo replay --help lists them), instead of the numbers "
            "below.")
      .MakeBasic("Set it for recordings of that camera without calibration.");
  list->Add("fx", &camera->fx, AnyNumber("pixels"), "Focal length in x.").MakeBasic(kWhenUnknown);
  list->Add("fy", &camera->fy, AnyNumber("pixels"),
            "Focal length in y; negative if y points up, as in ICL-NUIM.")
      .MakeBasic(kWhenUnknown);
  list->Add("cx", &camera->cx, AnyNumber("pixels"), "Principal point in x.")
      .MakeBasic(kWhenUnknown);
  list->Add("cy", &camera->cy, AnyNumber("pixels"), "Principal point in y.")
      .MakeBasic(kWhenUnknown);
  list->Add("width", &camera->width, AnyNumber("pixels"),
            "Image width; if not set, that of the first image.")
      .MakeBasic("Set it to have the size of the images checked.");
  list->Add("height", &camera->height, AnyNumber("pixels"),
            "Image height; if not set, that of the first image.")
      .MakeBasic("Set it to have the size of the images checked.");
  list->Add("depth_scale", &camera->depth_scale, AnyNumber("per metre"),
            "Raw depth units per metre.")
      .MakeBasic(kWhenUnknown);
  ListDistortion(&camera->lens, true, list);
  ListLens(&camera->lens, list);
  list->Add("field_of_view", &camera->field_of_view, AnyNumber("degrees"),
            "Horizontal field of view of the undistorted images; if not set, that of the recorded "
            "images, for a fisheye lens at most 100.");
  list->Add(
      "max_width", &camera->max_width, Range{16.0, 16384.0, "pixels"},
      "Width to which wider colour images are reduced; if not set, 1280 for those with a depth "
      "camera or smaller depth images.");
  list->Add("float_depth_scale", &camera->float_depth_scale, Range{1e-3, 1e6, "per metre"},
            "Units per metre of depth images of floating-point numbers (TIFF, EXR); if not set, 1: "
            "metres.");
  list->Section("depth_camera", &camera->depth_camera, ListDepthCamera);
}

}  // namespace

std::vector<Option> ListOptions(Configuration* configuration) {
  OptionLister list;
  list.Section("camera", &configuration->camera, ListCamera);
  std::vector<Option> options = list.Take();
  for (Option& option : ListOptions(&configuration->odometry)) {
    options.push_back(std::move(option));
  }
  return options;
}

Configuration EffectiveConfiguration(Configuration configuration) {
  configuration.odometry = EffectiveOptions(configuration.odometry);
  return configuration;
}

}  // namespace msc_vo
