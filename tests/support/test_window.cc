// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/support/test_window.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Cholesky>

#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

class TestWindowMaker {
 public:
  explicit TestWindowMaker(const TestWindowOptions& options)
      : options_(options), random_(options.seed), gross_(options.seed + 1000003u) {}

  TestWindow Make() {
    window_.truth.camera.fy = options_.fy;
    MakeKeyframes();
    MakeLandmarks();
    for (const auto& p : window_.truth.points) ObservePoint(p);
    for (const auto& l : window_.truth.lines) ObserveLine(l);
    AddGrossErrors();
    window_.data = window_.truth;
    Perturb();
    return window_;
  }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double Normal() { return normal_(random_); }
  Eigen::Vector3d Normal3(double sigma) {
    const double x = Normal(), y = Normal(), z = Normal();
    return sigma * Eigen::Vector3d(x, y, z);
  }

  void MakeKeyframes() {
    const bool straight = options_.lines_along_motion;
    for (int i = 0; i < options_.num_keyframes; ++i) {
      const double u = i - 0.5 * (options_.num_keyframes - 1);
      const Eigen::Vector3d centre(0.12 * u, straight ? 0.0 : 0.05 * std::sin(1.3 * i),
                                   straight ? 0.0 : 0.03 * u);
      const Eigen::Quaterniond turn =
          ExpSO3(Eigen::Vector3d(0.03 * std::cos(i), -0.02 * u, 0.02 * std::sin(i)));
      WindowData::Keyframe keyframe;
      keyframe.id = 100 + 3 * i;
      keyframe.cam_from_world = Rigid3(turn, -(turn * centre));
      keyframe.fixed = i < options_.num_fixed;
      window_.truth.keyframes.push_back(keyframe);
    }
  }

  Eigen::Vector3d InRoom() {
    const double x = Uniform(-1.6, 1.6), y = Uniform(-1.0, 1.0), z = Uniform(2.5, 5.0);
    return {x, y, z};
  }

  void MakeLandmarks() {
    for (int i = 0; i < options_.num_points; ++i) {
      window_.truth.points.push_back({1000 + 7 * i, InRoom(), false});
    }
    for (int i = 0; i < options_.num_lines; ++i) {
      LineSegment3 segment;
      segment.start = InRoom();
      segment.end = segment.start;
      const int axis = i % (options_.lines_along_motion ? 2 : 3);
      segment.end[axis] += segment.start[axis] > 0.0 && axis != 2 ? -0.8 : 0.8;
      window_.truth.lines.push_back({50 + 2 * i, segment, false});
    }
  }

  // Keyframes that observe a landmark: max_observations of them, spread over the window.
  std::vector<int> Observers(int landmark) const {
    const int count = std::min(options_.max_observations, options_.num_keyframes);
    std::vector<int> observers;
    for (int j = 0; j < count; ++j) {
      observers.push_back((landmark + j * options_.num_keyframes / count) % options_.num_keyframes);
    }
    return observers;
  }

  void ObservePoint(const WindowData::Point& point) {
    for (const int k : Observers(static_cast<int>(point.id) / 7)) {
      const WindowData::Keyframe& keyframe = window_.truth.keyframes[k];
      const Eigen::Vector3d x = keyframe.cam_from_world * point.position;
      WindowData::PointObservation o;
      o.keyframe = keyframe.id;
      o.point = point.id;
      o.sigma = options_.point_sigma;
      const double du = Normal(), dv = Normal(), dw = Normal();
      o.pixel =
          window_.truth.camera.Project(x) + options_.noise * o.sigma * Eigen::Vector2d(du, dv);
      if (options_.has_depth) {
        o.inverse_depth_sigma = options_.inverse_depth_sigma;
        o.inverse_depth = 1.0 / x.z() + options_.noise * o.inverse_depth_sigma * dw;
      }
      const bool is_outlier = Uniform(0.0, 1.0) < options_.outlier_ratio;
      // At least 15 px off, in any direction.
      const double angle = Uniform(-3.1, 3.1), radius = Uniform(15.0, 80.0);
      if (is_outlier) o.pixel += radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      window_.point_outliers.push_back(is_outlier);
      window_.truth.point_observations.push_back(o);
    }
  }

  void ObserveLine(const WindowData::Line& line) {
    for (const int k : Observers(static_cast<int>(line.id) / 2)) {
      const WindowData::Keyframe& keyframe = window_.truth.keyframes[k];
      const LineSegment3 in_cam = keyframe.cam_from_world * line.segment;
      // Every frame observes a different part of the line.
      const double first = Uniform(-0.05, 0.2), last = Uniform(0.8, 1.05);
      const Eigen::Vector3d start = in_cam.At(first), end = in_cam.At(last);
      WindowData::LineObservation o;
      o.keyframe = keyframe.id;
      o.line = line.id;
      o.sigma = options_.line_sigma;
      o.segment.start = window_.truth.camera.Project(start);
      o.segment.end = window_.truth.camera.Project(end);
      const Eigen::Vector2d d = o.segment.Direction();
      const Eigen::Vector2d across(-d.y(), d.x());
      const double ds = Normal(), de = Normal(), dws = Normal(), dwe = Normal();
      o.segment.start += options_.noise * o.sigma * ds * across;
      o.segment.end += options_.noise * o.sigma * de * across;
      const bool is_outlier = Uniform(0.0, 1.0) < options_.outlier_ratio;
      const double offset = Uniform(15.0, 60.0), tilt = Uniform(-5.0, 5.0);
      if (is_outlier) {
        o.segment.start += (offset + tilt) * across;
        o.segment.end += (offset - tilt) * across;
      }
      window_.line_outliers.push_back(is_outlier);
      o.has_depth = options_.has_depth;
      // As of a fit to many samples: smaller than that of one sample.
      const double variance = std::pow(0.5 * options_.inverse_depth_sigma, 2);
      const double covariance = options_.line_depth_correlation * variance;
      o.depth.covariance << variance, covariance, covariance, variance;
      const Eigen::Vector2d dw =
          Eigen::Matrix2d(o.depth.covariance.llt().matrixL()) * Eigen::Vector2d(dws, dwe);
      o.depth.start = 1.0 / start.z() + options_.noise * dw.x();
      o.depth.end = 1.0 / end.z() + options_.noise * dw.y();
      window_.truth.line_observations.push_back(o);
    }
  }

  void AddGrossErrors() {
    constexpr double kGrossError = 20.0;  // pixels
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    for (size_t i = 0; i < window_.point_outliers.size(); ++i) {
      const double chance = uniform(gross_), angle = 2.0 * kPi * uniform(gross_);
      if (chance >= options_.gross_error_ratio) continue;
      window_.point_outliers[i] = true;
      window_.truth.point_observations[i].pixel +=
          kGrossError * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
    for (size_t i = 0; i < window_.line_outliers.size(); ++i) {
      const double chance = uniform(gross_), side = uniform(gross_) < 0.5 ? -1.0 : 1.0;
      const bool at_start = uniform(gross_) < 0.5;
      if (chance >= options_.gross_error_ratio) continue;
      window_.line_outliers[i] = true;
      LineSegment2& segment = window_.truth.line_observations[i].segment;
      const Eigen::Vector2d d = segment.Direction();
      (at_start ? segment.start : segment.end) +=
          side * kGrossError * Eigen::Vector2d(-d.y(), d.x());
    }
  }

  void Perturb() {
    const double p = options_.perturbation;
    for (auto& k : window_.data.keyframes) {
      const Eigen::Vector3d w = Normal3(0.01 * p), u = Normal3(0.02 * p);
      if (k.fixed) continue;
      k.cam_from_world =
          Rigid3(ExpSO3(w) * k.cam_from_world.rotation(), k.cam_from_world.translation() + u);
    }
    for (auto& point : window_.data.points) point.position += Normal3(0.03 * p);
    for (auto& line : window_.data.lines) {
      line.segment.start += Normal3(0.03 * p);
      line.segment.end += Normal3(0.03 * p);
    }
  }

  TestWindowOptions options_;
  std::mt19937 random_;
  std::mt19937 gross_;
  std::normal_distribution<double> normal_;
  TestWindow window_;
};

}  // namespace

TestWindow MakeTestWindow(const TestWindowOptions& options) {
  return TestWindowMaker(options).Make();
}

bool SameState(const WindowData& a, const WindowData& b) {
  const auto same = [](const auto& x, const auto& y, const auto& is_equal) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(), is_equal);
  };
  return same(a.keyframes, b.keyframes,
              [](const auto& x, const auto& y) {
                return x.cam_from_world.params == y.cam_from_world.params;
              }) &&
         same(a.extra_blocks, b.extra_blocks,
              [](const auto& x, const auto& y) { return x.value == y.value; }) &&
         same(a.points, b.points,
              [](const auto& x, const auto& y) { return x.position == y.position; }) &&
         same(a.lines, b.lines, [](const auto& x, const auto& y) {
           return x.segment.start == y.segment.start && x.segment.end == y.segment.end;
         });
}

PoseData MakePoseData(const TestWindow& window, int k) {
  PoseData data;
  data.camera = window.truth.camera;
  const WindowData::Keyframe& keyframe = window.truth.keyframes[k];
  data.cam_from_world =
      Rigid3(ExpSO3(Eigen::Vector3d(0.01, -0.01, 0.01)) * keyframe.cam_from_world.rotation(),
             keyframe.cam_from_world.translation() + Eigen::Vector3d(0.02, 0.01, -0.02));
  for (const auto& o : window.truth.point_observations) {
    if (o.keyframe != keyframe.id) continue;
    PoseData::Point point;
    for (const auto& p : window.truth.points) {
      if (p.id == o.point) point.position = p.position;
    }
    point.pixel = o.pixel;
    point.sigma = o.sigma;
    point.inverse_depth = o.inverse_depth;
    point.inverse_depth_sigma = o.inverse_depth_sigma;
    data.points.push_back(point);
  }
  for (const auto& o : window.truth.line_observations) {
    if (o.keyframe != keyframe.id) continue;
    PoseData::Line line;
    for (const auto& l : window.truth.lines) {
      if (l.id == o.line) line.map_segment = l.segment;
    }
    line.segment = o.segment;
    line.sigma = o.sigma;
    line.has_depth = o.has_depth;
    line.depth = o.depth;
    data.lines.push_back(line);
  }
  return data;
}

}  // namespace msc_vo
