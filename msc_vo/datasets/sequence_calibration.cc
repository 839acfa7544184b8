// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/sequence_calibration.h"

#include <stdexcept>

#include <opencv2/imgcodecs.hpp>

#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/datasets/camera_preset.h"
#include "msc_vo/datasets/image_container.h"
#include "msc_vo/datasets/image_file.h"

namespace msc_vo {

namespace {

// Overwrites the values that are set.
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
  const std::string file =
      index.container || index.camera
          ? ""
          : "  add " + index.directory + "/camera.txt with one line " + kCameraFileFormat + "\n";
  throw std::runtime_error(index.directory + ": the camera is not known. Do one of:\n" + file +
                           "  give --config FILE with the camera's calibration\n" +
                           "  give --camera with one of:" + names);
}

// The preset that the folder suggests, without readout time.
Calibration GuessedPreset(const std::string& name) {
  Calibration guess = FindCameraPreset(name).calibration;
  guess.origin += " (guessed from the folder)";
  guess.readout_time.reset();
  guess.readout_origin = Calibration::kSelfCalibrated;
  return guess;
}

// The calibration that the settings are applied to.
Calibration BaseCalibration(const CameraSettings& settings, const std::string& preset,
                            SequenceIndex* index) {
  if (!settings.preset.empty()) return FindCameraPreset(settings.preset).calibration;
  if (IsComplete(settings)) {  // no value of another source may remain, such as a distortion
    Calibration blank;
    blank.camera.width = 0;  // unknown
    blank.camera.height = 0;
    return blank;
  }
  if (index->calibration) {
    if (!preset.empty()) {
      index->warnings.push_back("the camera preset " + preset + " is not used, because " +
                                index->calibration->origin + " gives the calibration");
    }
    return *index->calibration;
  }
  if (!preset.empty()) return FindCameraPreset(preset).calibration;
  if (index->preset.empty()) FailWithoutCalibration(*index);
  return GuessedPreset(index->preset);
}

// Size of the first depth image.
ImageSize DepthSize(const SequenceIndex& index) {
  if (index.entries.empty()) {
    throw std::runtime_error(index.directory +
                             ": give the size of the images, camera.width and camera.height");
  }
  const SequenceEntry& first = index.entries.front();
  if (!index.container) return ReadImageSize(first.depth_path);
  const StoredImage stored = index.container->ReadDepth(first.depth_index);
  const cv::Mat image =
      stored.bytes.empty() ? stored.pixels : DecodeImage(stored.bytes, cv::IMREAD_UNCHANGED);
  return {image.cols, image.rows};
}

}  // namespace

Calibration ResolveCalibration(const CameraSettings& settings, const std::string& preset,
                               SequenceIndex* index) {
  Calibration calibration = BaseCalibration(settings, preset, index);
  if (index->depth_scale) calibration.depth_scale = *index->depth_scale;
  Apply(settings, &calibration);
  if (calibration.origin.empty()) {
    calibration.origin = settings.origin;
  } else if (!settings.IsEmpty()) {
    calibration.origin += ", " + settings.origin;
  }
  PinholeCamera& camera = calibration.camera;
  if (camera.width == 0 || camera.height == 0) {
    const ImageSize size = DepthSize(*index);
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
