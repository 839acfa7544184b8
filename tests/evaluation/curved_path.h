// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <random>
#include <vector>

#include "msc_vo/geometry/so3.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {

// A smooth trajectory similar to a hand-held camera's: `count` poses at `rate` Hz, from time 10 s.
inline std::vector<TimedPose> CurvedPath(int count, double rate) {
  std::vector<TimedPose> poses;
  for (int i = 0; i < count; ++i) {
    const double t = i / rate;
    const Eigen::Vector3d position(std::sin(0.7 * t), 0.3 * std::cos(1.3 * t), 0.4 * t);
    const Eigen::Quaterniond rotation =
        ExpSO3({0.3 * std::sin(t), 0.5 * t, 0.2 * std::cos(0.5 * t)});
    poses.push_back({10.0 + t, Rigid3(rotation, position)});
  }
  return poses;
}

// Adds seeded Gaussian noise to the poses: metres, radians, seconds.
inline std::vector<TimedPose> Disturbed(std::vector<TimedPose> poses, double translation_sigma,
                                        double rotation_sigma, double time_sigma, int seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&](double sigma) {
    const double x = sigma * normal(random);
    const double y = sigma * normal(random);
    return Eigen::Vector3d(x, y, sigma * normal(random));
  };
  for (TimedPose& pose : poses) {
    const Eigen::Vector3d translation =
        pose.world_from_cam.translation() + vector(translation_sigma);
    const Eigen::Quaterniond rotation =
        pose.world_from_cam.rotation() * ExpSO3(vector(rotation_sigma));
    pose = {pose.timestamp + time_sigma * normal(random), Rigid3(rotation, translation)};
  }
  return poses;
}

// Writes the poses as a TUM file with all their digits.
inline void WriteExactly(const std::filesystem::path& path, const std::vector<TimedPose>& poses) {
  std::ofstream file(path);
  file << std::setprecision(17);
  for (const TimedPose& pose : poses) {
    file << pose.timestamp << ' ' << pose.world_from_cam.translation().transpose() << ' '
         << pose.world_from_cam.rotation().coeffs().transpose() << '\n';
  }
}

}  // namespace msc_vo
