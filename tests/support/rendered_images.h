// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <gtest/gtest.h>

#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/odometry/odometry.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {

// The trajectory through a room, at 320 x 240 pixels with the depth noise of a Kinect and image
// noise.
inline SyntheticSequenceOptions RoomOptions() {
  SyntheticSequenceOptions options;
  options.width = 320;
  options.height = 240;
  options.kinect_depth = true;
  return options;
}

// The first `count` images.
inline std::vector<RgbdImage> RenderImages(const SyntheticSequenceOptions& options, int count) {
  const SyntheticSequence sequence(options);
  std::vector<RgbdImage> images(count);
  for (int i = 0; i < count; ++i) {
    SyntheticFrame frame = sequence.Render(i);
    std::vector<uint8_t> gray = frame.image.Gray();
    images[i].id = i;
    images[i].timestamp = frame.pose.timestamp;
    images[i].gray = cv::Mat(options.height, options.width, CV_8UC1, gray.data()).clone();
    images[i].depth =
        cv::Mat(options.height, options.width, CV_32FC1, frame.image.depth.data()).clone();
  }
  return images;
}

// A black image instead of `image`, whose pixels others may share.
inline void Blacken(RgbdImage* image) {
  image->gray = cv::Mat(image->gray.rows, image->gray.cols, CV_8UC1, cv::Scalar(0));
}

// A hand before both cameras: a black image without depth.
inline void Cover(RgbdImage* image) {
  Blacken(image);
  image->depth = cv::Mat(image->depth.rows, image->depth.cols, image->depth.type(), cv::Scalar(0));
}

inline std::vector<TimedPose> TruePoses(const SyntheticSequenceOptions& options, int count) {
  const SyntheticSequence sequence(options);
  std::vector<TimedPose> truth;
  for (int i = 0; i < count; ++i) truth.push_back(sequence.PoseAt(i));
  return truth;
}

// Two seconds of the trajectory through the room, rendered once for all tests of a suite.
class RoomTest : public ::testing::Test {
 protected:
  static constexpr int kNumFrames = 60;

  static void SetUpTestSuite() {
    camera_ = SyntheticSequence(RoomOptions()).camera();
    images_ = new std::vector<RgbdImage>(RenderImages(RoomOptions(), kNumFrames));
    truth_ = new std::vector<TimedPose>(TruePoses(RoomOptions(), kNumFrames));
  }
  static void TearDownTestSuite() {
    delete images_;
    delete truth_;
  }

  // Root mean square of the absolute pose error, metres.
  static double ApeRmse(const OdometryResult& result,
                        const std::vector<TimedPose>& truth = *truth_) {
    std::vector<TimedPose> estimate;
    for (const FrameResult& frame : result.frames) {
      estimate.push_back({frame.timestamp, frame.cam_from_world.Inverse()});
    }
    return EvaluateTrajectory(truth, estimate).ape.rmse;
  }

  static inline PinholeCamera camera_;
  static inline std::vector<RgbdImage>* images_ = nullptr;
  static inline std::vector<TimedPose>* truth_ = nullptr;
};

// Expects the same poses and points, bit by bit.
inline void ExpectSameBytes(const OdometryResult& a, const OdometryResult& b) {
  ASSERT_EQ(a.frames.size(), b.frames.size());
  for (size_t i = 0; i < a.frames.size(); ++i) {
    EXPECT_EQ(a.frames[i].cam_from_world.params, b.frames[i].cam_from_world.params) << i;
  }
  ASSERT_EQ(a.points.size(), b.points.size());
  for (size_t i = 0; i < a.points.size(); ++i) {
    EXPECT_EQ(a.points[i].position, b.points[i].position) << i;
  }
}

}  // namespace msc_vo
