// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calibration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr char kCameraFileFormat[] = "'fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]'";

// Writes what the settings say over the calibration.
void Apply(const CameraSettings& settings, Calibration* calibration) {
  PinholeCamera& camera = calibration->camera;
  camera.fx = settings.fx.value_or(camera.fx);
  camera.fy = settings.fy.value_or(camera.fy);
  camera.cx = settings.cx.value_or(camera.cx);
  camera.cy = settings.cy.value_or(camera.cy);
  camera.width = settings.width.value_or(camera.width);
  camera.height = settings.height.value_or(camera.height);
  calibration->depth_scale = settings.depth_scale.value_or(calibration->depth_scale);
  for (size_t i = 0; i < settings.distortion.size(); ++i) {
    double& k = calibration->distortion.k[i];
    k = settings.distortion[i].value_or(k);
  }
}

bool IsComplete(const CameraSettings& settings) {
  return settings.fx && settings.fy && settings.cx && settings.cy && settings.depth_scale;
}

[[noreturn]] void FailWithoutCalibration(const SequenceIndex& index) {
  std::string names;
  for (const CameraPreset& preset : CameraPresets()) names += " " + preset.name;
  throw std::runtime_error(index.directory + ": the camera is not known. Do one of:\n" + "  add " +
                           index.directory + "/camera.txt with one line " + kCameraFileFormat +
                           "\n  give --config FILE with the camera's numbers\n" +
                           "  give --camera with one of:" + names);
}

// The calibration of the folder, with the readout time that is known of the camera that the name of
// the folder tells: no calibration file has one.
Calibration WithShutterByName(const SequenceIndex& index) {
  Calibration calibration = *index.calibration;
  const std::string name = GuessCameraPreset(index.directory);
  if (name.empty()) return calibration;
  calibration.readout_time = FindCameraPreset(name).calibration.readout_time;
  if (calibration.readout_time) {
    calibration.origin += ", shutter of " + name + " by the folder's name";
  }
  return calibration;
}

// What the settings are written over.
Calibration BaseCalibration(const CameraSettings& settings, const std::string& preset,
                            SequenceIndex* index) {
  if (!settings.preset.empty()) return FindCameraPreset(settings.preset).calibration;
  if (IsComplete(settings)) {  // nothing else may shine through, a distortion for instance
    Calibration blank;
    blank.camera.width = 0;  // to be filled in
    blank.camera.height = 0;
    return blank;
  }
  if (index->calibration) {
    if (!preset.empty()) {
      index->warnings.push_back("the camera preset " + preset + " is not used: " +
                                index->calibration->origin + " says what the camera is");
    }
    return WithShutterByName(*index);
  }
  if (!preset.empty()) return FindCameraPreset(preset).calibration;
  if (index->preset.empty()) FailWithoutCalibration(*index);
  Calibration guess = FindCameraPreset(index->preset).calibration;
  guess.origin += " (guessed from the folder)";
  return guess;
}

}  // namespace

bool Calibration::IsValid(std::string* error) const {
  if (!camera.IsValid(error)) return false;
  for (const double k : distortion.k) {
    if (!std::isfinite(k)) {
      *error = "camera: distortion coefficients must be finite numbers";
      return false;
    }
  }
  if (!(depth_scale > 0.0) || !std::isfinite(depth_scale)) {
    *error = "camera: depth_scale (raw depth units per metre) must be positive";
    return false;
  }
  return true;
}

bool CameraSettings::IsEmpty() const {
  return preset.empty() && !fx && !fy && !cx && !cy && !width && !height && !depth_scale &&
         std::none_of(distortion.begin(), distortion.end(),
                      [](const std::optional<double>& k) { return k.has_value(); });
}

Calibration ReadCameraFile(const std::string& path) {
  const std::vector<TextLine> lines = ReadTextLines(path);
  if (lines.empty()) {
    throw std::runtime_error(path + ": is empty; expected one line " + kCameraFileFormat);
  }
  const std::vector<double> v = ParseNumbers(lines.front());
  if (v.size() != 7 && v.size() != 12) {
    throw std::runtime_error(lines.front().Where() + ": expected 7 or 12 numbers " +
                             kCameraFileFormat + ", found " + std::to_string(v.size()));
  }
  Calibration calibration;
  calibration.camera = {v[0], v[1], v[2], v[3], static_cast<int>(v[4]), static_cast<int>(v[5])};
  calibration.depth_scale = v[6];
  for (size_t i = 7; i < v.size(); ++i) calibration.distortion.k[i - 7] = v[i];
  calibration.origin = path;
  std::string error;
  if (!calibration.IsValid(&error)) {
    throw std::runtime_error(lines.front().Where() + ": " + error + "; expected " +
                             kCameraFileFormat);
  }
  return calibration;
}

Calibration ResolveCalibration(const CameraSettings& settings, const std::string& preset,
                               SequenceIndex* index) {
  Calibration calibration = BaseCalibration(settings, preset, index);
  Apply(settings, &calibration);
  if (calibration.origin.empty()) {
    calibration.origin = settings.origin;
  } else if (!settings.IsEmpty()) {
    calibration.origin += ", " + settings.origin;
  }
  PinholeCamera& camera = calibration.camera;
  if (camera.width == 0 || camera.height == 0) {
    const ImageSize size = ReadImageSize(index->entries.front().depth_path);
    camera.width = size.width;
    camera.height = size.height;
  }
  std::string error;
  if (!calibration.IsValid(&error)) {
    throw std::runtime_error(calibration.origin + ": " + error);
  }
  return calibration;
}

}  // namespace msc_vo
