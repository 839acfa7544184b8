// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/recorded_images.h"

#include <algorithm>

#include "msc_vo/sensor/depth_camera_correction.h"
#include "msc_vo/sensor/depth_edges.h"
#include "msc_vo/sensor/depth_registration.h"

namespace msc_vo {

namespace {

// Images whose edges are compared: a bound of the computing time.
constexpr size_t kMaxCompared = 8;

}  // namespace

void RecordedImages::Add(KeyframeId keyframe, const std::shared_ptr<const RecordedImage>& image) {
  images_.push_back({keyframe, image});
  if (images_.size() > kMaxImages) images_.pop_front();
}

std::shared_ptr<const RecordedImage> RecordedImages::Find(KeyframeId keyframe) const {
  for (const KeyframeImage& image : images_) {
    if (image.keyframe == keyframe) return image.image;
  }
  return nullptr;
}

bool RecordedImages::EdgesAgree(const CameraIntrinsics& given,
                                const CameraIntrinsics& corrected) const {
  const DepthRegistration registration(DepthCameraOf(given, corrected), corrected.camera,
                                       corrected.distortion);
  EdgeComparison comparison;
  const size_t count = std::min(images_.size(), kMaxCompared);
  for (size_t i = 0; i < count; ++i) {
    const RecordedImage& image = *images_[i * images_.size() / count].image;
    const cv::Mat depth = image.Depth();
    comparison.Add(image.Gray(), depth, registration.Register(depth));
  }
  return comparison.Agrees();
}

}  // namespace msc_vo
