// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/depth_source.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "msc_vo/sensor/depth_statistics.h"
#include "msc_vo/sensor/flying_pixels.h"

namespace msc_vo {

DepthSource::DepthSource(DepthSensor sensor, const SensorNoiseOptions& noise, double min_depth,
                         double max_depth, int width)
    : given_(sensor),
      sensor_(sensor),
      noise_(noise),
      min_depth_(min_depth),
      max_depth_(max_depth),
      width_(width),
      model_(MakeDepthSensorModel(sensor, noise, width)),
      bleeding_(width) {}

void DepthSource::Reset() { *this = DepthSource(given_, noise_, min_depth_, max_depth_, width_); }

void DepthSource::Assign(const RgbdImage& image) {
  if (sensor_ == DepthSensor::kAuto) {
    const cv::Mat& recorded = image.recorded_depth.empty() ? image.depth : image.recorded_depth;
    sensor_ = ClassifyDepthSensor(MeasureDepthStatistics(recorded));
    model_ = MakeDepthSensorModel(sensor_, noise_, width_);
  }
  image_.Assign(Clean(image.gray, image.depth), min_depth_, max_depth_);
}

cv::Mat DepthSource::Clean(const cv::Mat& gray, const cv::Mat& depth) {
  if (model_.has_flying_pixels) return RemoveFlyingPixels(depth, model_.noise);
  if (!model_.bleeds) return depth;
  // A depth out of range would spread to its neighbours.
  cv::Mat valid = depth.clone();
  for (int y = 0; y < valid.rows; ++y) {
    float* z = valid.ptr<float>(y);
    for (int x = 0; x < valid.cols; ++x) {
      if (!(z[x] >= min_depth_ && z[x] <= max_depth_)) z[x] = 0.0f;  // also NaN
    }
  }
  if (!bleeding_.IsDone()) bleeding_.Add(gray, valid);
  return RemoveBleeding(valid, bleeding_.reach(), model_.noise.disparity);
}

void ShareDepthErrors(double radius, Frame* frame) {
  if (radius <= 0.0) return;
  std::vector<double> factors(frame->points.size(), 1.0);
  for (size_t i = 0; i < frame->points.size(); ++i) {
    int count = 0;
    frame->grid.VisitNear(frame->points, frame->points[i].pixel, radius,
                          [&](int other) { count += frame->points[other].HasDepth(); });
    factors[i] = std::sqrt(std::max(1, count));
  }
  for (size_t i = 0; i < frame->points.size(); ++i) {
    frame->points[i].inverse_depth_sigma *= factors[i];
  }
}

}  // namespace msc_vo
