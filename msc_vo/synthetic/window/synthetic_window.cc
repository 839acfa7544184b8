// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/window/synthetic_window.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/synthetic/scene/camera_path.h"
#include "msc_vo/synthetic/scene/random.h"

namespace msc_vo {

namespace {

constexpr double kMinDepth = 0.4, kMaxDepth = 5.0;  // metres, the range of a Kinect
constexpr double kMinLength = 30.0;                 // pixels; minimum length of a line detector
constexpr int kLineSamples = 17;                    // of the visibility test along a line
constexpr int kDepthSamples = 20;                   // of the depth regression along a line
constexpr double kOnSurface = 2e-3;  // metres; a surface this close to a point does not occlude it
constexpr double kMinOutlier = 20.0, kMaxOutlier = 100.0;  // error of outliers, pixels

// Independent random streams, so that noise does not change visibility.
enum Stream : uint64_t { kLandmarks = 1, kMeasurements, kOutliers, kInitialState };

// Covariance of the regression w(s) = (1 - s) start + s end on evenly spaced samples.
Eigen::Matrix2d LineDepthCovariance(double sigma) {
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (int i = 0; i < kDepthSamples; ++i) {
    const double s = static_cast<double>(i) / (kDepthSamples - 1);
    const Eigen::Vector2d row(1.0 - s, s);
    information += row * row.transpose();
  }
  return sigma * sigma * information.inverse();
}

// Creates keyframes, landmarks and exact observations.
class WindowObserver {
 public:
  WindowObserver(const SyntheticWindowOptions& options, const Scene& scene)
      : options_(options), scene_(scene), random_(options.seed, kLandmarks) {}

  WindowData Observe() {
    data_.camera = options_.camera;
    PathOptions path_options;
    path_options.seed = options_.seed;
    const CameraPath path(scene_, path_options);
    for (int i = 0; i < options_.num_keyframes; ++i) {
      data_.keyframes.push_back(
          {i, path.CamFromWorld(i * options_.keyframe_interval), i < options_.num_fixed});
    }
    ObservePoints();
    ObserveLines();
    return std::move(data_);
  }

 private:
  void ObservePoints();
  void ObserveLines();

  bool IsVisible(const Rigid3& cam_from_world, const Eigen::Vector3d& x_in_world) const {
    const Eigen::Vector3d x = cam_from_world * x_in_world;
    if (x.z() < kMinDepth || x.z() > kMaxDepth) return false;
    if (!options_.camera.IsInside(options_.camera.Project(x))) return false;
    const Eigen::Vector3d center = cam_from_world.OriginInSource();
    const std::optional<double> hit = scene_.CastRay(center, x_in_world - center);
    return !hit || *hit > 1.0 - kOnSurface / x.norm();
  }

  // Returns the longest visible part of a segment, if it is long enough in the image.
  std::optional<LineSegment3> VisiblePart(const Rigid3& cam_from_world,
                                          const LineSegment3& segment) const {
    int best_first = 0, best_length = 0, length = 0;
    for (int i = 0; i < kLineSamples; ++i) {
      const double s = static_cast<double>(i) / (kLineSamples - 1);
      length = IsVisible(cam_from_world, segment.At(s)) ? length + 1 : 0;
      if (length > best_length) {
        best_length = length;
        best_first = i - length + 1;
      }
    }
    if (best_length < 2) return std::nullopt;
    const double step = 1.0 / (kLineSamples - 1);
    const LineSegment3 part{segment.At(best_first * step),
                            segment.At((best_first + best_length - 1) * step)};
    if (Project(cam_from_world, part).Length() < kMinLength) return std::nullopt;
    return part;
  }

  LineSegment2 Project(const Rigid3& cam_from_world, const LineSegment3& segment) const {
    const LineSegment3 in_cam = cam_from_world * segment;
    return {options_.camera.Project(in_cam.start), options_.camera.Project(in_cam.end)};
  }

  WindowData::LineObservation ObserveLine(const WindowData::Keyframe& keyframe, int64_t line,
                                          const LineSegment3& part) const;

  const SyntheticWindowOptions& options_;
  const Scene& scene_;
  Random random_;
  WindowData data_;
};

void WindowObserver::ObservePoints() {
  const PinholeCamera& camera = options_.camera;
  // Limits the attempts; most rays hit a surface that a second keyframe observes.
  for (int tries = 20 * options_.num_points; tries > 0; --tries) {
    if (static_cast<int>(data_.points.size()) == options_.num_points) break;
    const Rigid3 world_from_cam =
        data_.keyframes[random_.Index(options_.num_keyframes)].cam_from_world.Inverse();
    const double x = random_.Uniform(0, camera.width - 1);
    const Eigen::Vector3d ray = camera.Ray({x, random_.Uniform(0, camera.height - 1)});
    const Eigen::Vector3d center = world_from_cam.translation();
    const Eigen::Vector3d direction = world_from_cam.rotation() * ray;
    const std::optional<double> hit = scene_.CastRay(center, direction);
    if (!hit) continue;
    const WindowData::Point point{static_cast<int64_t>(data_.points.size()),
                                  center + *hit * direction, false};
    std::vector<WindowData::PointObservation> observations;
    for (const WindowData::Keyframe& keyframe : data_.keyframes) {
      if (!IsVisible(keyframe.cam_from_world, point.position)) continue;
      const Eigen::Vector3d in_cam = keyframe.cam_from_world * point.position;
      observations.push_back({keyframe.id, point.id, camera.Project(in_cam), options_.point_sigma,
                              options_.depth ? 1.0 / in_cam.z() : 0.0,
                              options_.depth ? options_.inverse_depth_sigma : 0.0, false});
    }
    if (observations.size() < 2) continue;
    data_.points.push_back(point);
    data_.point_observations.insert(data_.point_observations.end(), observations.begin(),
                                    observations.end());
  }
}

void WindowObserver::ObserveLines() {
  std::vector<LineSegment3> edges = scene_.edges;
  for (size_t i = edges.size(); i > 1; --i) {
    std::swap(edges[i - 1], edges[random_.Index(static_cast<int>(i))]);
  }
  for (const LineSegment3& edge : edges) {
    if (static_cast<int>(data_.lines.size()) == options_.num_lines) break;
    WindowData::Line line{static_cast<int64_t>(data_.lines.size()), edge, false};
    std::vector<WindowData::LineObservation> observations;
    for (const WindowData::Keyframe& keyframe : data_.keyframes) {
      const std::optional<LineSegment3> part = VisiblePart(keyframe.cam_from_world, line.segment);
      if (!part) continue;
      if (observations.empty()) line.segment = *part;
      // The end points of the landmark must be in front of the camera.
      const LineSegment3 in_cam = keyframe.cam_from_world * line.segment;
      if (std::min(in_cam.start.z(), in_cam.end.z()) < kMinDepth) continue;
      observations.push_back(ObserveLine(keyframe, line.id, *part));
    }
    if (observations.size() < 2) continue;
    data_.lines.push_back(line);
    data_.line_observations.insert(data_.line_observations.end(), observations.begin(),
                                   observations.end());
  }
}

WindowData::LineObservation WindowObserver::ObserveLine(const WindowData::Keyframe& keyframe,
                                                        int64_t line,
                                                        const LineSegment3& part) const {
  WindowData::LineObservation observation;
  observation.keyframe = keyframe.id;
  observation.line = line;
  observation.segment = Project(keyframe.cam_from_world, part);
  observation.sigma = options_.line_sigma;
  observation.has_depth = options_.depth;
  if (!options_.depth) return observation;
  const LineSegment3 in_cam = keyframe.cam_from_world * part;
  observation.depth = {1.0 / in_cam.start.z(), 1.0 / in_cam.end.z(),
                       LineDepthCovariance(options_.inverse_depth_sigma), kDepthSamples, 1.0};
  return observation;
}

// Moves both end points of a segment across it, pixels.
void ShiftAcross(double start, double end, LineSegment2* segment) {
  const Eigen::Vector2d normal = ImageLine(*segment).head<2>();
  segment->start += start * normal;
  segment->end += end * normal;
}

void AddMeasurementNoise(uint64_t seed, WindowData* data) {
  Random random(seed, kMeasurements);
  for (WindowData::PointObservation& observation : data->point_observations) {
    observation.pixel += observation.sigma * random.Normal2();
    if (observation.inverse_depth > 0.0) {
      observation.inverse_depth += observation.inverse_depth_sigma * random.Normal();
    }
  }
  for (WindowData::LineObservation& observation : data->line_observations) {
    const Eigen::Vector2d across = observation.sigma * random.Normal2();
    ShiftAcross(across.x(), across.y(), &observation.segment);
    if (!observation.has_depth) continue;
    const Eigen::Vector2d noise = observation.depth.covariance.llt().matrixL() * random.Normal2();
    observation.depth.start += noise.x();
    observation.depth.end += noise.y();
  }
}

// Replaces a fraction of the observations by outliers and marks them.
void AddOutliers(const SyntheticWindowOptions& options, SyntheticWindow* window) {
  Random random(options.seed, kOutliers);
  for (WindowData::PointObservation& observation : window->data.point_observations) {
    const double angle = random.Uniform(0.0, 2.0 * kPi);
    const double distance = random.Uniform(kMinOutlier, kMaxOutlier);
    window->point_outliers.push_back(random.Uniform() < options.outlier_ratio);
    if (!window->point_outliers.back()) continue;
    observation.pixel += distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  for (WindowData::LineObservation& observation : window->data.line_observations) {
    const double start = random.Uniform(kMinOutlier, kMaxOutlier);
    const double end = random.Uniform(kMinOutlier, kMaxOutlier);
    window->line_outliers.push_back(random.Uniform() < options.outlier_ratio);
    if (window->line_outliers.back()) ShiftAcross(start, end, &observation.segment);
  }
}

void PerturbState(const SyntheticWindowOptions& options, WindowData* data) {
  Random random(options.seed, kInitialState);
  for (WindowData::Keyframe& keyframe : data->keyframes) {
    const Rigid3 noise(ExpSO3(options.start_rotation_sigma * random.Normal3()),
                       options.start_translation_sigma * random.Normal3());
    if (!keyframe.fixed) keyframe.cam_from_world = noise * keyframe.cam_from_world;
  }
  for (WindowData::Point& point : data->points) {
    point.position += options.start_point_sigma * random.Normal3();
  }
  for (WindowData::Line& line : data->lines) {
    line.segment.start += options.start_line_sigma * random.Normal3();
    line.segment.end += options.start_line_sigma * random.Normal3();
  }
}

}  // namespace

bool SyntheticWindowOptions::IsValid(std::string* error) const {
  if (!camera.IsValid(error)) return false;
  if (num_keyframes < 2 || num_fixed < 0 || num_fixed > num_keyframes) {
    *error = "needs num_keyframes >= 2 and 0 <= num_fixed <= num_keyframes";
  } else if (!(keyframe_interval > 0.0)) {
    *error = "keyframe_interval must be positive";
  } else if (num_points < 0 || num_lines < 0) {
    *error = "num_points and num_lines must not be negative";
  } else if (!(point_sigma > 0.0 && line_sigma > 0.0 && inverse_depth_sigma > 0.0)) {
    *error = "point_sigma, line_sigma and inverse_depth_sigma must be positive";
  } else if (!(outlier_ratio >= 0.0 && outlier_ratio <= 1.0)) {
    *error = "outlier_ratio must be from 0 to 1";
  } else if (!(start_rotation_sigma >= 0.0 && start_translation_sigma >= 0.0 &&
               start_point_sigma >= 0.0 && start_line_sigma >= 0.0)) {
    *error = "the start_*_sigma must not be negative";
  } else {
    return true;
  }
  return false;
}

SyntheticWindow MakeSyntheticWindow(const SyntheticWindowOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("MakeSyntheticWindow: " + error);
  const Scene scene = MakeScene(options.scene, options.seed);
  SyntheticWindow window;
  window.truth = WindowObserver(options, scene).Observe();
  window.data = window.truth;
  if (options.noise) AddMeasurementNoise(options.seed, &window.data);
  AddOutliers(options, &window);
  PerturbState(options, &window.data);
  return window;
}

}  // namespace msc_vo
