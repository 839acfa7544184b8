// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include <opencv2/core.hpp>

#include "apps/video/video_file.h"
#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/odometry/tracking_observer.h"
#include "msc_vo/report/frame_view.h"

namespace msc_vo {

/// Draws features onto the grey image; the result is CV_8UC3 of the same size.
cv::Mat DrawFeatures(const cv::Mat& gray, const ViewedFeatures& features);

/// A video of the images of a run with their tracked features. It is written to a temporary file,
/// so that a file of its name remains until Finish().
class OverlayVideo {
 public:
  /// Creates the temporary file, and its folder if necessary. `frame_rate`: frames per second;
  /// `distortion`: of the images of `width` x `height` pixels. Throws std::runtime_error naming the
  /// file if it cannot be written or OpenCV has no encoder for it.
  OverlayVideo(const std::string& path, double frame_rate, int width, int height,
               const LensDistortion& distortion);
  /// Removes the temporary file of a video that is not finished.
  ~OverlayVideo();
  OverlayVideo(const OverlayVideo&) = delete;
  OverlayVideo& operator=(const OverlayVideo&) = delete;

  void Add(const TrackedImage& tracked);

  /// Completes the file. Throws std::runtime_error if it does not hold every image then, as after a
  /// full disk.
  void Finish();

  /// Name of the temporary file.
  const std::string& partial() const { return partial_; }

 private:
  void RemovePartial() const;

  std::string path_;
  std::string partial_;
  cv::Rect covered_;  // encoders need even sizes
  LensDistortion distortion_;
  std::unique_ptr<VideoFile> video_;
  int num_images_ = 0;
};

}  // namespace msc_vo
