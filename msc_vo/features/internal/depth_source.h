// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <opencv2/core.hpp>

#include "msc_vo/frame/frame.h"
#include "msc_vo/sensor/depth_bleeding.h"
#include "msc_vo/sensor/depth_sensor.h"
#include "msc_vo/sensor/inverse_depth_image.h"
#include "msc_vo/sensor/rgbd_image.h"

namespace msc_vo {

/// The depth images of one sensor as inverse depths, without the artefacts that the sensor adds at
/// depth edges. If the sensor is not given, the first image with enough depth determines it.
class DepthSource {
 public:
  /// Depth outside [min_depth, max_depth] (metres) is invalid; `width` of the images in pixels.
  DepthSource(DepthSensor sensor, const SensorNoiseOptions& noise, double min_depth,
              double max_depth, int width);

  /// Replaces the image.
  void Assign(const RgbdImage& image);

  /// Forgets what the images have told about the sensor.
  void Reset();

  /// kAuto until it is determined; the model is then that of structured light.
  DepthSensor sensor() const { return sensor_; }
  const DepthSensorModel& model() const { return model_; }
  const InverseDepthImage& image() const { return image_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(sensor_, bleeding_);
    model_ = MakeDepthSensorModel(sensor_, noise_, width_);
  }

 private:
  // The depth without the artefacts of the sensor.
  cv::Mat Clean(const cv::Mat& gray, const cv::Mat& depth);

  DepthSensor given_;
  DepthSensor sensor_;
  SensorNoiseOptions noise_;
  double min_depth_;
  double max_depth_;
  int width_;
  DepthSensorModel model_;
  BleedingEstimator bleeding_;
  InverseDepthImage image_;
};

/// Multiplies the sigma of the depth of each point by the square root of the number of points with
/// depth within `radius` pixels, itself included: all of them have one error, which then counts
/// once. No effect if `radius` is 0.
void ShareDepthErrors(double radius, Frame* frame);

}  // namespace msc_vo
