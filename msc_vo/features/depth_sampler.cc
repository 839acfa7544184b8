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
constexpr int kParameters = 3;  // of a plane
// A surface comes to the point if one of its pixels is at most this far: the pixels around the one
// that holds the point.
constexpr double kMaxDistance = 1.5;
// Pixels are a surface if their residuals have an r.m.s. below this many sigmas. A pure noise would
// allow 1.3 (chi-square, 99 %, 22 degrees of freedom); folds and sensors that are somewhat worse
// than their model need the rest, and an edge of 6 sigmas (12 mm at 1 m) exceeds it.
constexpr double kMaxRms = 2.0;
// Weak prior on the slope of a surface, sigmas per pixel: a wall seen at 45 degrees from 1 m has 1.
// It keeps the fit to a single row or column of pixels from being undetermined.
constexpr double kSlopeSigma = 3.0;
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

// Least squares w = p0 + p1 x + p2 y over pixels [begin, end).
Surface FitSurface(const Pixel* begin, const Pixel* end, double sigma) {
  const double slope_information = 1.0 / (kSlopeSigma * kSlopeSigma);
  Eigen::Matrix3d information =
      Eigen::Vector3d(0.0, slope_information, slope_information).asDiagonal();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    const double x = pixel->offset.x();
    const double y = pixel->offset.y();
    information(1, 0) += x;
    information(2, 0) += y;
    information(1, 1) += x * x;
    information(2, 1) += x * y;
    information(2, 2) += y * y;
    rhs += Eigen::Vector3d(pixel->w, x * pixel->w, y * pixel->w);
  }
  information(0, 0) = static_cast<double>(end - begin);
  // Reads the lower triangle only.
  const Eigen::LLT<Eigen::Matrix3d> factorization(information);
  const Eigen::Vector3d p = factorization.solve(rhs);
  Surface surface;
  surface.w = p[0];
  surface.variance = factorization.solve(Eigen::Vector3d::UnitX())[0];
  double sum = 0.0;
  for (const Pixel* pixel = begin; pixel != end; ++pixel) {
    const double r = (pixel->w - p[0] - p.tail<2>().dot(pixel->offset)) / sigma;
    sum += r * r;
  }
  surface.rms = std::sqrt(sum / static_cast<double>(end - begin - kParameters));
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
