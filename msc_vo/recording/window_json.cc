// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/recording/window_json.h"

#include <nlohmann/json.hpp>

namespace msc_vo {

std::string FormatWindowJson(const BundleAdjustmentSummary& summary, double milliseconds) {
  using Json = nlohmann::ordered_json;
  Json json = {{"usable", summary.usable},
               {"message", summary.message},
               {"iterations", summary.num_iterations},
               {"initial_cost", summary.initial_cost},
               {"final_cost", summary.final_cost},
               {"behind_camera", summary.num_behind_camera},
               {"undetermined_keyframes", summary.undetermined_keyframes},
               {"undetermined_points", summary.undetermined_points},
               {"undetermined_lines", summary.undetermined_lines},
               {"schur_structure", summary.schur_structure}};
  for (const auto& [name, term] : summary.Terms()) {
    json["terms"][name] = {{"residual_blocks", term->num_residual_blocks},
                           {"rejected", term->num_rejected},
                           {"initial_cost", term->initial_cost},
                           {"final_cost", term->final_cost}};
  }
  json["milliseconds"] = milliseconds;
  return json.dump(2) + "\n";
}

}  // namespace msc_vo
