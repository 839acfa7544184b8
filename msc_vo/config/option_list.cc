// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/option_list.h"

#include <utility>

#include "msc_vo/odometry/option_lister.h"

namespace msc_vo {

namespace {

void ListCamera(CameraSettings* camera, OptionLister* list) {
  list->Add("preset", &camera->preset, "a built-in camera instead of the numbers below");
  list->Add("fx", &camera->fx, "pixels");
  list->Add("fy", &camera->fy, "pixels; negative where y points up (ICL-NUIM)");
  list->Add("cx", &camera->cx, "pixels");
  list->Add("cy", &camera->cy, "pixels");
  list->Add("width", &camera->width, "pixels; the size of the images if not given");
  list->Add("height", &camera->height, "pixels");
  list->Add("depth_scale", &camera->depth_scale, "raw depth units per metre");
  constexpr const char* kDistortion[] = {"k1", "k2", "p1", "p2", "k3"};
  for (size_t i = 0; i < camera->distortion.size(); ++i) {
    list->Add(kDistortion[i], &camera->distortion[i], "lens distortion, as in OpenCV");
  }
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

}  // namespace msc_vo
