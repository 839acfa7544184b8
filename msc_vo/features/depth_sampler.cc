// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/depth_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

namespace msc_vo {

namespace {

constexpr int kRadius = 2;
constexpr int kMaxPixels = (2 * kRadius + 1) * (2 * kRadius + 1);
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
// curvature, sigmas per square pixel: the best parabola through a fold of two such walls has 0.5.
constexpr double kSlopeSigma = 3.0;
constexpr double kCurvatureSigma = 1.0;
// Sigmas of a point next to a depth edge count this much: its surface is a choice.
constexpr double kEdgeFactor = 2.0;

struct Pixel {
  Eigen::Vector2d offset;  // from the point, pixels
  double w = 0.0;          // inverse depth, 1/metres
};

struct Surface {
  double w = 0.0;         // inverse depth at the point, 1/metres
  double variance = 0.0;  // of it, in units of the variance of a pixel
  double rms = 0.0;       // of the residuals per degree of freedom, in sigmas
};

// Parameters of w = p0 + p1 x + p2 y + p3 x^2 + p4 x y + p5 y^2.
using Parameters = Eigen::Matrix<double, 6, 1>;

Parameters Basis(const Eigen::Vector2d& offset) {
  const double x = offset.x();
  const double y = offset.y();
  return (Parameters() << 1.0, x, y, x * x, x * y, y * y).finished();
}

// Least squares over pixels [begin, end). Why not a plane: where points are rare they lie on folds
// and corners of boxes and walls, and a plane through a fold misses it by 1.2 times what the depth
// changes from pixel to pixel, always to the same side (5 mm at 3 m); the parabola by 0.5.
Surface FitSurface(const Pixel* begin, const Pixel* end, double sigma) {
  constexpr double kSlope = 1.0 / (kSlopeSigma * kSlopeSigma);
  constexpr double kCurvature = 1.0 / (kCurvatureSigma * kCurvatureSigma);
  Eigen::Matrix<double, 6, 6> information =
      (Parameters() << 0.0, kSlope, kSlope, kCurvature, kCurvature, kCurvature)
          .finished()
          .asDiagonal();
  Parameters rhs = Parameters::Zero();
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    const Parameters basis = Basis(pixel->offset);
    information.noalias() += basis * basis.transpose();
    rhs += pixel->w * basis;
  }
  const Eigen::LLT<Eigen::Matrix<double, 6, 6>> factorization(information);
  const Parameters p = factorization.solve(rhs);
  Surface surface;
  surface.w = p[0];
  surface.variance = factorization.solve(Parameters::UnitX())[0];
  double sum = 0.0;
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    const double r = (pixel->w - p.dot(Basis(pixel->offset))) / sigma;
    sum += r * r;
  }
  surface.rms = std::sqrt(sum / static_cast<double>(end - begin - kPlaneParameters));
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
  return std::any_of(begin, end,
                     [](const Pixel& pixel) { return pixel.offset.norm() <= kMaxDistance; });
}

// The nearest surface that comes to the point among pixels sorted by inverse depth: splits at the
// largest gap, looks among the nearer ones first.
std::optional<Surface> NearestSurface(Pixel* begin, Pixel* end, double sigma) {
  if (end - begin < kMinPixels || !ComesToPoint(begin, end)) return std::nullopt;
  const Surface surface = FitSurface(begin, end, sigma);
  if (surface.rms <= kMaxRms) return surface;
  Pixel* const gap = LargestGap(begin, end);
  const std::optional<Surface> nearer = NearestSurface(gap, end, sigma);
  return nearer ? nearer : NearestSurface(begin, gap, sigma);
}

}  // namespace

std::optional<DepthSample> SampleDepth(const InverseDepthImage& image, const Eigen::Vector2d& pixel,
                                       double sigma) {
  const int center_x = cvRound(pixel.x());
  const int center_y = cvRound(pixel.y());
  std::array<Pixel, kMaxPixels> pixels;
  int count = 0;
  for (int y = center_y - kRadius; y <= center_y + kRadius; ++y) {
    for (int x = center_x - kRadius; x <= center_x + kRadius; ++x) {
      const double w = image.At(x, y);
      if (w > 0.0) pixels[count++] = {Eigen::Vector2d(x, y) - pixel, w};
    }
  }
  Pixel* const begin = pixels.data();
  Pixel* const end = begin + count;
  if (count < kMinPixels || !ComesToPoint(begin, end)) return std::nullopt;
  const Surface plane = FitSurface(begin, end, sigma);
  // Neighbouring pixels share their noise, so that their mean is no better than one of them: hence
  // the 1. What a fit must extrapolate comes on top.
  const auto sample = [&](const Surface& surface, double factor) -> std::optional<DepthSample> {
    if (surface.w <= 0.0) return std::nullopt;
    return DepthSample{surface.w, factor * sigma * std::sqrt(1.0 + surface.variance)};
  };
  if (plane.rms <= kMaxRms) return sample(plane, 1.0);
  std::stable_sort(begin, end, [](const Pixel& a, const Pixel& b) { return a.w < b.w; });
  const std::optional<Surface> surface = NearestSurface(begin, end, sigma);
  return surface ? sample(*surface, kEdgeFactor) : std::nullopt;
}

}  // namespace msc_vo
