// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/depth_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <Eigen/Cholesky>

namespace msc_vo {

namespace {

constexpr int kRadius = 2;
constexpr int kSide = 2 * kRadius + 1;
constexpr int kMaxPixels = kSide * kSide;
// A surface needs at least one full row of pixels.
constexpr int kMinPixels = 5;
// Degrees of freedom that a fit consumes: those of a plane, because the prior determines the
// curvature.
constexpr int kPlaneParameters = 3;
// A surface reaches the point if one of its pixels is at most this far away, pixels: the
// neighbours of the pixel that contains the point.
constexpr double kMaxSampleDistance = 1.5;
// Pixels form one surface if the r.m.s. of their residuals is below this many sigmas. Pure noise
// would allow 1.3 (chi-square, 99 %, 22 degrees of freedom); the margin covers folds and sensors
// somewhat worse than their model. An edge of 6 sigmas (12 mm at 1 m) exceeds it.
constexpr double kMaxRms = 2.0;
// Weak priors that regularise fits to a few pixels or to a single row. Slope of a surface, sigmas
// per pixel: 1 for a wall at 45 degrees and 1 m. Curvature, sigmas per square pixel: 0.4 for the
// best parabola through a fold of two such walls.
constexpr double kSlopeSigma = 3.0;
constexpr double kCurvatureSigma = 1.0;
// The assignment of a point beside a depth edge to a surface may be wrong, and the pixel of the
// window farthest from that surface shows by how much. The r.m.s. error is about this fraction of
// the difference if one assignment in ten is wrong, sqrt(0.1).
// Chosen by measurement, see docs/lab/depth.md.
constexpr double kEdgeInflation = 0.3;

// A pixel of the window that has a depth.
struct Pixel {
  int index = 0;          // in the window, row by row
  double distance = 0.0;  // from the point, pixels
  double w = 0.0;         // inverse depth, 1/metres
};

struct Surface {
  double w = 0.0;         // inverse depth at the point, 1/metres
  double variance = 0.0;  // variance of w, in units of the variance of a pixel
  double rms = 0.0;       // r.m.s. of the residuals per degree of freedom, in sigmas
};

// Parameters of w = p0 + p1 x + p2 y + p3 x^2 + p4 x y + p5 y^2, with x and y relative to the
// centre of the window.
using Parameters = Eigen::Matrix<double, 6, 1>;
using Information = Eigen::Matrix<double, 6, 6>;

Parameters Basis(double x, double y) {
  return (Parameters() << 1.0, x, y, x * x, x * y, y * y).finished();
}

// Constants of the fit. Most windows have all their pixels and therefore the same covariance.
struct WindowTables {
  WindowTables() {
    constexpr double kSlope = 1.0 / (kSlopeSigma * kSlopeSigma);
    constexpr double kCurvature = 1.0 / (kCurvatureSigma * kCurvatureSigma);
    prior = (Parameters() << 0.0, kSlope, kSlope, kCurvature, kCurvature, kCurvature)
                .finished()
                .asDiagonal();
    Information information = prior;
    for (int i = 0; i < kMaxPixels; ++i) {
      const int column = i % kSide, row = i / kSide;
      basis[i] = Basis(column - kRadius, row - kRadius);
      information += basis[i] * basis[i].transpose();
    }
    full_covariance = information.llt().solve(Information::Identity());
  }

  std::array<Parameters, kMaxPixels> basis;
  Information prior;
  Information full_covariance;  // with all pixels, in units of the variance of a pixel
};

const WindowTables& Tables() {
  static const WindowTables tables;
  return tables;
}

Information CovarianceOf(const Pixel* begin, const Pixel* end) {
  if (end - begin == kMaxPixels) return Tables().full_covariance;
  Information information = Tables().prior;
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    const Parameters& basis = Tables().basis[pixel->index];
    information.noalias() += basis * basis.transpose();
  }
  return information.llt().solve(Information::Identity());
}

// Least-squares fit to pixels [begin, end); `at_point` is the basis at the point. A quadratic
// instead of a plane, because points in scenes with little texture lie on folds and corners of
// boxes and walls: the error of a plane at a fold is 1.2 times the change of inverse depth per
// pixel, always with the same sign (5 mm at 3 m), that of the quadratic 0.5 times.
Surface FitSurface(const Pixel* begin, const Pixel* end, const Parameters& at_point, double sigma) {
  const WindowTables& tables = Tables();
  Parameters rhs = Parameters::Zero();
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    rhs += pixel->w * tables.basis[pixel->index];
  }
  const Information covariance = CovarianceOf(begin, end);
  const Parameters p = covariance * rhs;
  Surface surface;
  surface.w = p.dot(at_point);
  surface.variance = at_point.dot(covariance * at_point);
  double sum = 0.0;
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    const double r = pixel->w - p.dot(tables.basis[pixel->index]);
    sum += r * r;
  }
  surface.rms = std::sqrt(sum / static_cast<double>(end - begin - kPlaneParameters)) / sigma;
  return surface;
}

// Returns the first pixel after the largest gap between inverse depths, which are sorted, farthest
// first.
Pixel* AfterLargestGap(Pixel* begin, Pixel* end) {
  Pixel* best = begin + 1;
  for (Pixel* pixel = begin + 1; pixel != end; ++pixel) {
    if (pixel->w - (pixel - 1)->w > best->w - (best - 1)->w) best = pixel;
  }
  return best;
}

bool ReachesPoint(const Pixel* begin, const Pixel* end, double max_distance) {
  return std::any_of(begin, end,
                     [&](const Pixel& pixel) { return pixel.distance <= max_distance; });
}

// Returns the nearest surface that reaches the point among pixels sorted by inverse depth: splits
// at the largest gap and searches the nearer part first.
std::optional<Surface> NearestSurface(Pixel* begin, Pixel* end, const Parameters& at_point,
                                      double sigma, double max_distance) {
  if (end - begin < kMinPixels || !ReachesPoint(begin, end, max_distance)) return std::nullopt;
  const Surface surface = FitSurface(begin, end, at_point, sigma);
  if (surface.rms <= kMaxRms) return surface;
  Pixel* const gap = AfterLargestGap(begin, end);
  const std::optional<Surface> nearer = NearestSurface(gap, end, at_point, sigma, max_distance);
  return nearer ? nearer : NearestSurface(begin, gap, at_point, sigma, max_distance);
}

}  // namespace

std::optional<DepthSample> SampleDepth(const InverseDepthImage& image, const Eigen::Vector2d& pixel,
                                       const DepthNoise& noise) {
  if (!image.Contains(pixel)) return std::nullopt;
  const int center_x = cvRound(pixel.x());
  const int center_y = cvRound(pixel.y());
  std::array<Pixel, kMaxPixels> pixels;
  int count = 0;
  double nearest = 0.0;  // 1/metres
  const Eigen::Vector2d point = pixel - Eigen::Vector2d(center_x, center_y);
  for (int i = 0; i < kMaxPixels; ++i) {
    const int x = i % kSide - kRadius;
    const int y = i / kSide - kRadius;
    const double w = image.At(center_x + x, center_y + y);
    if (w > 0.0) pixels[count++] = {i, (Eigen::Vector2d(x, y) - point).norm(), w};
    nearest = std::max(nearest, w);
  }
  const Parameters at_point = Basis(point.x(), point.y());
  Pixel* const begin = pixels.data();
  Pixel* const end = begin + count;
  const double max_distance = kMaxSampleDistance + noise.edge_gap;
  if (count < kMinPixels || !ReachesPoint(begin, end, max_distance)) return std::nullopt;
  const double sigma = noise.At(nearest);
  const Surface only = FitSurface(begin, end, at_point, sigma);
  // The noise of neighbouring pixels is correlated, so their mean is as uncertain as one pixel:
  // hence the 1. The variance of the fit, which grows with extrapolation, is added.
  const auto sample = [&](const Surface& surface, double step) -> std::optional<DepthSample> {
    if (surface.w <= 0.0) return std::nullopt;
    return DepthSample{
        surface.w, std::hypot(sigma * std::sqrt(1.0 + surface.variance), kEdgeInflation * step)};
  };
  if (only.rms <= kMaxRms) return sample(only, 0.0);
  std::stable_sort(begin, end, [](const Pixel& a, const Pixel& b) { return a.w < b.w; });
  const std::optional<Surface> surface = NearestSurface(begin, end, at_point, sigma, max_distance);
  if (!surface) return std::nullopt;
  return sample(*surface, std::max(surface->w - begin->w, std::prev(end)->w - surface->w));
}

}  // namespace msc_vo
