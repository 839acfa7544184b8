// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/recording/window_json.h"

#include <nlohmann/json.hpp>

namespace msc_vo {

namespace {

using Json = nlohmann::ordered_json;

Json TermToJson(const TermSummary& term) {
  return {{"residual_blocks", term.num_residual_blocks},
          {"rejected", term.num_rejected},
          {"initial_cost", term.initial_cost},
          {"final_cost", term.final_cost}};
}

}  // namespace

std::string FormatWindowJson(const BundleAdjustmentSummary& summary, double milliseconds) {
  Json json;
  json["usable"] = summary.usable;
  json["message"] = summary.message;
  json["iterations"] = summary.num_iterations;
  json["initial_cost"] = summary.initial_cost;
  json["final_cost"] = summary.final_cost;
  json["behind_camera"] = summary.num_behind_camera;
  json["schur_structure"] = summary.schur_structure;
  json["terms"] = {{"point_reprojection", TermToJson(summary.point_reprojection)},
                   {"point_depth", TermToJson(summary.point_depth)},
                   {"line_reprojection", TermToJson(summary.line_reprojection)},
                   {"line_depth", TermToJson(summary.line_depth)},
                   {"line_endpoint_prior", TermToJson(summary.line_endpoint_prior)},
                   {"parallel", TermToJson(summary.parallel)},
                   {"perpendicular", TermToJson(summary.perpendicular)},
                   {"manhattan", TermToJson(summary.manhattan)},
                   {"pose_prior", TermToJson(summary.pose_prior)}};
  json["milliseconds"] = milliseconds;
  // The message of the solver need not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace msc_vo
