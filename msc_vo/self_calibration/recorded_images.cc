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
  int num_better = 0, num_worse = 0;
  const size_t count = std::min(images_.size(), kMaxCompared);
  for (size_t i = 0; i < count; ++i) {
    const RecordedImage& image = *images_[i * images_.size() / count].image;
    const cv::Mat gray = image.Gray();
    const cv::Mat depth = image.Depth();
    const EdgeAgreement before = MeasureEdgeAgreement(gray, depth);
    const EdgeAgreement after = MeasureEdgeAgreement(gray, registration.Register(depth));
    const int num_edges = before.num_edges + after.num_edges;
    // Edges may leave the image, but not most of them.
    const bool is_better = after.mean > before.mean && 2 * after.num_edges >= before.num_edges;
    (is_better ? num_better : num_worse) += num_edges;
  }
  return num_better >= 3 * num_worse;
}

}  // namespace msc_vo
