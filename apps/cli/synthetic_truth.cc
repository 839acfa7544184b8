// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/synthetic_truth.h"

#include "apps/cli/synthesized_folder.h"
#include "apps/cli/usage_error.h"

namespace msc_vo {

namespace {

using Json = nlohmann::ordered_json;

Json IntrinsicsToJson(const PinholeCamera& camera) {
  return {{"fx", camera.fx}, {"fy", camera.fy},       {"cx", camera.cx},
          {"cy", camera.cy}, {"width", camera.width}, {"height", camera.height}};
}

Json DepthCameraToJson(const DepthCamera& depth_camera) {
  const Eigen::Vector3d t = depth_camera.depth_from_color.translation();
  const Eigen::Quaterniond q(depth_camera.depth_from_color.rotation());
  Json json = IntrinsicsToJson(depth_camera.camera);
  json["translation"] = {t.x(), t.y(), t.z()};
  json["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  return json;
}

}  // namespace

Calibration TrueCalibration(const SyntheticSequenceOptions& options,
                            const SyntheticSequence& sequence) {
  Calibration calibration;
  calibration.camera = sequence.camera();
  calibration.distortion = options.lens;
  calibration.depth_scale = kRenderedDepthScale * options.depth_factor;
  calibration.readout_time = options.readout_time;
  if (options.depth_rig) {
    calibration.depth_camera =
        DepthCamera{sequence.depth_camera(), options.depth_rig->depth_from_color};
  }
  return calibration;
}

Calibration GivenCalibration(const SynthesizeArguments& arguments, const Calibration& truth) {
  Calibration given = truth;
  given.depth_scale = kRenderedDepthScale;
  given.readout_time.reset();
  if (arguments.untold) {
    given.distortion = {};
    given.depth_camera.reset();
  }
  const double focal_length_ratio = 1.0 + arguments.focal_length_error / 100.0;
  given.camera.fx *= focal_length_ratio;
  given.camera.fy *= focal_length_ratio;
  if (!arguments.principal_point_error.empty()) {
    given.camera.cx += arguments.principal_point_error[0];
    given.camera.cy += arguments.principal_point_error[1];
  }
  given.SetUndistorted();
  std::string error;
  if (!given.IsValid(&error)) {
    throw UsageError("the errors of camera.txt are too large: " + error);
  }
  return given;
}

nlohmann::ordered_json CalibrationToJson(const Calibration& calibration) {
  Json json = IntrinsicsToJson(calibration.Recorded());
  json["lens"] = LensModelName(calibration.distortion.model);
  json["distortion"] = calibration.distortion.Coefficients();
  json["depth_scale"] = calibration.depth_scale;
  json["readout_time"] = calibration.readout_time ? Json(*calibration.readout_time) : Json();
  json["depth_camera"] =
      calibration.depth_camera ? DepthCameraToJson(*calibration.depth_camera) : Json();
  return json;
}

std::string FormatTruthJson(const SynthesizeArguments& arguments,
                            const SyntheticSequenceOptions& options, const Calibration& truth,
                            const Calibration& given) {
  const bool is_time_of_flight = options.depth == SyntheticDepth::kTimeOfFlight;
  const Eigen::Vector2d offset = options.depth == SyntheticDepth::kIclNuim
                                     ? options.icl_nuim.lateral_offset
                                     : Eigen::Vector2d::Zero();
  const Json json = {{"scene", arguments.scene},
                     {"seed", options.seed},
                     {"path", options.walk.path},
                     {"returns", options.walk.returns},
                     {"specular", arguments.specular},
                     {"camera", CalibrationToJson(truth)},
                     {"given", CalibrationToJson(given)},
                     {"depth_sensor", ToString(options.depth)},
                     {"depth_delay", options.depth_delay},
                     {"depth_bias", is_time_of_flight ? options.time_of_flight.bias : 0.0},
                     {"depth_offset", {offset.x(), offset.y()}},
                     {"image_sigma", options.image_sigma},
                     {"light", options.light ? Json(*options.light) : Json()},
                     {"hunting_exposure", options.hunting_exposure},
                     {"motion_blur", options.motion_blur},
                     {kSynthesizedOptions, arguments.values}};
  return json.dump(2) + "\n";
}

}  // namespace msc_vo
