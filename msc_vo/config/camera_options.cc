// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/config/camera_options.h"

#include <cstring>
#include <stdexcept>
#include <vector>

#include "msc_vo/config/options_file.h"
#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Whether a file begins with a number, behind comments and blank lines.
bool IsCameraFile(const std::string& content) {
  bool is_comment = false;
  for (const char c : content) {
    if (c == '#') is_comment = true;
    if (c == '\n') is_comment = false;
    if (is_comment || std::strchr(" \t\r\n\v\f", c) != nullptr) continue;
    return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
  }
  return false;
}

}  // namespace

Configuration CameraConfiguration(const Calibration& calibration) {
  Configuration configuration;
  configuration.camera = SettingsOf(calibration);
  configuration.odometry.mapping.readout_time = calibration.readout_time;
  configuration.odometry.features.depth_sensor = calibration.depth_sensor;
  return configuration;
}

void ReadCamera(const std::string& path, Configuration* configuration) {
  Configuration read;
  if (IsCameraFile(ReadText(path, kMaxOptionsBytes))) {
    read = CameraConfiguration(ReadCameraFile(path));
  } else {
    ReadConfiguration(path, &read);
  }
  if (read.camera.IsEmpty()) {
    throw std::runtime_error(path +
                             ": describes no camera; give a file of calibrate --output, a "
                             "camera.txt, or the settings of ORB-SLAM2 or ORB-SLAM3");
  }
  configuration->camera = read.camera;
  const std::optional<double>& readout_time = read.odometry.mapping.readout_time;
  if (readout_time) configuration->odometry.mapping.readout_time = readout_time;
  const DepthSensor sensor = read.odometry.features.depth_sensor;
  if (sensor != DepthSensor::kAuto) configuration->odometry.features.depth_sensor = sensor;
}

std::string DescribeDifference(const Calibration& calibration, const Calibration& expected) {
  Configuration a = CameraConfiguration(calibration);
  Configuration b = CameraConfiguration(expected);
  const std::vector<Option> options_a = ListOptions(&a);
  const std::vector<Option> options_b = ListOptions(&b);
  const auto text = [](const std::string& value) { return value.empty() ? "unknown" : value; };
  for (size_t i = 0; i < options_a.size(); ++i) {
    const std::string value_a = FormatOption(options_a[i]);
    const std::string value_b = FormatOption(options_b[i]);
    if (value_a == value_b) continue;
    return options_a[i].path + " is " + text(value_a) + " instead of " + text(value_b);
  }
  return "";
}

}  // namespace msc_vo
