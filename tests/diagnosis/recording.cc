// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/diagnosis/recording.h"

#include <filesystem>

#include <opencv2/imgcodecs.hpp>

#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

void Recording::Write(const std::string& folder) const {
  for (const char* name : {"rgb", "depth"})
    std::filesystem::create_directories(folder + "/" + name);
  std::string colors, depths, poses;
  for (size_t i = 0; i < images.size(); ++i) {
    const Image& image = images[i];
    const std::string name = FormatText("%04zu.png", i);
    const std::vector<int> fast = {cv::IMWRITE_PNG_COMPRESSION, 1};
    cv::imwrite(folder + "/rgb/" + name, image.color, fast);
    cv::imwrite(folder + "/depth/" + name, image.depth, fast);
    colors += FormatText("%.6f rgb/", stamp_factor * image.color_stamp) + name + "\n";
    depths += FormatText("%.6f depth/", stamp_factor * image.depth_stamp) + name + "\n";
  }
  for (const TimedPose& pose : truth) {
    const Rigid3& p = pose.world_from_cam;
    poses += FormatText("%.6f %.9f %.9f %.9f %.9f %.9f %.9f %.9f\n", stamp_factor * pose.timestamp,
                        p.translation().x(), p.translation().y(), p.translation().z(),
                        p.rotation().x(), p.rotation().y(), p.rotation().z(), p.rotation().w());
  }
  WriteFile(folder + "/rgb.txt", colors);
  WriteFile(folder + "/depth.txt", depths);
  if (!truth.empty()) WriteFile(folder + "/groundtruth.txt", poses);
  const PinholeCamera& camera = calibration.camera;
  WriteFile(folder + "/camera.txt",
            FormatText("%.9f %.9f %.9f %.9f %d %d %.9f\n", camera.fx, camera.fy, camera.cx,
                       camera.cy, camera.width, camera.height, calibration.depth_scale));
}

SyntheticSequenceOptions SmallRoom() {
  SyntheticSequenceOptions options;
  options.width = 320;
  options.height = 240;
  options.fps = 15.0;
  options.kinect_depth = true;
  return options;
}

Recording Record(const SyntheticSequenceOptions& options, int count) {
  const SyntheticSequence sequence(options);
  Recording recording;
  recording.calibration.camera = sequence.camera();
  recording.calibration.depth_scale = 5000.0;
  for (int i = 0; i < count; ++i) {
    SyntheticFrame frame = sequence.Render(i);
    Recording::Image image;
    image.color_stamp = frame.pose.timestamp;
    image.depth_stamp = frame.pose.timestamp;
    std::vector<uint8_t> gray = frame.image.Gray();
    image.color = cv::Mat(options.height, options.width, CV_8UC1, gray.data()).clone();
    cv::Mat(options.height, options.width, CV_32FC1, frame.image.depth.data())
        .convertTo(image.depth, CV_16U, recording.calibration.depth_scale);
    recording.images.push_back(image);
    recording.truth.push_back(frame.pose);
  }
  return recording;
}

}  // namespace msc_vo
