// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/calibration_json.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

#include "msc_vo/results/internal/json_value.h"

namespace msc_vo {

namespace {

PinholeCamera CameraFromJson(const Json& json) {
  PinholeCamera camera;
  camera.fx = json.at("fx");
  camera.fy = json.at("fy");
  camera.cx = json.at("cx");
  camera.cy = json.at("cy");
  camera.width = json.at("width");
  camera.height = json.at("height");
  return camera;
}

void AddLens(const LensDistortion& lens, Json* json) {
  (*json)["lens"] = LensModelName(lens.model);
  (*json)["distortion"] = lens.Coefficients();
  if (lens.recorded) (*json)["recorded"] = CameraToJson(*lens.recorded);
}

LensDistortion LensFromJson(const Json& json) {
  LensDistortion lens;
  const std::string name = json.at("lens");
  const std::optional<LensModel> model = LensModelFromName(name);
  if (!model) throw std::runtime_error("lens: '" + name + "' is none of " + LensModelNames());
  lens.model = *model;
  const std::vector<double> k = json.at("distortion");
  if (k.size() != LensCoefficientNames(*model).size()) {
    throw std::runtime_error("distortion: " + LensCoefficientList(*model) + " expected");
  }
  std::copy(k.begin(), k.end(), lens.k.begin());
  if (json.contains("recorded")) lens.recorded = CameraFromJson(json["recorded"]);
  return lens;
}

Json DepthCameraToJson(const DepthCamera& depth_camera) {
  const auto& params = depth_camera.depth_from_color.params;
  Json json = CameraToJson(depth_camera.camera);
  AddLens(depth_camera.distortion, &json);
  json["translation"] = {params[4], params[5], params[6]};
  json["rotation"] = {params[0], params[1], params[2], params[3]};
  json["inverse_depth_offset"] = depth_camera.inverse_depth_offset;
  return json;
}

DepthCamera DepthCameraFromJson(const Json& json) {
  DepthCamera depth_camera;
  depth_camera.camera = CameraFromJson(json);
  depth_camera.distortion = LensFromJson(json);
  const std::vector<double> translation = json.at("translation"), rotation = json.at("rotation");
  if (translation.size() != 3 || rotation.size() != 4) {
    throw std::runtime_error("depth_camera: translation x y z and rotation x y z w expected");
  }
  depth_camera.depth_from_color.params << rotation[0], rotation[1], rotation[2], rotation[3],
      translation[0], translation[1], translation[2];
  depth_camera.inverse_depth_offset = json.at("inverse_depth_offset");
  return depth_camera;
}

}  // namespace

std::string FormatCalibrationJson(const Calibration& calibration) {
  Json json = CameraToJson(calibration.camera);
  AddLens(calibration.distortion, &json);
  json["depth_scale"] = calibration.depth_scale;
  if (calibration.depth_camera) {
    json["depth_camera"] = DepthCameraToJson(*calibration.depth_camera);
  }
  return json.dump();
}

Calibration ParseCalibrationJson(const std::string& text) {
  Calibration calibration;
  try {
    const Json json = Json::parse(text);
    calibration.camera = CameraFromJson(json);
    calibration.distortion = LensFromJson(json);
    calibration.depth_scale = json.at("depth_scale");
    if (json.contains("depth_camera")) {
      calibration.depth_camera = DepthCameraFromJson(json["depth_camera"]);
    }
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(error.what());
  }
  std::string problem;
  if (!calibration.IsValid(&problem)) throw std::runtime_error(problem);
  return calibration;
}

}  // namespace msc_vo
