// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/line_backprojection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "msc_vo/geometry/cell_index.h"

namespace msc_vo {

namespace {

using Eigen::Vector2d;

// Spacing of the samples along a line, pixels: the shortest line, 24 px, has 8.
constexpr double kSpacing = 3.0;
constexpr int kMaxIntervals = 1 << 14;  // more than the diagonal of any image needs
// Error common to all samples of a line, in sigmas of a pixel: the registration of depth to colour
// edges is accurate to half a pixel, and the depth of a wall at 45 degrees and 1 m changes by 1
// sigma per pixel. Chosen by measurement, see docs/lab/depth.md.
constexpr double kCommonNoise = 0.5;
// Length of the profile on each side of the line, pixels.
constexpr int kReach = 5;
// A surface reaches the line if it comes this close, pixels: one for the position of the edge, one
// for the mixed pixel that sensors insert between two surfaces. The sensor's edge gap is added.
constexpr int kMaxPixelDistance = 2;
// There is a depth edge between two pixels of a profile if their difference exceeds those of their
// neighbours by this many sigmas: three times the standard deviation of such a difference,
// sqrt(3) sigma.
constexpr double kLineEdgeSigmas = 5.2;
// Smallest number of pixels of a surface; a single one is a mixed pixel.
constexpr int kMinSurface = 2;
// The depth of a surface at the line is fitted to its pixel nearest to the line and this many
// pixels beyond. Chosen by measurement, see docs/lab/depth.md.
constexpr int kFitReach = 3;
// Weak prior on the slope of a surface across the line, sigmas per pixel, for surfaces of few
// pixels: the slope of a wall at 45 degrees and 1 m is 1.
constexpr double kSlopeSigma = 3.0;
// Two surfaces differ in depth if their difference exceeds this many of its sigmas: 99 % quantile
// of a normal deviate.
constexpr double kSameSigmas = 2.576;
// Sensors drop pixels of either surface beside a depth edge, so the surface that the line belongs
// to may appear to end before it. If both surfaces are equally likely, the standard deviation of
// the line's depth is this fraction of their difference.
constexpr double kEdgeInflation = 0.5;
constexpr double kEndPointRadius = 2.0;

// Inverse depths at offsets -kReach .. kReach across the line; 0 where nothing was measured.
using Profile = std::array<double, 2 * kReach + 1>;

// A surface in a profile: its consecutive pixels, indices first .. last.
struct Surface {
  int first = 0;
  int last = 0;

  // Offset of the surface's pixel nearest to the line.
  int NearestOffset() const { return std::clamp(0, first - kReach, last - kReach); }
  int Size() const { return last - first + 1; }
};

// Absolute differences between pixels i - 1 and i of a profile; infinite where one of them is
// missing, and at both ends.
using Steps = std::array<double, 2 * kReach + 2>;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Steps StepsOf(const Profile& profile) {
  Steps steps;
  steps.front() = steps.back() = kInfinity;
  for (size_t i = 1; i < profile.size(); ++i) {
    const bool measured = profile[i - 1] > 0.0 && profile[i] > 0.0;
    steps[i] = measured ? std::abs(profile[i] - profile[i - 1]) : kInfinity;
  }
  return steps;
}

// True if there is a depth edge between pixels i - 1 and i. The steps of steep surfaces are large
// too, but similar to the neighbouring steps.
bool IsDepthEdge(const Steps& steps, int i, double sigma) {
  const double usual = std::min(steps[i - 1], steps[i + 1]);
  return steps[i] - (usual < kInfinity ? usual : 0.0) > kLineEdgeSigmas * sigma;
}

// The surfaces of a profile, in order; there are at most as many as pixels.
struct Surfaces {
  std::array<Surface, 2 * kReach + 1> data;
  int count = 0;

  const Surface* begin() const { return data.data(); }
  const Surface* end() const { return data.data() + count; }
};

Surfaces SplitAtDepthEdges(const Profile& profile, double sigma) {
  const Steps steps = StepsOf(profile);
  Surfaces surfaces;
  for (int i = 0; i < static_cast<int>(profile.size()); ++i) {
    if (profile[i] <= 0.0) continue;
    // A missing pixel separates surfaces, because the step after it is infinite.
    if (surfaces.count > 0 && !IsDepthEdge(steps, i, sigma)) {
      surfaces.data[surfaces.count - 1].last = i;
    } else {
      surfaces.data[surfaces.count++] = {i, i};
    }
  }
  return surfaces;
}

// Inverse depth of a surface at the line (offset 0).
struct DepthAtLine {
  double w = 0.0;  // 1/metres
  // Standard deviation in units of a pixel's. The noise of neighbouring pixels is correlated, so
  // their mean is as uncertain as one pixel; extrapolation is added.
  double sigma = 1.0;
  // Standard deviation that is common to all samples of the line: the surface may be the wrong one,
  // 1/metres.
  double edge_sigma = 0.0;
};

// Sums over the pixels of a surface on one side of the line: offsets x and inverse depths w.
struct Side {
  double x = 0.0;
  double xx = 1.0 / (kSlopeSigma * kSlopeSigma);
  double xw = 0.0;
};

// Least-squares fit with separate slopes on the two sides of the line, w(x) = w + slope x. Most
// lines indoors are folds, where the mean across the line is biased: nearer than the fold of two
// walls, farther than the edge of a box.
DepthAtLine FitAtLine(const Profile& profile, const Surface& surface) {
  const int center = kReach + surface.NearestOffset();
  std::array<Side, 2> sides;
  double information = 0.0;
  double rhs = 0.0;
  const int begin = std::max(surface.first, center - kFitReach);
  const int end = std::min(surface.last, center + kFitReach) + 1;
  for (int i = begin; i < end; ++i) {
    const double x = i - kReach;
    Side& side = sides[x > 0.0];
    side.x += x;
    side.xx += x * x;
    side.xw += x * profile[i];
    information += 1.0;
    rhs += profile[i];
  }
  for (const Side& side : sides) {
    information -= side.x * side.x / side.xx;
    rhs -= side.x * side.xw / side.xx;
  }
  return {rhs / information, std::sqrt(1.0 + 1.0 / information), 0.0};
}

// Returns the depth of the nearest surface that reaches the line. If the depths of two surfaces do
// not differ significantly, the one with the smaller sigma is returned: always selecting the nearer
// one would bias depths towards the camera. A nearer surface that ends before the line inflates the
// variance.
std::optional<DepthAtLine> NearestSurfaceDepth(const Profile& profile, double sigma,
                                               int max_distance) {
  std::optional<DepthAtLine> nearest;
  double nearest_beside = 0.0;  // among the surfaces that do not reach the line
  for (const Surface& surface : SplitAtDepthEdges(profile, sigma)) {
    if (surface.Size() < kMinSurface) continue;
    const DepthAtLine depth = FitAtLine(profile, surface);
    if (std::abs(surface.NearestOffset()) > max_distance) {
      nearest_beside = std::max(nearest_beside, depth.w);
      continue;
    }
    const double margin =
        nearest ? kSameSigmas * sigma * std::hypot(depth.sigma, nearest->sigma) : 0.0;
    const bool is_same = nearest && std::abs(depth.w - nearest->w) <= margin;
    if (!nearest || (is_same ? depth.sigma < nearest->sigma : depth.w > nearest->w)) {
      nearest = depth;
    }
  }
  if (nearest && nearest_beside - nearest->w > kLineEdgeSigmas * sigma) {
    nearest->edge_sigma = kEdgeInflation * (nearest_beside - nearest->w);
  }
  return nearest;
}

struct DepthSamples {
  std::vector<LineFitSample> along;
  double sigma = 0.0;       // 1/metres, largest noise of a pixel
  double edge_sigma = 0.0;  // 1/metres, mean of DepthAtLine::edge_sigma
};

// Samples the inverse depth along `segment` (pixels, undistorted) every kSpacing pixels.
DepthSamples SampleLineDepth(const InverseDepthImage& image, const LensRemap& lens,
                             const LineSegment2& segment, const DepthNoise& noise) {
  const Vector2d direction = segment.Direction();
  const Vector2d across(-direction.y(), direction.x());
  const int intervals = std::max(1, CellIndex(segment.Length() / kSpacing, kMaxIntervals));
  DepthSamples samples;
  samples.along.reserve(intervals + 1);
  for (int i = 0; i <= intervals; ++i) {
    const double s = static_cast<double>(i) / intervals;
    const Vector2d raw = lens.RawFromIdeal(segment.At(s));
    Profile profile;
    for (int k = -kReach; k <= kReach; ++k) {
      profile[kReach + k] = image.Nearest(raw + k * across);
    }
    const double sigma = noise.At(*std::max_element(profile.begin(), profile.end()));
    const std::optional<DepthAtLine> depth =
        NearestSurfaceDepth(profile, sigma, kMaxPixelDistance + noise.edge_gap);
    if (!depth) continue;
    samples.sigma = std::max(samples.sigma, sigma);
    samples.along.push_back({s, depth->w, depth->sigma * sigma});
    samples.edge_sigma += depth->edge_sigma;
  }
  if (!samples.along.empty()) samples.edge_sigma /= static_cast<double>(samples.along.size());
  return samples;
}

}  // namespace

std::optional<LineDepth> FitDepthAlongLine(const InverseDepthImage& image, const LensRemap& lens,
                                           const LineSegment2& segment, const DepthNoise& noise,
                                           uint32_t seed) {
  const DepthSamples samples = SampleLineDepth(image, lens, segment, noise);
  std::optional<LineDepth> depth = FitLineDepth(samples.along, seed);
  if (!depth) return std::nullopt;
  // Effective number of independent samples: n kSpacing / correlation length.
  depth->covariance *= std::max(1.0, noise.correlation_length / kSpacing);
  const double common = std::hypot(kCommonNoise * samples.sigma, samples.edge_sigma);
  depth->covariance += Eigen::Matrix2d::Constant(common * common);
  return depth;
}

std::optional<LineDepth> EndPointDepth(const InverseDepthImage& image, const LensRemap& lens,
                                       const LineSegment2& segment, const DepthNoise& noise) {
  const auto nearest_valid = [&](const Vector2d& ideal) {
    const Vector2d raw = lens.RawFromIdeal(ideal);
    const Vector2d center(cvRound(raw.x()), cvRound(raw.y()));
    double best_distance = kEndPointRadius * kEndPointRadius + 0.5;
    double best = 0.0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const double w = image.Nearest(center + Vector2d(dx, dy));
        const double distance = dx * dx + dy * dy;
        if (w <= 0.0 || distance >= best_distance) continue;
        best_distance = distance;
        best = w;
      }
    }
    return best;
  };
  LineDepth depth;
  depth.start = nearest_valid(segment.start);
  depth.end = nearest_valid(segment.end);
  if (depth.start <= 0.0 || depth.end <= 0.0) return std::nullopt;
  const double start_sigma = noise.At(depth.start), end_sigma = noise.At(depth.end);
  depth.covariance.diagonal() << start_sigma * start_sigma, end_sigma * end_sigma;
  depth.num_inliers = 2;
  depth.inlier_ratio = 1.0;
  return depth;
}

}  // namespace msc_vo
