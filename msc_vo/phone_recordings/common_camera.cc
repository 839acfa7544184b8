// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/phone_recordings/common_camera.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/geometry/quantile.h"

namespace msc_vo {

namespace {

double Median(const std::vector<PinholeCamera>& cameras, double PinholeCamera::*value) {
  std::vector<double> values;
  for (const PinholeCamera& camera : cameras) values.push_back(camera.*value);
  return UpperMedian(std::move(values));
}

// Position in the image of `from` of the ray through a pixel of `to`, one coordinate.
double Map(double pixel, double to_f, double to_c, double from_f, double from_c) {
  return from_f * (pixel - to_c) / to_f + from_c;
}

}  // namespace

CommonCamera::CommonCamera(std::vector<PinholeCamera> cameras) : cameras_(std::move(cameras)) {
  if (cameras_.empty()) throw std::invalid_argument("CommonCamera: no images");
  camera_ = cameras_.front();
  for (const auto value :
       {&PinholeCamera::fx, &PinholeCamera::fy, &PinholeCamera::cx, &PinholeCamera::cy}) {
    camera_.*value = Median(cameras_, value);
  }
  for (int i = 0; i < static_cast<int>(cameras_.size()); ++i) {
    num_resampled_ += Resamples(i);
    largest_displacement_ = std::max(largest_displacement_, Displacement(i));
  }
}

double CommonCamera::Displacement(int i) const {
  const PinholeCamera& own = cameras_[static_cast<size_t>(i)];
  double largest = 0.0;
  for (const double x : {-0.5, camera_.width - 0.5}) {
    for (const double y : {-0.5, camera_.height - 0.5}) {
      largest = std::max(largest, std::hypot(Map(x, camera_.fx, camera_.cx, own.fx, own.cx) - x,
                                             Map(y, camera_.fy, camera_.cy, own.fy, own.cy) - y));
    }
  }
  return largest * kReferenceWidth / camera_.width;
}

cv::Mat CommonCamera::Resample(int i, const cv::Mat& image, int interpolation, int outside) const {
  const ImageSize size{image.cols, image.rows};
  const PinholeCamera from = ScaledCamera(cameras_[static_cast<size_t>(i)], size);
  const PinholeCamera to = ScaledCamera(camera_, size);
  const double sx = from.fx / to.fx, sy = from.fy / to.fy;
  const cv::Matx23d map(sx, 0.0, from.cx - sx * to.cx, 0.0, sy, from.cy - sy * to.cy);
  const bool is_nearest = interpolation == cv::INTER_NEAREST;
  cv::Mat resampled;
  cv::warpAffine(image, resampled, map, image.size(), interpolation | cv::WARP_INVERSE_MAP,
                 is_nearest ? cv::BORDER_CONSTANT : cv::BORDER_REPLICATE, cv::Scalar::all(outside));
  return resampled;
}

}  // namespace msc_vo
