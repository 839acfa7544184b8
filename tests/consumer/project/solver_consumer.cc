// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A window of two keyframes that see twelve points, one keyframe displaced: the solver must bring
// it back. Nothing here but plain data; no images, no files.

#include <cstdio>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/version.h"

int main() {
  msc_vo::WindowData window;
  const msc_vo::Rigid3 truth(Eigen::Quaterniond::Identity(), {-0.1, 0.0, 0.0});
  window.keyframes.resize(2);
  window.keyframes[0].fixed = true;
  window.keyframes[1].id = 1;
  for (int i = 0; i < 12; ++i) {
    msc_vo::WindowData::Point point;
    point.id = i;
    point.position = {0.3 * (i % 4) - 0.5, 0.3 * (i / 4) - 0.3, 2.0 + 0.1 * (i % 5)};
    window.points.push_back(point);
    for (const int64_t keyframe : {0, 1}) {
      const Eigen::Vector3d x_in_cam = keyframe == 0 ? point.position : truth * point.position;
      msc_vo::WindowData::PointObservation observation;
      observation.keyframe = keyframe;
      observation.point = i;
      observation.pixel = window.camera.Project(x_in_cam);
      observation.inverse_depth = 1.0 / x_in_cam.z();
      observation.inverse_depth_sigma = 1e-3;
      window.point_observations.push_back(observation);
    }
  }
  window.keyframes[1].cam_from_world = msc_vo::Rigid3(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY())), {-0.08, 0.01, 0.0});

  const msc_vo::BundleAdjustmentSummary summary =
      msc_vo::LocalBundleAdjustment(msc_vo::BundleAdjustmentOptions(), &window);
  const double error =
      (window.keyframes[1].cam_from_world.translation() - truth.translation()).norm();
  std::printf("msc_vo %s: %s\nposition error %.2e m\n", msc_vo::kVersion,
              summary.BriefReport().c_str(), error);
  return summary.usable && error < 1e-4 ? 0 : 1;
}
