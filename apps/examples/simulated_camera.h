// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/odometry/odometry.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {

/// Takes the place of a live RGB-D camera in the examples: renders small images with the noise of a
/// Kinect at 30 Hz along a hand-held trajectory, and knows the true poses.
class SimulatedCamera {
 public:
  /// Images [begin_covered, end_covered) are black and have no depth, as with a hand on the lens.
  SimulatedCamera(SceneKind scene, int num_images, int begin_covered = 0, int end_covered = 0)
      : sequence_(Options(scene)),
        num_images_(num_images),
        begin_covered_(begin_covered),
        end_covered_(end_covered) {}

  const PinholeCamera& camera() const { return sequence_.camera(); }
  int num_images() const { return num_images_; }
  const Scene& scene() const { return sequence_.scene(); }
  /// The pose of the scene's frame in the world of the odometry.
  Rigid3 WorldFromScene() const { return sequence_.PoseAt(0).world_from_cam.Inverse(); }
  std::vector<TimedAcceleration> AccelerometerReadings() const {
    return sequence_.AccelerometerReadings(num_images_);
  }

  /// True vertical in the camera of image `index`, a unit vector that points up.
  Eigen::Vector3d UpInCamera(int index) const {
    return sequence_.PoseAt(index).world_from_cam.rotation().conjugate() * Eigen::Vector3d::UnitZ();
  }

  /// Takes image `index`.
  RgbdImage Grab(int index) const {
    RgbdImage image;
    image.id = index;
    image.timestamp = sequence_.PoseAt(index).timestamp;
    const cv::Size size(camera().width, camera().height);
    if (index >= begin_covered_ && index < end_covered_) {
      image.gray = cv::Mat::zeros(size, CV_8UC1);
      image.depth = cv::Mat::zeros(size, CV_32FC1);
      return image;
    }
    SyntheticFrame frame = sequence_.Render(index);
    std::vector<uint8_t> gray = frame.image.Gray();
    image.gray = cv::Mat(size, CV_8UC1, gray.data()).clone();
    image.depth = cv::Mat(size, CV_32FC1, frame.image.depth.data()).clone();
    return image;
  }
  /// Passes all images to the odometry.
  OdometryResult Replay(Odometry* odometry) const {
    for (int i = 0; i < num_images_; ++i) odometry->Process(Grab(i));
    return odometry->Finish();
  }

  /// Index of the image with this time stamp.
  int IndexAt(double timestamp) const {
    return static_cast<int>(std::lround((timestamp - sequence_.PoseAt(0).timestamp) * 30.0));
  }
  /// True pose of image `index` relative to the first one, the world of the odometry.
  Rigid3 CamFromWorld(int index) const {
    return sequence_.PoseAt(index).world_from_cam.Inverse() * sequence_.PoseAt(0).world_from_cam;
  }
  /// Root mean square error of the positions, metres, without alignment.
  double PositionError(const OdometryResult& result) const {
    double squares = 0.0;
    for (const FrameResult& frame : result.frames) {
      const Eigen::Vector3d truth = CamFromWorld(static_cast<int>(frame.id)).OriginInSource();
      squares += (frame.cam_from_world.OriginInSource() - truth).squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(result.frames.size()));
  }

 private:
  static SyntheticSequenceOptions Options(SceneKind scene) {
    SyntheticSequenceOptions options;
    options.scene = scene;
    options.width = 160;
    options.height = 120;
    options.kinect_depth = true;
    return options;
  }

  SyntheticSequence sequence_;
  int num_images_, begin_covered_, end_covered_;
};

}  // namespace msc_vo
