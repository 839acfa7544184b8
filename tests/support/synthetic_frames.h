// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <random>
#include <vector>

#include "msc_vo/frame/frame.h"

namespace msc_vo {

// A world of points and line segments with distinct descriptors, and frames that observe it as a
// FrameBuilder would extract them, without images.
class SyntheticFrames {
 public:
  struct Options {
    int num_points = 300;
    int num_lines = 40;
    double min_depth = 2.0, max_depth = 6.0;  // of points from the first camera, metres
    double pixel_noise = 0.5;                 // standard deviation of every coordinate, pixels
    double inverse_depth_noise = 1e-3;        // standard deviation, 1/metres
    int flipped_bits = 12;                    // of every descriptor, per observation
    unsigned seed = 1;
  };

  explicit SyntheticFrames(const Options& options) : options_(options), random_(options.seed) {
    // A box of 6 x 3 x 4 metres in front of the first cameras; lines along its three directions.
    for (int i = 0; i < options.num_points; ++i) {
      points_.push_back(
          {Uniform(-3, 3), Uniform(-1.5, 1.5), Uniform(options.min_depth, options.max_depth)});
      point_descriptors_.push_back(RandomDescriptor());
    }
    for (int i = 0; i < options.num_lines; ++i) {
      LineSegment3 line;
      line.start = Eigen::Vector3d{Uniform(-2.5, 2.5), Uniform(-1.2, 1.2), Uniform(2.5, 5.5)};
      Eigen::Vector3d direction = Eigen::Vector3d::Zero();
      direction[i % 3] = i % 2 == 0 ? 1.0 : -1.0;
      line.end = Eigen::Vector3d(line.start) + Uniform(0.4, 1.2) * direction;
      lines_.push_back(line);
      line_descriptors_.push_back(RandomDescriptor());
    }
  }

  const std::vector<Eigen::Vector3d>& points() const { return points_; }
  const std::vector<LineSegment3>& lines() const { return lines_; }

  // Smooth trajectory of a hand-held camera at 30 Hz, metres.
  static Rigid3 CamFromWorld(int index) {
    const double t = index / 30.0;
    const Eigen::Vector3d center(0.4 * std::sin(0.9 * t), 0.1 * std::sin(1.3 * t), 0.25 * t);
    const Eigen::Quaterniond world_from_cam =
        Eigen::AngleAxisd(0.25 * std::sin(0.7 * t), Eigen::Vector3d::UnitY()) *
        Eigen::AngleAxisd(0.1 * std::sin(1.1 * t), Eigen::Vector3d::UnitX()) *
        Eigen::Quaterniond::Identity();
    return Rigid3(world_from_cam, center).Inverse();
  }

  // Frame `index`, observed from CamFromWorld(index) or any other pose.
  std::shared_ptr<const Frame> MakeFrame(int index) {
    return MakeFrame(index, CamFromWorld(index));
  }
  std::shared_ptr<const Frame> MakeFrame(int index, const Rigid3& cam_from_world) {
    auto frame = std::make_shared<Frame>();
    frame->id = index;
    frame->timestamp = index / 30.0;
    for (size_t i = 0; i < points_.size(); ++i) ObservePoint(i, cam_from_world, frame.get());
    for (size_t i = 0; i < lines_.size(); ++i) ObserveLine(i, cam_from_world, frame.get());
    frame->grid = FeatureGrid(frame->camera, frame->points);
    return frame;
  }
  // A frame without features, as with a covered lens.
  static std::shared_ptr<const Frame> MakeEmptyFrame(int index) {
    auto frame = std::make_shared<Frame>();
    frame->id = index;
    frame->timestamp = index / 30.0;
    frame->grid = FeatureGrid(frame->camera, frame->points);
    return frame;
  }

 private:
  double Uniform(double low, double high) {
    return low + (high - low) * (random_() / 4294967296.0);
  }
  double Normal(double sigma) {
    return std::normal_distribution<double>(0.0, 1.0)(random_) * sigma;
  }

  Descriptor RandomDescriptor() {
    Descriptor descriptor;
    for (uint8_t& byte : descriptor) byte = static_cast<uint8_t>(random_() >> 24);
    return descriptor;
  }
  Descriptor Disturb(Descriptor descriptor) {
    for (int i = 0; i < options_.flipped_bits; ++i) {
      const unsigned bit = random_() % 256;
      descriptor[bit / 8] ^= static_cast<uint8_t>(1u << (bit % 8));
    }
    return descriptor;
  }

  void ObservePoint(size_t i, const Rigid3& cam_from_world, Frame* frame) {
    const Eigen::Vector3d in_cam = cam_from_world * points_[i];
    if (in_cam.z() < 0.3) return;
    PointFeature feature;
    feature.pixel = frame->camera.Project(in_cam) +
                    Eigen::Vector2d{Normal(options_.pixel_noise), Normal(options_.pixel_noise)};
    if (!frame->camera.IsInside(feature.pixel)) return;
    feature.inverse_depth = 1.0 / in_cam.z() + Normal(options_.inverse_depth_noise);
    feature.inverse_depth_sigma = 1.425e-3;
    feature.descriptor = Disturb(point_descriptors_[i]);
    frame->points.push_back(feature);
  }

  void ObserveLine(size_t i, const Rigid3& cam_from_world, Frame* frame) {
    LineSegment3 in_cam = cam_from_world * lines_[i];
    if (!ClipToNear(0.3, &in_cam)) return;
    LineSegment2 image;
    image.start = frame->camera.Project(in_cam.start);
    image.end = frame->camera.Project(in_cam.end);
    const LineSegment2 whole = image;
    if (!ClipToImage(frame->camera, &image) || image.Length() < 30.0) return;
    const double w_start = 1.0 / in_cam.start.z();
    const double w_end = 1.0 / in_cam.end.z();
    LineFeature feature;
    LineDepth depth;
    const auto inverse_depth_at = [&](const Eigen::Vector2d& pixel) {
      const double s = whole.Parameter(pixel);
      return (1.0 - s) * w_start + s * w_end + Normal(options_.inverse_depth_noise);
    };
    depth.start = inverse_depth_at(image.start);
    depth.end = inverse_depth_at(image.end);
    depth.covariance = Eigen::Matrix2d::Identity() * 1.425e-3 * 1.425e-3;
    depth.num_inliers = 20;
    depth.inlier_ratio = 1.0;
    const Eigen::Vector2d direction = image.Direction();
    const Eigen::Vector2d normal(-direction.y(), direction.x());
    image.start += Normal(options_.pixel_noise) * normal;
    image.end += Normal(options_.pixel_noise) * normal;
    feature.segment = image;
    if (depth.start > 0.0 && depth.end > 0.0) feature.depth = depth;
    feature.descriptor = Disturb(line_descriptors_[i]);
    frame->lines.push_back(feature);
  }

  Options options_;
  std::mt19937 random_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<Descriptor> point_descriptors_;
  std::vector<LineSegment3> lines_;
  std::vector<Descriptor> line_descriptors_;
};

}  // namespace msc_vo
