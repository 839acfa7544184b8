// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Raw data of Polycam: keyframes/images/T.jpg, keyframes/cameras/T.json, keyframes/depth/T.png
// (millimetres), keyframes/confidence/T.png (0, 127, 255), where T is the time in microseconds;
// corrected_images/ and corrected_cameras/ hold undistorted images and optimised poses. Its
// repository PolyCam/polyform documents these files (README.md): t_ij is row i, column j of the
// camera in the world, with the axes of ARKit.

#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/json_file.h"
#include "msc_vo/datasets/time_unit.h"
#include "msc_vo/phone_recordings/phone_formats.h"
#include "msc_vo/phone_recordings/phone_sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// The folder above images/ and cameras/: the given one or its folder keyframes.
fs::path KeyframeFolder(const std::string& directory) {
  const fs::path inner = fs::path(directory) / "keyframes";
  return IsFolder(inner.string()) ? inner : fs::path(directory);
}

bool IsPolycam(const std::string& directory) {
  const fs::path folder = KeyframeFolder(directory);
  const auto has = [&](const char* name) { return IsFolder((folder / name).string()); };
  return (has("cameras") && has("images")) || (has("corrected_cameras") && has("corrected_images"));
}

double TimeOf(const std::string& path) {
  const std::optional<double> time = ParseNumber(fs::path(path).stem().string());
  if (time && std::isfinite(*time)) return *time / UnitsPerSecond(TimeUnit::kMicroseconds);
  throw std::runtime_error(path +
                           ": its name is no time in microseconds; remove it from the folder");
}

PhoneFrame ReadFrame(const std::string& color, const std::string& camera) {
  PhoneFrame frame;
  frame.timestamp = TimeOf(color);
  frame.image.color_path = color;
  const JsonFile json(camera);
  frame.camera.fx = json.Number("fx");
  frame.camera.fy = json.Number("fy");
  frame.camera.cx = json.Number("cx");
  frame.camera.cy = json.Number("cy");
  frame.camera.width = WholeNumber(json.Number("width")).value_or(0);
  frame.camera.height = WholeNumber(json.Number("height")).value_or(0);
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      pose(row, column) = json.Number(FormatText("t_%d%d", row, column));
    }
  }
  frame.world_from_cam = PoseFromArkit(pose);
  return frame;
}

std::string IfThere(const fs::path& path) { return HasEntry(path.string()) ? path.string() : ""; }

SequenceIndex ReadPolycam(const std::string& directory, const PhoneOptions& options) {
  const fs::path folder = KeyframeFolder(directory);
  const bool is_corrected = IsFolder((folder / "corrected_cameras").string()) &&
                            !ListImages((folder / "corrected_images").string()).empty();
  const std::string prefix = is_corrected ? "corrected_" : "";
  const fs::path cameras = folder / (prefix + "cameras");
  PhoneRecording recording;
  size_t num_without_camera = 0, num_without_depth = 0;
  for (const std::string& color : ListImages((folder / (prefix + "images")).string())) {
    ++recording.num_listed;
    const std::string name = fs::path(color).stem().string();
    const std::string camera = IfThere(cameras / (name + ".json"));
    const std::string depth = IfThere(folder / "depth" / (name + ".png"));
    num_without_camera += camera.empty();
    num_without_depth += !camera.empty() && depth.empty();
    if (camera.empty() || depth.empty()) continue;
    PhoneFrame frame = ReadFrame(color, camera);
    frame.image.depth_path = depth;
    frame.image.confidence_path = IfThere(folder / "confidence" / (name + ".png"));
    recording.frames.push_back(std::move(frame));
  }
  if (num_without_camera + num_without_depth > 0) {
    recording.warnings.push_back(
        FormatText("of %zu images, %zu have no camera and %zu no depth image; they are left out",
                   recording.num_listed, num_without_camera, num_without_depth));
  }
  if (!is_corrected) {
    recording.warnings.push_back(
        "there are no corrected_images; those of the camera, which have some distortion, are used");
  }
  recording.confidence = {127, 255};
  recording.poses_by = is_corrected ? "Polycam" : "ARKit";
  recording.intrinsics = cameras.string();
  recording.times = (folder / (prefix + "images")).string() + " (names, microseconds)";
  return MakePhoneSequence(std::move(recording), options.least_confidence);
}

}  // namespace

SequenceFormat PolycamFormat(const PhoneOptions& options) {
  return {"polycam",
          "keyframes/ with images/, cameras/, depth/ and confidence/: raw data of Polycam",
          "Polycam, on an iPhone or iPad with LiDAR", IsPolycam,
          [options](const std::string& directory) { return ReadPolycam(directory, options); }};
}

}  // namespace msc_vo
