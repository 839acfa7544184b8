// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Embedding local bundle adjustment: fill a WindowData, call LocalBundleAdjustment, read the
// BundleAdjustmentSummary. Requires only the component `solver` (Eigen and Ceres). In an
// application, the front end takes the place of Observe(): it associates pixels with landmarks.
//
// The scene is a wall with a door frame, which a camera passes. Observations are exact; the initial
// poses and landmarks have errors of some centimetres.

#include <cmath>
#include <cstdio>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace {

// Adds the observations of all landmarks in a keyframe: undistorted pixels with their sigma
// (default: one pixel), and the inverse depth where it is measured.
void Observe(const msc_vo::WindowData::Keyframe& keyframe, msc_vo::WindowData* window) {
  for (const auto& point : window->points) {
    const Eigen::Vector3d x_in_cam = keyframe.cam_from_world * point.position;
    msc_vo::WindowData::PointObservation observation;
    observation.keyframe = keyframe.id;
    observation.point = point.id;
    observation.pixel = window->camera.Project(x_in_cam);
    observation.inverse_depth = 1.0 / x_in_cam.z();
    observation.inverse_depth_sigma = 1.4e-3;  // 1/metres: a Kinect
    window->point_observations.push_back(observation);
  }
  for (const auto& line : window->lines) {
    const msc_vo::LineSegment3 in_cam = keyframe.cam_from_world * line.segment;
    msc_vo::WindowData::LineObservation observation;
    observation.keyframe = keyframe.id;
    observation.line = line.id;
    observation.segment = {window->camera.Project(in_cam.start),
                           window->camera.Project(in_cam.end)};
    window->line_observations.push_back(observation);
  }
}

msc_vo::WindowData MakeWindow() {
  msc_vo::WindowData window;
  window.camera = {525.0, 525.0, 319.5, 239.5, 640, 480};  // fx, fy, cx, cy, width, height

  // Landmarks, metres: points on a wall that is not planar; the two posts and the lintel of a door.
  for (int i = 0; i < 40; ++i) {
    window.points.push_back({i, {0.25 * (i % 8) - 0.7, 0.3 * (i / 8) - 0.6, 3.0 + 0.1 * (i % 3)}});
  }
  const Eigen::Vector3d left(-0.2, -0.7, 2.8), right(0.7, -0.7, 2.8), post(0.0, 1.4, 0.0);
  window.lines = {{0, {left, left + post}}, {1, {right, right + post}}, {2, {left, right}}};

  // Structural constraints: pairs of lines with the sigma of the angle between them, radians.
  window.parallel_pairs = {{0, 1, 0.02}};
  window.perpendicular_pairs = {{0, 2, 0.02}, {1, 2, 0.02}};

  // Poses are cam_from_world; ids are arbitrary. The first keyframe is fixed, which fixes the
  // gauge.
  for (int i = 0; i < 5; ++i) {
    const msc_vo::Rigid3 pose(Eigen::Quaterniond::Identity(), {-0.1 * i, 0.0, 0.0});
    window.keyframes.push_back({100 + i, pose, i == 0});
    Observe(window.keyframes.back(), &window);
  }
  return window;
}

// Adds errors of up to 3 cm to everything that is not fixed.
void Disturb(msc_vo::WindowData* window) {
  double phase = 0.0;
  const auto offset = [&phase]() -> Eigen::Vector3d {
    phase += 1.0;
    return 0.03 * Eigen::Vector3d(std::sin(phase), std::sin(2.1 * phase), std::sin(3.3 * phase));
  };
  for (auto& keyframe : window->keyframes) {
    if (!keyframe.fixed) keyframe.cam_from_world.translation() += offset();
  }
  for (auto& point : window->points) point.position += offset();
  for (auto& line : window->lines) line.segment.start += offset();
}

double LargestError(const msc_vo::WindowData& window, const msc_vo::WindowData& truth) {
  double largest = 0.0;
  for (size_t i = 0; i < window.keyframes.size(); ++i) {
    const Eigen::Vector3d error = window.keyframes[i].cam_from_world.translation() -
                                  truth.keyframes[i].cam_from_world.translation();
    largest = std::fmax(largest, error.norm());
  }
  return largest;
}

}  // namespace

int main() {
  const msc_vo::WindowData truth = MakeWindow();
  msc_vo::WindowData window = truth;
  Disturb(&window);

  const double before = LargestError(window, truth);
  const msc_vo::BundleAdjustmentSummary summary =
      msc_vo::LocalBundleAdjustment(msc_vo::BundleAdjustmentOptions(), &window);
  const double after = LargestError(window, truth);

  std::printf("%s\nlargest error of a pose: %.1f mm before, %.1e mm after\n",
              summary.BriefReport().c_str(), 1000.0 * before, 1000.0 * after);
  return summary.usable && after < 1e-4 ? 0 : 1;
}
