// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// "All data" of 3D Scanner App: frame_00000.jpg, frame_00000.json, depth_00000.png (millimetres),
// conf_00000.png (0, 1, 2). There is no public document of the application itself; that
// cameraPoseARFrame is the camera in the world, row by row, with the axes of ARKit, intrinsics a
// 3x3 matrix, row by row, and time the seconds since the start of the telephone is known from
// programs that read it (PSegs, rtabmap).

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "msc_vo/datasets/image_folder.h"
#include "msc_vo/datasets/json_file.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/phone_recordings/phone_formats.h"
#include "msc_vo/phone_recordings/phone_sequence.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

constexpr char kPrefix[] = "frame_";

std::string SiblingOf(const std::string& frame, const std::string& prefix,
                      const std::string& ending) {
  const fs::path path = frame;
  const std::string number = path.stem().string().substr(sizeof(kPrefix) - 1);
  return (path.parent_path() / (prefix + number + ending)).string();
}

bool IsScannerApp(const std::string& directory) {
  const std::vector<std::string> frames = ListImages(directory, kPrefix);
  return !frames.empty() && HasEntry(SiblingOf(frames.front(), kPrefix, ".json"));
}

PhoneFrame ReadFrame(const std::string& color, const std::string& json_path,
                     const ImageSize& size) {
  const JsonFile json(json_path);
  PhoneFrame frame;
  frame.timestamp = json.Number("time");
  frame.image.color_path = color;
  const std::vector<double> k = json.Numbers("intrinsics", 9);
  frame.camera.fx = k[0];
  frame.camera.fy = k[4];
  frame.camera.cx = k[2];
  frame.camera.cy = k[5];
  frame.camera.width = size.width;
  frame.camera.height = size.height;
  const std::vector<double> pose = json.Numbers("cameraPoseARFrame", 16);
  frame.world_from_cam =
      PoseFromArkit(Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(pose.data()));
  return frame;
}

SequenceIndex ReadScannerApp(const std::string& directory, const PhoneOptions& options) {
  PhoneRecording recording;
  size_t num_without = 0;
  ImageSize size;
  for (const std::string& color : ListImages(directory, kPrefix)) {
    ++recording.num_listed;
    const std::string json = SiblingOf(color, kPrefix, ".json");
    const std::string depth = SiblingOf(color, "depth_", ".png");
    const std::string confidence = SiblingOf(color, "conf_", ".png");
    if (!HasEntry(json) || !HasEntry(depth)) {
      ++num_without;
      continue;
    }
    if (size.width == 0) size = ReadImageSize(color);
    PhoneFrame frame = ReadFrame(color, json, size);
    frame.image.depth_path = depth;
    if (HasEntry(confidence)) frame.image.confidence_path = confidence;
    recording.frames.push_back(std::move(frame));
  }
  if (recording.frames.empty()) {
    throw std::runtime_error(directory +
                             ": no image frame_*.jpg has a frame_*.json and a depth_*.png; 3D "
                             "Scanner App writes depth images in the mode of low resolution, and "
                             "exports them as \"All Data\"");
  }
  if (num_without > 0) {
    recording.warnings.push_back(
        FormatText("%zu of %zu images have no .json or no depth image and are left out",
                   num_without, recording.num_listed));
  }
  recording.poses_by = "ARKit";
  recording.intrinsics = directory + "/frame_*.json";
  recording.times = recording.intrinsics + " (\"time\", seconds)";
  return MakePhoneSequence(std::move(recording), options.least_confidence);
}

}  // namespace

SequenceFormat ScannerAppFormat(const PhoneOptions& options) {
  return {"3d-scanner-app",
          "frame_00000.jpg, frame_00000.json, depth_00000.png, conf_00000.png of 3D Scanner App",
          "3D Scanner App, on an iPhone or iPad with LiDAR", IsScannerApp,
          [options](const std::string& directory) { return ReadScannerApp(directory, options); }};
}

}  // namespace msc_vo
