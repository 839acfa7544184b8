// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/recorded_images.h"

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

using S = SensorCorrection;

const PinholeCamera kCamera{500.0, 500.0, 319.5, 239.5, 640, 480};

// A bright box before a dark wall, whose depth is `shift` pixels to the right.
std::shared_ptr<const RecordedImage> BoxImage(int shift) {
  const cv::Rect box(200, 150, 200, 150);
  cv::Mat gray(480, 640, CV_8UC1, cv::Scalar(40));
  gray(box).setTo(200);
  cv::Mat depth(480, 640, CV_32FC1, cv::Scalar(3.0));
  depth(box + cv::Point(shift, 0)).setTo(1.0);
  return std::make_shared<RecordedImage>(gray, depth, DepthSensor::kStructuredLight);
}

RecordedImages BoxImages(int shift) {
  RecordedImages images;
  for (KeyframeId id = 0; id < 4; ++id) images.Add(id, BoxImage(shift));
  return images;
}

CameraIntrinsics WithShift(double pixels) {
  CameraIntrinsics corrected{kCamera, {}};
  corrected.registration = S::Vector::Zero();
  (*corrected.registration)(S::kDepthX) = pixels / kCamera.fx;
  return corrected;
}

TEST(RecordedImages, KeepsTheNewest) {
  RecordedImages images;
  for (KeyframeId id = 0; id <= static_cast<KeyframeId>(RecordedImages::kMaxImages); ++id) {
    images.Add(id, BoxImage(0));
  }
  EXPECT_EQ(images.Find(0), nullptr);
  EXPECT_NE(images.Find(1), nullptr);
  images.Clear();
  EXPECT_EQ(images.Find(1), nullptr);
}

TEST(RecordedImages, EdgesAgreeWithARegistrationThatMovesThemOntoImageEdges) {
  const CameraIntrinsics given{kCamera, {}};
  EXPECT_TRUE(BoxImages(12).EdgesAgree(given, WithShift(12.0)));
  EXPECT_FALSE(BoxImages(12).EdgesAgree(given, WithShift(-12.0)));
  EXPECT_FALSE(BoxImages(0).EdgesAgree(given, WithShift(12.0)));
}

TEST(RecordedImages, ImagesWithoutEdgesDoNotContradict) {
  RecordedImages images;
  images.Add(0, std::make_shared<RecordedImage>(cv::Mat(480, 640, CV_8UC1, cv::Scalar(40)),
                                                cv::Mat(480, 640, CV_32FC1, cv::Scalar(2.0)),
                                                DepthSensor::kStructuredLight));
  EXPECT_TRUE(images.EdgesAgree({kCamera, {}}, WithShift(12.0)));
}

}  // namespace
}  // namespace msc_vo
