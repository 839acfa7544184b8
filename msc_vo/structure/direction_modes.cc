// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/direction_modes.h"

#include <algorithm>
#include <cmath>

namespace msc_vo {

namespace {

using Eigen::Vector3d;

// Bandwidths beyond which the kernel, below 1 %, is truncated.
constexpr double kReach = 3.0;
// Mean-shift steps; each at least halves the distance of the densest member to the mode.
constexpr int kShifts = 5;

// Gaussian kernel of the angle between two undirected lines, by its sine; 0 beyond its reach.
class Kernel {
 public:
  explicit Kernel(double bandwidth)
      : scale_(-0.5 / (bandwidth * bandwidth)), reach_(std::pow(kReach * bandwidth, 2)) {}

  double operator()(double cosine) const {
    const double sine_squared = 1.0 - cosine * cosine;
    return sine_squared < reach_ ? std::exp(scale_ * sine_squared) : 0.0;
  }

 private:
  double scale_;
  double reach_;
};

std::vector<double> Densities(const std::vector<WeightedDirection>& directions,
                              const Kernel& kernel) {
  std::vector<double> densities(directions.size(), 0.0);
  for (size_t i = 0; i < directions.size(); ++i) {
    densities[i] += directions[i].weight;
    for (size_t j = 0; j < i; ++j) {
      const double k = kernel(directions[i].direction.dot(directions[j].direction));
      densities[i] += k * directions[j].weight;
      densities[j] += k * directions[i].weight;
    }
  }
  return densities;
}

Vector3d ClimbToMode(const std::vector<WeightedDirection>& directions, const Kernel& kernel,
                     const Vector3d& start) {
  Vector3d mode = start;
  for (int i = 0; i < kShifts; ++i) {
    Vector3d sum = Vector3d::Zero();
    for (const WeightedDirection& d : directions) {
      const double cosine = d.direction.dot(mode);
      sum += std::copysign(d.weight * kernel(cosine), cosine) * d.direction;
    }
    mode = sum.normalized();
  }
  return mode;
}

}  // namespace

std::vector<Vector3d> FindDirectionModes(const std::vector<WeightedDirection>& directions,
                                         double bandwidth, double separation, int max_modes) {
  const Kernel kernel(bandwidth);
  std::vector<double> densities = Densities(directions, kernel);
  std::vector<Vector3d> modes;
  while (static_cast<int>(modes.size()) < max_modes) {
    const auto densest = std::max_element(densities.begin(), densities.end());
    if (densest == densities.end() || *densest <= 0.0) break;
    const Vector3d start = directions[densest - densities.begin()].direction;
    const Vector3d mode = ClimbToMode(directions, kernel, start);
    const double near = std::cos(separation);
    const bool is_new = std::none_of(modes.begin(), modes.end(), [&](const Vector3d& other) {
      return std::abs(other.dot(mode)) > near;
    });
    if (is_new) modes.push_back(mode);
    for (size_t i = 0; i < directions.size(); ++i) {
      const bool is_claimed = std::abs(directions[i].direction.dot(mode)) > near ||
                              std::abs(directions[i].direction.dot(start)) > near;
      if (is_claimed) densities[i] = 0.0;
    }
  }
  return modes;
}

}  // namespace msc_vo
