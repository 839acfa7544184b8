// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/summary_json.h"

#include <filesystem>
#include <type_traits>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/image_container.h"
#include "msc_vo/datasets/image_masks.h"
#include "msc_vo/results/calibration_json.h"
#include "msc_vo/results/internal/json_value.h"
#include "msc_vo/results/internal/run_json.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

Json DepthCameraToJson(const DepthCamera& depth_camera) {
  const Eigen::Vector3d t = depth_camera.depth_from_color.translation();
  const Eigen::Quaterniond q(depth_camera.depth_from_color.rotation());
  Json json = CameraToJson(depth_camera.camera);
  json["translation"] = {t.x(), t.y(), t.z()};
  json["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  json["inverse_depth_offset"] = depth_camera.inverse_depth_offset;
  return json;
}

Json CameraToJson(const Calibration& calibration) {
  Json json = {{"origin", calibration.origin}};
  json.update(CameraToJson(calibration.camera));
  json["depth_scale"] = calibration.depth_scale;
  json["distortion"] = calibration.distortion.Coefficients();
  const LensDistortion& lens = calibration.distortion;
  if (lens.model != LensModel::kRadialTangential || lens.recorded) {
    const PinholeCamera& recorded = calibration.Recorded();
    json["lens"] = LensModelName(lens.model);
    json["recorded"] = {
        {"fx", recorded.fx}, {"fy", recorded.fy}, {"cx", recorded.cx}, {"cy", recorded.cy}};
  }
  if (calibration.depth_camera) {
    json["depth_camera"] = DepthCameraToJson(*calibration.depth_camera);
  }
  return json;
}

// The options in effect, flat: {"tracking.wide_radius": 60.0}.
Json OptionsToJson(const Configuration& configuration) {
  OdometryOptions effective = EffectiveOptions(configuration.odometry);
  Json json = Json::object();
  for (const Option& option : ListOptions(&effective)) {
    std::visit(
        [&](const auto& value) {
          using Value = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<Value, bool*> || std::is_same_v<Value, int*> ||
                        std::is_same_v<Value, double*>) {
            json[option.path] = *value;
          } else {
            json[option.path] = FormatOption(option);
          }
        },
        option.value);
  }
  return json;
}

// How the images were read, apart from the camera; whoever reads them again does it alike.
Json ReadingToJson(const SequenceIndex& sequence) {
  const ImageMasks* masks = sequence.masks.get();
  return {
      {"color_is_reduced", sequence.scale_color},
      {"float_depth_scale", sequence.float_depth_scale},
      {"mask", masks == nullptr ? Json() : Json(std::filesystem::absolute(masks->path()).string())},
      {"mask_zero", masks != nullptr && masks->left_out() == ImageMasks::LeftOut::kZero},
      {"settings", sequence.container ? sequence.container->Settings() : ""}};
}

// Null if the images were not processed at the pace of their time stamps.
Json RealtimeToJson(const std::optional<RealtimeSummary>& realtime) {
  if (!realtime) return {};
  return {{"late_maps", realtime->num_late_maps}, {"pose_age_ms", ToJson(realtime->pose_age)}};
}

}  // namespace

std::string FormatSummaryJson(const RunSummary& summary, const RunContext& context) {
  Json json;
  json["version"] = kVersion;
  json["command_line"] = context.command_line;
  json["outcome"] = context.outcome;
  json["sequence"] = {
      {"directory", context.sequence.directory},
      {"format", context.sequence.format},
      {"recorder", context.sequence.recorder},
      {"reference", context.sequence.reference.empty() ? Json() : Json(context.sequence.reference)},
      {"images", context.sequence.entries.size()},
      {"reading", ReadingToJson(context.sequence)},
      {"warnings", context.sequence.warnings}};
  json["camera"] = CameraToJson(context.calibration);
  json["final_camera"] =
      Json::parse(FormatCalibrationJson(Corrected(context.calibration, summary.intrinsics)));
  json["first_unreadable_image"] =
      context.first_unreadable.empty() ? Json() : Json(context.first_unreadable);
  json["realtime"] = RealtimeToJson(context.realtime);
  json.update(MeasurementsToJson(summary, context.error, context.cost));
  json["readout_time_origin"] = context.calibration.readout_origin;
  json["options"] = OptionsToJson(context.configuration);
  return FormatJson(json);
}

}  // namespace msc_vo
