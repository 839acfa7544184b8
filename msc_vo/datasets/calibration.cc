// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/calibration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr char kCameraFileFormat[] = "'fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]'";
constexpr char kReadoutLineFormat[] = "'readout_time SECONDS'";
// Seconds: no camera takes longer for an image.
constexpr double kMaxReadoutTime = 1.0;

// Raw depth units per metre of 16-bit depth images: steps of 10 cm, and a range of 65 cm.
constexpr double kMinDepthScale = 10.0;
constexpr double kMaxDepthScale = 1e5;

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
    return *index->calibration;
  }
  if (!preset.empty()) return FindCameraPreset(preset).calibration;
  if (index->preset.empty()) FailWithoutCalibration(*index);
  Calibration guess = FindCameraPreset(index->preset).calibration;
  guess.origin += " (guessed from the folder)";
  guess.readout_time.reset();
  guess.readout_origin = Calibration::kReadoutLearnt;
  return guess;
}

// Reads the line of camera.txt that tells the readout time.
void ReadReadoutLine(const TextLine& line, Calibration* calibration) {
  std::optional<double> seconds;
  if (line.fields.size() == 2 && line.fields[0] == "readout_time") {
    seconds = ParseNumber(line.fields[1]);
  }
  if (!seconds) {
    throw std::runtime_error(line.Where() + ": expected " + kReadoutLineFormat +
                             " or nothing behind the line " + kCameraFileFormat);
  }
  calibration->readout_time = seconds;
  calibration->readout_origin = line.file;
  std::string error;
  if (!calibration->IsValid(&error)) throw std::runtime_error(line.Where() + ": " + error);
}

}  // namespace

bool Calibration::IsValid(std::string* error) const {
  if (!camera.IsValid(error)) return false;
  if (!IsInvertible(distortion, camera, error)) return false;
  if (!(depth_scale >= kMinDepthScale && depth_scale <= kMaxDepthScale)) {
    *error = "camera: depth_scale = " + FormatNumber(depth_scale) + " must be from " +
             FormatNumber(kMinDepthScale) + " to " + FormatNumber(kMaxDepthScale) +
             " raw depth units per metre";
    return false;
  }
  if (readout_time && !(std::abs(*readout_time) < kMaxReadoutTime)) {
    *error = "camera: readout_time (seconds from the first row to the last) must be less than 1";
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
  const std::optional<int> width = WholeNumber(v[4]);
  const std::optional<int> height = WholeNumber(v[5]);
  if (!width || !height) {
    throw std::runtime_error(lines.front().Where() +
                             ": width and height must be whole numbers; expected " +
                             kCameraFileFormat);
  }
  Calibration calibration;
  calibration.camera = {v[0], v[1], v[2], v[3], *width, *height};
  calibration.depth_scale = v[6];
  for (size_t i = 7; i < v.size(); ++i) calibration.distortion.k[i - 7] = v[i];
  calibration.origin = path;
  std::string error;
  if (!calibration.IsValid(&error)) {
    throw std::runtime_error(lines.front().Where() + ": " + error + "; expected " +
                             kCameraFileFormat);
  }
  if (lines.size() > 1) ReadReadoutLine(lines[1], &calibration);
  if (lines.size() > 2) throw std::runtime_error(lines[2].Where() + ": one line too many");
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
