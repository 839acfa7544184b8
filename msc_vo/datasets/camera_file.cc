// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/camera_file.h"

#include <optional>
#include <stdexcept>
#include <vector>

#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Reads the line of the intrinsics.
Calibration ParseIntrinsicsLine(const TextLine& line) {
  const std::vector<double> v = ParseNumbers(line);
  if (v.size() != 7 && v.size() != 12) {
    line.Fail(std::string("expected 7 or 12 numbers ") + kCameraFileFormat + ", found " +
              std::to_string(v.size()));
  }
  const std::optional<int> width = WholeNumber(v[4]);
  const std::optional<int> height = WholeNumber(v[5]);
  if (!width || !height) {
    line.Fail(std::string("width and height must be whole numbers; expected ") + kCameraFileFormat);
  }
  Calibration calibration;
  calibration.camera = {v[0], v[1], v[2], v[3], *width, *height};
  calibration.depth_scale = v[6];
  for (size_t i = 7; i < v.size(); ++i) calibration.distortion.k[i - 7] = v[i];
  calibration.origin = line.file;
  std::string error;
  if (!calibration.IsValid(&error)) line.Fail(error + "; expected " + kCameraFileFormat);
  return calibration;
}

// Reads the line of the readout time.
void ParseReadoutLine(const TextLine& line, Calibration* calibration) {
  std::optional<double> seconds;
  if (line.fields.size() == 2) seconds = ParseNumber(line.fields[1]);
  if (!seconds) line.Fail("expected 'readout_time SECONDS'");
  calibration->readout_time = seconds;
  calibration->readout_origin = line.file;
}

// Reads the line of the depth camera.
void ParseDepthCameraLine(TextLine line, Calibration* calibration) {
  line.fields.erase(line.fields.begin());
  const std::vector<double> v = ParseNumbers(line);
  if (v.size() != 9 && v.size() != 13) {
    line.Fail(std::string("expected 9 or 13 numbers in ") + kDepthCameraFormat + ", found " +
              std::to_string(v.size()));
  }
  const std::optional<int> width = WholeNumber(v[4]);
  const std::optional<int> height = WholeNumber(v[5]);
  if (!width || !height) {
    line.Fail(std::string("width and height must be whole numbers; expected ") +
              kDepthCameraFormat);
  }
  DepthCamera depth_camera;
  depth_camera.camera = {v[0], v[1], v[2], v[3], *width, *height};
  depth_camera.depth_from_color.translation() = Eigen::Vector3d(v[6], v[7], v[8]);
  if (v.size() == 13) {
    const std::optional<Eigen::Quaterniond> rotation =
        NormalizedQuaternion({v.begin() + 9, v.end()});
    if (!rotation) line.Fail("the quaternion qx qy qz qw must have length 1");
    depth_camera.depth_from_color.rotation() = *rotation;
  }
  calibration->depth_camera = depth_camera;
}

// Reads a line after that of the intrinsics.
void ParseOptionalLine(const TextLine& line, Calibration* calibration) {
  const std::string& name = line.fields[0];
  if (name == "readout_time") {
    if (calibration->readout_time) line.Fail("a second line readout_time; remove it");
    ParseReadoutLine(line, calibration);
  } else if (name == "depth_camera") {
    if (calibration->depth_camera) line.Fail("a second line depth_camera; remove it");
    ParseDepthCameraLine(line, calibration);
  } else {
    line.Fail(std::string("expected 'readout_time SECONDS', ") + kDepthCameraFormat +
              " or nothing after the line " + kCameraFileFormat);
  }
  std::string error;
  if (!calibration->IsValid(&error)) line.Fail(error);
}

}  // namespace

Calibration ReadCameraFile(const std::string& path) {
  const std::vector<TextLine> lines = ReadTextLines(path);
  if (lines.empty()) {
    throw std::runtime_error(path + ": is empty; expected one line " + kCameraFileFormat);
  }
  Calibration calibration = ParseIntrinsicsLine(lines[0]);
  for (size_t i = 1; i < lines.size(); ++i) ParseOptionalLine(lines[i], &calibration);
  return calibration;
}

std::string FormatCameraFile(const Calibration& calibration, const std::string& comment) {
  const auto intrinsics = [](const PinholeCamera& camera) {
    return FormatText("%.17g %.17g %.17g %.17g %d %d", camera.fx, camera.fy, camera.cx, camera.cy,
                      camera.width, camera.height);
  };
  std::string text = intrinsics(calibration.camera) + FormatText(" %.17g", calibration.depth_scale);
  if (!calibration.distortion.IsZero()) {
    for (const double k : calibration.distortion.k) text += FormatText(" %.17g", k);
  }
  text += "\n";
  if (calibration.readout_time) {
    text += FormatText("readout_time %.17g\n", *calibration.readout_time);
  }
  if (calibration.depth_camera) {
    const Rigid3& transform = calibration.depth_camera->depth_from_color;
    const Eigen::Vector3d t = transform.translation();
    const Eigen::Quaterniond q(transform.rotation());
    text += "depth_camera " + intrinsics(calibration.depth_camera->camera) +
            FormatText(" %.17g %.17g %.17g", t.x(), t.y(), t.z()) +
            FormatText(" %.17g %.17g %.17g %.17g\n", q.x(), q.y(), q.z(), q.w());
  }
  // Numbers come first, for readers that do not skip comments.
  return text + "# fx fy cx cy width height depth_scale [k1 k2 p1 p2 k3]\n# " + comment + "\n";
}

}  // namespace msc_vo
