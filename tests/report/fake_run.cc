// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "fake_run.h"

#include <cmath>
#include <random>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"

namespace msc_vo {
namespace {

// A level camera (its y axis is -z of the world) with heading `yaw` in the x-y plane.
Rigid3 LevelCamera(double yaw, const Eigen::Vector3d& position) {
  Eigen::Matrix3d world_from_cam;
  world_from_cam.col(2) = Eigen::Vector3d(std::cos(yaw), std::sin(yaw), 0.0);
  world_from_cam.col(1) = -Eigen::Vector3d::UnitZ();
  world_from_cam.col(0) = world_from_cam.col(1).cross(world_from_cam.col(2));
  return {Eigen::Quaterniond(world_from_cam), position};
}

ReportStatus StatusOf(int frame) {
  if (frame < 40 || frame >= 60) return ReportStatus::kTracked;
  if (frame < 50) return ReportStatus::kWeak;
  return frame < 55 ? ReportStatus::kPredicted : ReportStatus::kLost;
}

void AddBox(const Eigen::Vector3d& low, const Eigen::Vector3d& high, ReportData* data) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Eigen::Vector3d start = low;
      if (corner & 1) start[(axis + 1) % 3] = high[(axis + 1) % 3];
      if (corner & 2) start[(axis + 2) % 3] = high[(axis + 2) % 3];
      Eigen::Vector3d end = start;
      end[axis] = high[axis];
      data->map.lines.push_back({{start, end}, axis});
    }
  }
}

}  // namespace

ReportData MakeFakeRun(int num_frames) {
  ReportData data;
  data.title = "a figure of eight";
  data.version = "msc_vo 0.1.0";
  data.command_line = "msc_vo replay eight --out eight-out";
  data.options_text = "mode: pl-vo-depth\n";
  data.numbers = {{"APE RMSE", "12.3 mm", "after SE(3) alignment"}, {"Coverage", "95 %", ""}};
  data.stages = {{"points", false}, {"lines", false}, {"features"}, {"matching"}, {"pose"}};
  std::mt19937 random(1);
  std::normal_distribution<double> noise;
  for (int i = 0; i < num_frames; ++i) {
    const double time = i / 30.0;
    const double phase = 0.4 * time;
    const Eigen::Vector3d truth(1.6 * std::sin(phase), 0.7 * std::sin(2.0 * phase),
                                1.4 + 0.05 * std::sin(5.0 * phase));
    const Eigen::Vector3d error(0.01 * std::sin(phase), 0.004 * noise(random), 0.01);
    ReportFrame frame;
    frame.timestamp = 100.0 + time;
    frame.status = StatusOf(i);
    frame.is_keyframe = i % 12 == 0;
    frame.world_from_cam = LevelCamera(std::sin(phase), truth + error);
    frame.position_error = error.norm();
    frame.num_points = 1000;
    frame.num_lines = 150;
    frame.num_inlier_points =
        frame.status == ReportStatus::kTracked ? 300 + static_cast<int>(40 * noise(random)) : 8;
    frame.num_inlier_lines = 60 + static_cast<int>(8 * noise(random));
    for (const double mean : {5.0, 9.0, 10.0, 3.0, 2.0}) {
      frame.stage_ms.push_back(mean * (1.0 + 0.1 * std::abs(noise(random))));
      if (data.stages[frame.stage_ms.size() - 1].is_stacked) {
        frame.tracking_ms += frame.stage_ms.back();
      }
    }
    frame.tracking_ms += 0.5;
    frame.mapping_ms = frame.is_keyframe ? 40.0 + 5.0 * std::abs(noise(random)) : 0.0;
    data.frames.push_back(frame);
    data.ground_truth.push_back({frame.timestamp, truth});
  }
  AddBox({-3.0, -2.0, 0.0}, {3.0, 2.0, 2.6}, &data);
  AddBox({-2.8, 1.2, 0.0}, {-1.2, 1.9, 0.8}, &data);
  return data;
}

}  // namespace msc_vo
