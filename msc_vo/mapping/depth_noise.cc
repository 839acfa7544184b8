// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/depth_noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

namespace msc_vo {

namespace {

// Residuals count up to this many robust standard deviations: single gross errors (an edge, a
// mirror) are left to the solver's own tests.
constexpr double kMaxResidual = 3.0;
// Median of the absolute value of a standard normal variable.
constexpr double kNormalMedian = 0.6745;

struct DepthResidual {
  int64_t keyframe = 0;
  int quarter = 0;     // of its image
  double value = 0.0;  // in sigmas
  // Its variance, if errors were independent: the landmark has cost its n depths one degree of
  // freedom.
  double expected = 0.0;  // 1 - 1 / n
};

int QuarterOf(const PinholeCamera& camera, const Eigen::Vector2d& pixel) {
  return (pixel.x() < 0.5 * camera.width ? 0 : 1) + (pixel.y() < 0.5 * camera.height ? 0 : 2);
}

class ResidualReader {
 public:
  explicit ResidualReader(const WindowData& window) : window_(window) {
    for (const WindowData::Keyframe& keyframe : window.keyframes) {
      poses_[keyframe.id] = &keyframe.cam_from_world;
    }
  }

  std::vector<DepthResidual> OfPoints() const {
    std::map<int64_t, const Eigen::Vector3d*> positions;
    for (const WindowData::Point& point : window_.points) positions[point.id] = &point.position;
    std::map<int64_t, int> num_depths;
    for (const auto& o : window_.point_observations) num_depths[o.point] += HasDepth(o);
    std::vector<DepthResidual> residuals;
    for (const auto& o : window_.point_observations) {
      if (!HasDepth(o)) continue;
      const double z = (*poses_.at(o.keyframe) * *positions.at(o.point)).z();
      residuals.push_back({o.keyframe, QuarterOf(window_.camera, o.pixel),
                           (1.0 / z - o.inverse_depth) / o.inverse_depth_sigma,
                           1.0 - 1.0 / num_depths.at(o.point)});
    }
    return residuals;
  }

  // At the middle of each segment.
  std::vector<DepthResidual> OfLines() const {
    std::map<int64_t, const LineSegment3*> segments;
    for (const WindowData::Line& line : window_.lines) segments[line.id] = &line.segment;
    std::map<int64_t, int> num_depths;
    for (const auto& o : window_.line_observations) num_depths[o.line] += HasDepth(o);
    std::vector<DepthResidual> residuals;
    for (const auto& o : window_.line_observations) {
      if (!HasDepth(o)) continue;
      const double w =
          InverseDepthAt(0.5, o.segment, *poses_.at(o.keyframe) * *segments.at(o.line));
      residuals.push_back({o.keyframe, QuarterOf(window_.camera, o.segment.At(0.5)),
                           (w - o.depth.At(0.5)) / o.depth.SigmaAt(0.5),
                           1.0 - 1.0 / num_depths.at(o.line)});
    }
    return residuals;
  }

 private:
  static bool HasDepth(const WindowData::PointObservation& o) {
    return !o.rejected && o.inverse_depth > 0.0;
  }
  static bool HasDepth(const WindowData::LineObservation& o) { return !o.rejected && o.has_depth; }

  // Of the line, camera frame, at parameter s of the image segment: there 1/z is linear.
  double InverseDepthAt(double s, const LineSegment2& image, const LineSegment3& in_cam) const {
    const Eigen::Vector2d along = image.end - image.start;
    const auto parameter = [&](const Eigen::Vector3d& x) {
      return (window_.camera.Project(x) - image.start).dot(along) / along.squaredNorm();
    };
    const double start = parameter(in_cam.start), end = parameter(in_cam.end);
    const double share = (s - start) / (end - start);
    return (1.0 - share) / in_cam.start.z() + share / in_cam.end.z();
  }

  const WindowData& window_;
  std::map<int64_t, const Rigid3*> poses_;
};

// Standard deviation by the median of the absolute values.
double RobustDeviation(const std::vector<DepthResidual>& residuals) {
  std::vector<double> sizes;
  sizes.reserve(residuals.size());
  for (const DepthResidual& residual : residuals) sizes.push_back(std::abs(residual.value));
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle / kNormalMedian;
}

// Sums over quarters of images: the mean of their squares, relative to independent errors.
struct QuarterSums {
  double variance = 1.0;
  int num_quarters = 0;
};

QuarterSums SumQuarters(const std::vector<DepthResidual>& residuals) {
  struct Sum {
    double value = 0.0;
    double expected = 0.0;
  };
  if (residuals.empty()) return {};
  const double bound = kMaxResidual * RobustDeviation(residuals);
  std::map<std::pair<int64_t, int>, Sum> quarters;
  for (const DepthResidual& residual : residuals) {
    Sum& sum = quarters[{residual.keyframe, residual.quarter}];
    sum.value += std::clamp(residual.value, -bound, bound);
    sum.expected += residual.expected;
  }
  double squares = 0.0;
  double expected = 0.0;
  for (const auto& [where, sum] : quarters) {
    squares += sum.value * sum.value;
    expected += sum.expected;
  }
  if (expected <= 0.0) return {};
  return {squares / expected, static_cast<int>(quarters.size())};
}

}  // namespace

bool DepthNoiseOptions::IsValid(std::string* error) const {
  if (!(prior > 0.0 && memory >= prior)) {
    *error = "depth_noise: prior must be positive, and memory not less";
  } else if (!(max_scale >= 1.0)) {
    *error = "depth_noise.max_scale must be at least 1";
  } else {
    return true;
  }
  return false;
}

DepthNoise::DepthNoise(const DepthNoiseOptions& options) : options_(options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
  points_.weight = lines_.weight = options.prior;
}

double DepthNoise::Scale(const Variance& variance) const {
  return std::clamp(std::sqrt(variance.value), 1.0 / options_.max_scale, options_.max_scale);
}

DepthScale DepthNoise::scale() const { return {Scale(points_), Scale(lines_)}; }

void DepthNoise::Apply(WindowData* window) const {
  const auto [points, lines] = scale();
  for (WindowData::PointObservation& o : window->point_observations) {
    o.inverse_depth_sigma *= points;
  }
  for (WindowData::LineObservation& o : window->line_observations) {
    o.depth.covariance *= lines * lines;
  }
}

void DepthNoise::Update(const WindowData& solved) {
  if (!options_.enabled) return;
  const auto learn = [this](const std::vector<DepthResidual>& residuals, Variance* variance) {
    const QuarterSums sums = SumQuarters(residuals);
    const double scale = Scale(*variance);  // the window was whitened with it
    const double total = variance->weight + sums.num_quarters;
    variance->value =
        (variance->weight * variance->value + sums.num_quarters * scale * scale * sums.variance) /
        total;
    variance->weight = std::min(total, options_.memory);
  };
  const ResidualReader reader(solved);
  learn(reader.OfPoints(), &points_);
  learn(reader.OfLines(), &lines_);
}

}  // namespace msc_vo
