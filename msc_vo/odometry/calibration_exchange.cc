// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/calibration_exchange.h"

#include <memory>
#include <utility>

#include "msc_vo/sensor/depth_camera_correction.h"

namespace msc_vo {

namespace {

// Images between keyframes: least time after another or a keyframe, number.
constexpr double kMinInterval = 0.115;
constexpr size_t kMaxImages = 3;

}  // namespace

CalibrationExchange::CalibrationExchange(bool enabled, ImagePipeline* images, Mapper* mapper)
    : enabled_(enabled), images_(images), mapper_(mapper) {
  if (enabled) mapper->BeginSelfCalibration(images->intrinsics(), images->MeasurementOfDepth());
}

ExtractedFrame CalibrationExchange::Adopt(const MapSnapshot& map, const AlignedImage& image,
                                          ExtractedFrame extracted, StageTimes* times) {
  if (!images_->UseIntrinsics(map.intrinsics)) return extracted;
  return images_->Extract(image, times);
}

void CalibrationExchange::KeepImage(const TrackedFrame& tracked, const AlignedImage& image,
                                    const MapSnapshot& map) {
  const double timestamp = tracked.frame->timestamp;
  if (!NeedsImages(map) || tracked.keyframe.is_due() ||
      tracked.status != TrackingStatus::kTracked || kept_.size() >= kMaxImages ||
      timestamp - last_image_time_ < kMinInterval) {
    return;
  }
  last_image_time_ = timestamp;
  kept_.push_back(
      {tracked.frame,
       std::make_shared<RecordedImage>(cv::Mat(), image.aligned.depth, images_->depth_sensor()),
       tracked.reference, tracked.cam_from_reference});
}

void CalibrationExchange::AddImages(const AlignedImage& image, const MapSnapshot& map,
                                    KeyframePacket* packet) {
  if (NeedsImages(map)) {
    packet->image = std::make_shared<RecordedImage>(image.aligned.gray, image.aligned.depth,
                                                    images_->depth_sensor());
  }
  packet->calibration_images = std::exchange(kept_, {});
  last_image_time_ = packet->frame->timestamp;
}

void CalibrationExchange::Describe(OdometryResult* result) const {
  const MapCalibration& calibration = mapper_->calibration();
  result->readout_time = calibration.readout().readout_time();
  result->readout_time_sigma = calibration.readout().sigma();
  result->intrinsics = {images_->intrinsics()->camera, images_->intrinsics()->distortion};
  if (calibration.intrinsics()) {
    result->calibration = calibration.intrinsics()->estimate();
    result->intrinsics = *calibration.intrinsics()->present();
  }
  result->depth_camera = DepthCameraOf(images_->given(), result->intrinsics);
}

}  // namespace msc_vo
