// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_preset.h"

#include <filesystem>
#include <optional>
#include <regex>
#include <stdexcept>
#include <system_error>

#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

CameraPreset Preset(const std::string& name, const PinholeCamera& camera, double depth_scale,
                    const LensDistortion& distortion = {},
                    const std::optional<double>& readout_time = {}) {
  const std::string origin = "preset " + name;
  const std::string readout_origin = readout_time ? origin : Calibration::kSelfCalibrated;
  return {name, {camera, distortion, depth_scale, readout_time, readout_origin, origin}};
}

// Adds a depth camera with axes parallel to those of the colour camera.
CameraPreset WithDepthCamera(CameraPreset preset, const PinholeCamera& camera,
                             const Eigen::Vector3d& translation) {
  preset.calibration.depth_camera = {camera, {Eigen::Quaterniond::Identity(), translation}};
  return preset;
}

// Readout time of a Kinect's colour camera, seconds. Chosen by measurement, see
// docs/lab/rolling_shutter.md.
constexpr double kKinectReadout = 0.026;
constexpr double kGlobalShutter = 0.0;

// The name of a folder or file, also if the path is "." or ends with "/".
std::string NameOf(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;  // set if the working directory was deleted
  const fs::path absolute = fs::absolute(path, error).lexically_normal();
  if (error) return fs::path(path).filename().string();
  return (absolute.has_filename() ? absolute : absolute.parent_path()).filename().string();
}

}  // namespace

const std::vector<CameraPreset>& CameraPresets() {
  static const std::vector<CameraPreset>* const presets = new std::vector<CameraPreset>{
      // TUM RGB-D, published calibration. The depth scale of freiburg2 is 5208, as in published
      // evaluations; with 5000 the trajectory would be 4 % too large.
      Preset("tum-fr1", {517.306408, 516.469215, 318.643040, 255.313989, 640, 480}, 5000.0,
             {{0.262383, -0.953104, -0.005358, 0.002628, 1.163314}}, kKinectReadout),
      Preset("tum-fr2", {520.908620, 521.007327, 325.141442, 249.701764, 640, 480}, 5208.0,
             {{0.231222, -0.784899, -0.003257, -0.000105, 0.917205}}, kKinectReadout),
      // The images of freiburg3 are undistorted.
      Preset("tum-fr3", {535.4, 539.2, 320.1, 247.6, 640, 480}, 5000.0),
      // The images are mirrored: y points up.
      Preset("icl-nuim", {481.20, -480.00, 319.50, 239.50, 640, 480}, 5000.0, {}, kGlobalShutter),
      Preset("7-scenes", {585.0, 585.0, 320.0, 240.0, 640, 480}, 1000.0, {}, kKinectReadout),
      // The same with the colour camera of a first-generation structured-light camera 25 mm beside
      // the depth camera; nominal.
      WithDepthCamera(Preset("7-scenes-unregistered", {525.0, 525.0, 320.0, 240.0, 640, 480},
                             1000.0, {}, kKinectReadout),
                      {585.0, 585.0, 320.0, 240.0, 640, 480}, {0.025, 0.0, 0.0}),
      Preset("replica", {600.0, 600.0, 599.5, 339.5, 1200, 680}, 6553.5, {}, kGlobalShutter),
  };
  return *presets;
}

const CameraPreset& FindCameraPreset(const std::string& name) {
  std::string names;
  for (const CameraPreset& preset : CameraPresets()) {
    if (preset.name == name) return preset;
    names += (names.empty() ? "" : ", ") + preset.name;
  }
  throw std::invalid_argument("unknown camera preset '" + name + "'; known: " + names);
}

std::string GuessCameraPreset(const std::string& directory) {
  // "freiburg1_desk", "fr1", "fr1_desk" or, with the first word of a sequence of TUM, "fr1desk",
  // but neither "fr10_lab" nor "fr3nch_flat" nor "uni_freiburg1_lab".
  static const std::regex kPattern(
      ".*rgbd_dataset_freiburg([123])_.*|(?:freiburg|fr)([123])(?:|[^a-z0-9].*|"
      "(?:desk|xyz|rpy|room|360|floor|plant|teddy|office|long|large|walking|sitting|struct|"
      "nostruct).*)");
  const std::string name = Lowercase(NameOf(directory));
  std::smatch match;
  if (!std::regex_match(name, match, kPattern)) return "";
  return "tum-fr" + match.str(1) + match.str(2);
}

bool HasPublishedName(const std::string& directory) {
  static const std::regex kTum("rgbd_dataset_freiburg[123]_.*");
  static const std::regex kScene("chess|fire|heads|office|pumpkin|redkitchen|stairs");
  static const std::regex kSequence("seq-[0-9]{2}");
  const std::string name = Lowercase(NameOf(directory));
  const std::string scene = Lowercase(NameOf(directory + "/.."));
  return std::regex_match(name, kTum) ||
         (std::regex_match(name, kSequence) && std::regex_match(scene, kScene));
}

}  // namespace msc_vo
