// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/image_mask.h"

#include <opencv2/imgproc.hpp>

namespace msc_vo {

namespace {

void RemoveWhereMasked(const cv::Mat& mask, cv::Mat* depth) {
  if (depth->size() != mask.size()) return;
  *depth = depth->clone();
  depth->setTo(0, mask);
}

}  // namespace

void RemoveMaskedDepth(RgbdImage* image) {
  if (image->mask.empty()) return;
  RemoveWhereMasked(image->mask, &image->depth);
  RemoveWhereMasked(image->mask, &image->recorded_depth);
}

cv::Mat DistanceToMask(const cv::Mat& mask) {
  cv::Mat distance;
  if (!mask.empty()) {
    cv::distanceTransform(mask == 0, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  }
  return distance;
}

}  // namespace msc_vo
