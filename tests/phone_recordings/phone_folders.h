// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/geometry/timed_pose.h"
#include "msc_vo/phone_recordings/video_reader.h"

namespace msc_vo {

// Images to make recordings of telephones from.
struct PhoneSource {
  struct Image {
    double timestamp = 0.0;
    cv::Mat color;          // CV_8UC3
    cv::Mat depth;          // CV_32FC1, metres, of the size of the colour image
    Rigid3 world_from_cam;  // x right, y down, z forward
  };
  PinholeCamera camera;
  std::vector<Image> images;
};

// The first `count` images of a folder in the layout of TUM, with its ground truth.
PhoneSource ReadPhoneSource(const std::string& folder, int count);

// What the written recording has beside the images.
struct PhoneFolderOptions {
  // Part of the focal length by which the camera of an image differs: + and - in turn of 8 images,
  // as a telephone that focuses.
  double breathing = 0.0;
  int depth_step = 4;  // colour pixels per depth pixel
  // Depths in the upper left quarter are 0.3 m too far and of low confidence.
  bool has_uncertain_depth = false;
  bool has_row_intrinsics = true;  // odometry.csv with fx, fy, cx, cy
};

// Each writes the images as the application does.
void WriteStrayScanner(const PhoneSource& source, const PhoneFolderOptions& options,
                       const std::string& folder);
// `prefix`: "" or "corrected_", of the images and cameras.
void WritePolycam(const PhoneSource& source, const PhoneFolderOptions& options,
                  const std::string& prefix, const std::string& folder);
void WriteScannerApp(const PhoneSource& source, const PhoneFolderOptions& options,
                     const std::string& folder);

// Writes images of one size as a video. Throws std::runtime_error if OpenCV cannot encode it.
void WriteVideo(const std::vector<cv::Mat>& images, double rate, const std::string& path);

// The reader of the command's module.
std::unique_ptr<VideoReader> MakeTestVideoReader();

}  // namespace msc_vo
