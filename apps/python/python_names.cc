// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/python/python_names.h"

namespace msc_vo {

std::string PythonNames(std::string message) {
  constexpr const char* kNames[][2] = {
      {"RunMapping()", "run_mapping()"},
      {"SetMap()", "load_map()"},
      {"SetPoseFactors()", "set_pose_factors()"},
      {"SetTrackingObserver()", "set_tracking_observer()"},
      {"SetWindowFactors()", "set_window_factors()"},
      {"SetWindowObserver()", "set_window_observer()"},
      {"SkipClippedDepthSearch()", "skip_clipped_depth_search()"},
  };
  for (const auto& [name, python_name] : kNames) {
    const size_t at = message.find(name);
    if (at != std::string::npos) message.replace(at, std::string(name).size(), python_name);
  }
  return message;
}

}  // namespace msc_vo
