// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "msc_vo/datasets/image_container.h"
#include "msc_vo/phone_recordings/common_camera.h"
#include "msc_vo/phone_recordings/depth_confidence.h"
#include "msc_vo/phone_recordings/video_images.h"

namespace msc_vo {

/// The files of an image of a telephone.
struct PhoneImage {
  std::string color_path;  ///< or the name of an image of the video
  std::string depth_path;
  std::string confidence_path;  ///< empty: all depths are used
  int video_number = -1;        ///< number of the colour image in the video, if there is one
};

/// The images of a recording of a telephone: colour from files or from a video, both images
/// resampled to the common camera, depth without uncertain pixels.
class PhoneImages : public ImageContainer {
 public:
  /// `camera`: null if the intrinsics are not known for each image. `video`: null if the colour
  /// images are files.
  PhoneImages(std::vector<PhoneImage> images, std::shared_ptr<const CommonCamera> camera,
              std::shared_ptr<const VideoImages> video, const ConfidenceValues& values,
              DepthConfidence least);

  StoredImage ReadColor(int index) const override;
  StoredImage ReadDepth(int index) const override;
  std::string Settings() const override;
  cv::Mat AlignMask(int index, const cv::Mat& mask) const override;

  /// Ratio of the depths of some evenly spaced images that are removed for their confidence.
  double RemovedDepthRatio() const;

 private:
  bool Resamples(int index) const { return camera_ && camera_->Resamples(index); }
  // Returns the number of depths before and the depth without those removed.
  cv::Mat ConfidentDepth(const PhoneImage& image, int* num_depths, int* num_removed) const;

  std::vector<PhoneImage> images_;
  std::shared_ptr<const CommonCamera> camera_;
  std::shared_ptr<const VideoImages> video_;
  ConfidenceValues values_;
  DepthConfidence least_;
};

}  // namespace msc_vo
