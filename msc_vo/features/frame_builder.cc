// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/frame_builder.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/features/internal/depth_range_builder.h"
#include "msc_vo/features/internal/depth_source.h"
#include "msc_vo/features/internal/feature_depth.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/sensor/image_mask.h"
#include "msc_vo/sensor/lens_remap.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

void CheckImage(const cv::Mat& image, int type, const PinholeCamera& camera, const char* name) {
  if (image.type() != type) {
    throw std::invalid_argument(std::string(name) + ": image must be " + cv::typeToString(type) +
                                ", is " + cv::typeToString(image.type()));
  }
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw std::invalid_argument(std::string(name) + ": image is " + std::to_string(image.cols) + "x" +
                              std::to_string(image.rows) + ", camera is " +
                              std::to_string(camera.width) + "x" + std::to_string(camera.height));
}

// Between the times of both images, the camera moves in a way that is not known, or was predicted
// from the last two frames: of hand-held cameras, the velocity and its change in 1/30 s. That
// planes are moved again by a better velocity does not make it smaller.
void AddMotionNoise(const RgbdImage& image, std::vector<PlaneFeature>* planes) {
  const double turn = image.depth_velocity ? 0.2 : 1.0;   // radians/second
  const double speed = image.depth_velocity ? 0.1 : 0.5;  // metres/second
  const double delay = std::abs(image.depth_delay);
  for (PlaneFeature& plane : *planes) plane.AddMotionNoise(turn * delay, speed * delay);
}

}  // namespace

void RunSequentially(const Tasks& tasks) {
  for (const auto& task : tasks) task();
}

struct FrameBuilder::State {
  FrameBuilderOptions options;
  PinholeCamera camera;
  LensRemap lens;
  LensDistortion distortion;
  std::shared_ptr<const CameraIntrinsics> intrinsics;
  PointExtractor point_extractor;
  LineExtractor line_extractor;
  DepthSource depth;
  std::optional<PlaneExtractor> planes;
  FrameBuilderTimes times;
  cv::Mat mask;              // of the image; empty: none
  cv::Mat distance_to_mask;  // of its pixels

  State(const FrameBuilderOptions& o, const PinholeCamera& c, const LensDistortion& distortion_in)
      : options(o),
        camera(c),
        lens(camera, distortion_in),
        distortion(distortion_in),
        intrinsics(std::make_shared<CameraIntrinsics>(CameraIntrinsics{c, distortion_in})),
        point_extractor(o.points),
        line_extractor(o.lines),
        depth(o.depth_sensor, o.noise, o.min_depth, o.max_depth, c.width) {
    ResetPlanes();
  }

  // For the present calibration.
  void ResetPlanes() {
    if (!options.extract_planes) return;
    PlaneExtractorOptions of_planes;
    of_planes.min_depth = options.min_depth;
    of_planes.max_depth = options.max_depth;
    of_planes.inverse_depth_noise = options.noise.inverse_depth_noise;
    planes.emplace(of_planes, camera, distortion);
  }

  // Points of a level at distorted pixels.
  std::vector<PointFeature> ExtractPoints(int level) {
    std::vector<PointFeature> points = point_extractor.ExtractLevel(level);
    for (PointFeature& point : points) point.sigma *= options.noise.point_sigma;
    return points;
  }

  std::vector<LineFeature> ExtractLines(const cv::Mat& gray) {
    std::vector<LineFeature> lines =
        line_extractor.Extract(lens.Undistort(gray), lens.mask(), UndistortedDistance());
    for (LineFeature& line : lines) line.sigma = options.noise.line_sigma;
    return lines;
  }

  // Replaces the mask of the image.
  void SetMask(const cv::Mat& image_mask) {
    mask = image_mask;
    distance_to_mask = DistanceToMask(mask);
  }
  cv::Mat UndistortedDistance() const {
    const bool is_same = mask.empty() || lens.mask().empty();
    return is_same ? distance_to_mask : DistanceToMask(lens.Undistort(mask != 0));
  }

  // The points of one pyramid level, and the time spent on them.
  struct PointLevel {
    std::vector<PointFeature> points;
    double points_ms = 0.0;
    double depth_ms = 0.0;
  };

  PointLevel BuildPointLevel(int level) {
    PointLevel result;
    Stopwatch stopwatch;
    result.points = ExtractPoints(level);
    result.points_ms = stopwatch.Restart();
    for (PointFeature& point : result.points) {
      MeasureDepth(depth, point.pixel, &point);
      point.pixel = lens.IdealFromRaw(point.pixel);
    }
    if (distortion.IsCropped()) CropPoints(&result.points);
    result.depth_ms = stopwatch.Restart();
    return result;
  }

  // Removes the points outside the undistorted image, and scales the sigma of the others with it.
  void CropPoints(std::vector<PointFeature>* points) const {
    const auto is_outside = [this](const PointFeature& point) {
      return !camera.IsInside(point.pixel);
    };
    EraseIf(points, is_outside);
    for (PointFeature& point : *points) point.sigma *= std::sqrt(lens.Magnification(point.pixel));
  }
};

FrameBuilder::FrameBuilder(const FrameBuilderOptions& options, const PinholeCamera& camera,
                           const LensDistortion& distortion) {
  std::string error;
  if (!camera.IsValid(&error) || !IsInvertible(distortion, camera, &error)) {
    throw std::invalid_argument("FrameBuilder: " + error);
  }
  state_ = std::make_unique<State>(options, camera, distortion);
}

FrameBuilder::~FrameBuilder() = default;

void FrameBuilder::Check(const RgbdImage& image) const {
  CheckImage(image.gray, CV_8UC1, state_->camera, "gray");
  CheckImage(image.depth, CV_32FC1, state_->camera, "depth");
  if (!image.mask.empty()) CheckImage(image.mask, CV_8UC1, state_->camera, "mask");
}

Frame FrameBuilder::Build(const RgbdImage& image, const TaskRunner& run) {
  Check(image);
  Frame frame;
  frame.id = image.id;
  frame.timestamp = image.timestamp;
  frame.camera = state_->camera;
  frame.intrinsics = state_->intrinsics;
  if (state_->distortion.model != LensModel::kRadialTangential || state_->distortion.recorded) {
    frame.lens = state_->distortion;
  }
  FrameBuilderTimes& times = state_->times;
  Stopwatch stopwatch;
  RgbdImage masked = image;
  RemoveMaskedDepth(&masked);
  state_->SetMask(image.mask);
  state_->depth.Assign(masked);
  frame.depth_ranges = MakeDepthRanges(state_->depth.image(), state_->lens, frame.camera);
  times.depth = stopwatch.Restart();
  std::vector<State::PointLevel> levels(
      state_->point_extractor.SetImage(image.gray, state_->distance_to_mask));
  times.points = stopwatch.Restart();
  double line_depth_ms = 0.0;
  Tasks tasks;
  tasks.push_back([&] {
    Stopwatch line_stopwatch;
    frame.lines = state_->ExtractLines(image.gray);
    times.lines = line_stopwatch.Restart();
    MeasureDepth(state_->options, state_->depth, state_->lens, &frame.lines);
    line_depth_ms = line_stopwatch.Restart();
  });
  if (state_->planes) {
    tasks.push_back([&] {
      frame.planes = state_->planes->Extract(masked.depth);
      if (image.depth_delay == 0.0) return;
      AddMotionNoise(image, &frame.planes);
      frame.depth_motion = {image.depth_delay, image.depth_velocity.value_or(CameraVelocity())};
    });
  }
  for (size_t l = 0; l < levels.size(); ++l) {
    tasks.push_back([&, l] { levels[l] = state_->BuildPointLevel(static_cast<int>(l)); });
  }
  run(tasks);
  times.depth += line_depth_ms;
  for (const State::PointLevel& level : levels) {
    frame.points.insert(frame.points.end(), level.points.begin(), level.points.end());
    times.points += level.points_ms;
    times.depth += level.depth_ms;
  }
  frame.grid = FeatureGrid(frame.camera, frame.points);
  ShareDepthErrors(state_->depth.model().shared_radius, &frame);
  return frame;
}

const std::shared_ptr<const CameraIntrinsics>& FrameBuilder::intrinsics() const {
  return state_->intrinsics;
}

void FrameBuilder::SetIntrinsics(const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  std::string error;
  if (!intrinsics->camera.IsValid(&error) ||
      !IsInvertible(intrinsics->distortion, intrinsics->camera, &error)) {
    throw std::invalid_argument("FrameBuilder: " + error);
  }
  if (!HasSameRegistration(*intrinsics, *state_->intrinsics)) state_->depth.Reset();
  state_->camera = intrinsics->camera;
  state_->distortion = intrinsics->distortion;
  state_->lens = LensRemap(intrinsics->camera, intrinsics->distortion);
  state_->intrinsics = intrinsics;
  state_->ResetPlanes();
}

const FrameBuilderTimes& FrameBuilder::times() const { return state_->times; }

DepthSensor FrameBuilder::depth_sensor() const { return state_->depth.sensor(); }

template <typename Archive>
void FrameBuilder::Serialize(Archive& archive) {
  archive(state_->depth);
}
template void FrameBuilder::Serialize(BinaryWriter& archive);
template void FrameBuilder::Serialize(BinaryReader& archive);

}  // namespace msc_vo
