// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/depth_sampler.h"

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
// Fewer pixels than a full row do not show a surface.
constexpr int kMinPixels = 5;
// Deducted from the pixels for the r.m.s.: those of a plane, as priors hold the curvature.
constexpr int kPlaneParameters = 3;
// A surface comes to the point if one of its pixels is at most this far: the pixels around the one
// that holds the point.
constexpr double kMaxDistance = 1.5;
// Pixels are a surface if their residuals have an r.m.s. below this many sigmas. A pure noise would
// allow 1.3 (chi-square, 99 %, 22 degrees of freedom); folds and sensors that are somewhat worse
// than their model need the rest, and an edge of 6 sigmas (12 mm at 1 m) exceeds it.
constexpr double kMaxRms = 2.0;
// Weak priors, which keep the fit to a few pixels or a single row of them from being undetermined.
// On the slope of a surface, sigmas per pixel: a wall seen at 45 degrees from 1 m has 1. On its
// curvature, sigmas per square pixel: the best parabola through a fold of two such walls has 0.4.
constexpr double kSlopeSigma = 3.0;
constexpr double kCurvatureSigma = 1.0;
// The surface of a point beside a depth edge is a choice, and the pixel of the window that is
// farthest from it tells by how much another one would differ: if one choice in ten is wrong, the
// error has about this share of that as a root mean square, sqrt(0.1). (Noise like a Kinect's,
// which takes pixels from edges, changes the choice for 9 to 17 % of all points of the rendered
// rooms.)
constexpr double kEdgeDoubt = 0.3;

// A pixel of the window that has a depth.
struct Pixel {
  int place = 0;          // in the window, row by row
  double distance = 0.0;  // from the point, pixels
  double w = 0.0;         // inverse depth, 1/metres
};

struct Surface {
  double w = 0.0;         // inverse depth at the point, 1/metres
  double variance = 0.0;  // of it, in units of the variance of a pixel
  double rms = 0.0;       // of the residuals per degree of freedom, in sigmas
};

// Parameters of w = p0 + p1 x + p2 y + p3 x^2 + p4 x y + p5 y^2, x and y from the window's middle.
using Parameters = Eigen::Matrix<double, 6, 1>;
using Information = Eigen::Matrix<double, 6, 6>;

Parameters Basis(double x, double y) {
  return (Parameters() << 1.0, x, y, x * x, x * y, y * y).finished();
}

// What is the same for all windows. Most have all their pixels, and then one and the same inverse.
struct WindowTables {
  WindowTables() {
    constexpr double kSlope = 1.0 / (kSlopeSigma * kSlopeSigma);
    constexpr double kCurvature = 1.0 / (kCurvatureSigma * kCurvatureSigma);
    prior = (Parameters() << 0.0, kSlope, kSlope, kCurvature, kCurvature, kCurvature)
                .finished()
                .asDiagonal();
    Information information = prior;
    for (int place = 0; place < kMaxPixels; ++place) {
      basis[place] = Basis(place % kSide - kRadius, place / kSide - kRadius);
      information += basis[place] * basis[place].transpose();
    }
    covariance_of_all = information.llt().solve(Information::Identity());
  }

  std::array<Parameters, kMaxPixels> basis;
  Information prior;
  Information covariance_of_all;  // in units of the variance of a pixel
};

const WindowTables& Tables() {
  static const WindowTables tables;
  return tables;
}

Information CovarianceOf(const Pixel* begin, const Pixel* end) {
  if (end - begin == kMaxPixels) return Tables().covariance_of_all;
  Information information = Tables().prior;
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    const Parameters& basis = Tables().basis[pixel->place];
    information.noalias() += basis * basis.transpose();
  }
  return information.llt().solve(Information::Identity());
}

// Least squares over pixels [begin, end); `at_point`: the basis there. Why not a plane: where
// points are rare they lie on folds and corners of boxes and walls, and a plane through a fold
// misses it by 1.2 times what the depth changes from pixel to pixel, always to the same side (5 mm
// at 3 m); the parabola by 0.5.
Surface FitSurface(const Pixel* begin, const Pixel* end, const Parameters& at_point, double sigma) {
  const WindowTables& tables = Tables();
  Parameters rhs = Parameters::Zero();
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    rhs += pixel->w * tables.basis[pixel->place];
  }
  const Information covariance = CovarianceOf(begin, end);
  const Parameters p = covariance * rhs;
  Surface surface;
  surface.w = p.dot(at_point);
  surface.variance = at_point.dot(covariance * at_point);
  double sum = 0.0;
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    const double r = pixel->w - p.dot(tables.basis[pixel->place]);
    sum += r * r;
  }
  surface.rms = std::sqrt(sum / static_cast<double>(end - begin - kPlaneParameters)) / sigma;
  return surface;
}

// Where the largest gap between consecutive inverse depths (sorted, farthest first) ends.
Pixel* LargestGap(Pixel* begin, Pixel* end) {
  Pixel* best = begin + 1;
  for (Pixel* pixel = begin + 1; pixel != end; ++pixel) {
    if (pixel->w - (pixel - 1)->w > best->w - (best - 1)->w) best = pixel;
  }
  return best;
}

bool ComesToPoint(const Pixel* begin, const Pixel* end) {
  return std::any_of(begin, end, [](const Pixel& pixel) { return pixel.distance <= kMaxDistance; });
}

// The nearest surface that comes to the point among pixels sorted by inverse depth: splits at the
// largest gap, looks among the nearer ones first.
std::optional<Surface> NearestSurface(Pixel* begin, Pixel* end, const Parameters& at_point,
                                      double sigma) {
  if (end - begin < kMinPixels || !ComesToPoint(begin, end)) return std::nullopt;
  const Surface surface = FitSurface(begin, end, at_point, sigma);
  if (surface.rms <= kMaxRms) return surface;
  Pixel* const gap = LargestGap(begin, end);
  const std::optional<Surface> nearer = NearestSurface(gap, end, at_point, sigma);
  return nearer ? nearer : NearestSurface(begin, gap, at_point, sigma);
}

}  // namespace

std::optional<DepthSample> SampleDepth(const InverseDepthImage& image, const Eigen::Vector2d& pixel,
                                       double sigma) {
  if (!image.Contains(pixel)) return std::nullopt;
  const int center_x = cvRound(pixel.x());
  const int center_y = cvRound(pixel.y());
  std::array<Pixel, kMaxPixels> pixels;
  int count = 0;
  const Eigen::Vector2d point = pixel - Eigen::Vector2d(center_x, center_y);
  for (int place = 0; place < kMaxPixels; ++place) {
    const int x = place % kSide - kRadius;
    const int y = place / kSide - kRadius;
    const double w = image.At(center_x + x, center_y + y);
    if (w > 0.0) pixels[count++] = {place, (Eigen::Vector2d(x, y) - point).norm(), w};
  }
  const Parameters at_point = Basis(point.x(), point.y());
  Pixel* const begin = pixels.data();
  Pixel* const end = begin + count;
  if (count < kMinPixels || !ComesToPoint(begin, end)) return std::nullopt;
  const Surface plane = FitSurface(begin, end, at_point, sigma);
  // Neighbouring pixels share their noise, so that their mean is no better than one of them: hence
  // the 1. What a fit must extrapolate comes on top.
  const auto sample = [&](const Surface& surface, double step) -> std::optional<DepthSample> {
    if (surface.w <= 0.0) return std::nullopt;
    return DepthSample{surface.w,
                       std::hypot(sigma * std::sqrt(1.0 + surface.variance), kEdgeDoubt * step)};
  };
  if (plane.rms <= kMaxRms) return sample(plane, 0.0);
  std::stable_sort(begin, end, [](const Pixel& a, const Pixel& b) { return a.w < b.w; });
  const std::optional<Surface> surface = NearestSurface(begin, end, at_point, sigma);
  if (!surface) return std::nullopt;
  return sample(*surface, std::max(surface->w - begin->w, std::prev(end)->w - surface->w));
}

}  // namespace msc_vo
