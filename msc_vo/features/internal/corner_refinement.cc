// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/corner_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

namespace msc_vo {

namespace {

constexpr int kMaxSteps = 3;
// Window of the corner response and its Gaussian weights. A smaller window has its maximum closer
// to the corner, a larger one is less sensitive to noise.
// Chosen by measurement, see docs/lab/features.md.
constexpr int kWindowRadius = 2;
constexpr float kWindowSigma = 1.2f;
constexpr int kWindow = 2 * kWindowRadius + 1;
// Gradients for the 3x3 responses around a pixel.
constexpr int kPatchRadius = kWindowRadius + 1;
constexpr int kPatch = 2 * kPatchRadius + 1;

// Window of the apex search and its Gaussian weights. Gradients are those of the smoothed image:
// between unsmoothed pixels, the position of an edge depends on the phase of the pixel grid.
constexpr int kApexRadius = 3;
constexpr int kApexWindow = 2 * kApexRadius + 1;
constexpr double kApexSigma = 1.5;  // pixels
// Largest distance of the apex from the maximum of the response, pixels: 2 for a corner of 60
// degrees.
constexpr double kMaxApexDistance = 3.0;
constexpr int kMaxApexSteps = 10;
constexpr double kApexTolerance = 0.01;  // pixels
// Mean square distance of the apex from the lines along the edges, pixels^2: up to kCornerMisfit
// the position is the apex, from kNoCornerMisfit on the maximum of the response.
// Chosen by measurement, see docs/lab/features.md.
constexpr double kCornerMisfit = 0.7;
constexpr double kNoCornerMisfit = 1.0;

std::array<float, kWindow> GaussianWeights() {
  std::array<float, kWindow> weights;
  for (int i = 0; i < kWindow; ++i) {
    const float x = static_cast<float>(i - kWindowRadius) / kWindowSigma;
    weights[i] = std::exp(-0.5f * x * x);
  }
  return weights;
}

// Values of eight consecutive pixels of a row: two vectors of four floats.
using Row = Eigen::Array<float, 8, 1>;

// The order of Eigen's own sum depends on the processor.
float Sum(const Row& row) {
  const Eigen::Array4f half = row.head<4>() + row.tail<4>();
  return (half[0] + half[2]) + (half[1] + half[3]);
}

// Products of the gradient components of the eight pixels from `row` on.
struct GradientProducts {
  Row xx, xy, yy;

  GradientProducts() = default;
  GradientProducts(const uint8_t* row, size_t step) {
    using Bytes = Eigen::Map<const Eigen::Array<uint8_t, 8, 1>>;
    const Row gx = Bytes(row + 1).cast<float>() - Bytes(row - 1).cast<float>();
    const Row gy = Bytes(row + step).cast<float>() - Bytes(row - step).cast<float>();
    xx = gx * gx;
    xy = gx * gy;
    yy = gy * gy;
  }
};

// Corner responses of the 3x3 pixels around a pixel.
class ResponsePatch {
 public:
  ResponsePatch(const cv::Mat& gray, const cv::Point& center) {
    static const std::array<float, kWindow> weights = GaussianWeights();
    std::array<GradientProducts, kPatch> rows;
    for (int y = 0; y < kPatch; ++y) {
      rows[y] = {gray.ptr<uint8_t>(center.y + y - kPatchRadius) + center.x - kPatchRadius,
                 gray.step};
    }
    for (int v = 0; v < 3; ++v) {
      // Moments summed over the rows of the window, then over its columns at each position.
      Row xx = Row::Zero(), xy = Row::Zero(), yy = Row::Zero();
      for (int y = 0; y < kWindow; ++y) {
        xx += weights[y] * rows[v + y].xx;
        xy += weights[y] * rows[v + y].xy;
        yy += weights[y] * rows[v + y].yy;
      }
      Eigen::Array4f a = Eigen::Array4f::Zero(), b = a, c = a;
      for (int x = 0; x < kWindow; ++x) {
        a += weights[x] * xx.segment<4>(x);
        b += weights[x] * xy.segment<4>(x);
        c += weights[x] * yy.segment<4>(x);
      }
      for (int u = 0; u < 3; ++u) {
        const double trace = static_cast<double>(a[u]) + c[u];
        response_[v][u] =
            trace > 0.0 ? (static_cast<double>(a[u]) * c[u] - b[u] * b[u]) / trace : 0.0;
      }
    }
  }

  // Offset of the largest response from the centre.
  cv::Point OffsetOfMaximum() const {
    cv::Point best(0, 0);
    for (int v = -1; v <= 1; ++v) {
      for (int u = -1; u <= 1; ++u) {
        if (At(u, v) > At(best.x, best.y)) best = {u, v};
      }
    }
    return best;
  }

  // Maximum of the quadratic through the responses, as an offset from the centre; zero if the
  // quadratic has no maximum within the patch.
  Eigen::Vector2d QuadraticVertex() const {
    const Eigen::Vector2d gradient(0.5 * (At(1, 0) - At(-1, 0)), 0.5 * (At(0, 1) - At(0, -1)));
    Eigen::Matrix2d hessian;
    hessian(0, 0) = At(1, 0) + At(-1, 0) - 2.0 * At(0, 0);
    hessian(1, 1) = At(0, 1) + At(0, -1) - 2.0 * At(0, 0);
    hessian(0, 1) = 0.25 * (At(1, 1) + At(-1, -1) - At(1, -1) - At(-1, 1));
    hessian(1, 0) = hessian(0, 1);
    if (!(hessian(0, 0) < 0.0 && hessian.determinant() > 0.0)) return Eigen::Vector2d::Zero();
    const Eigen::Vector2d vertex = -hessian.inverse() * gradient;
    return vertex.cwiseAbs().maxCoeff() <= 1.0 ? vertex : Eigen::Vector2d::Zero();
  }

 private:
  double At(int u, int v) const { return response_[v + 1][u + 1]; }

  double response_[3][3];
};

// Distances of the pixels of a row or column of the apex window from the apex, and their Gaussian
// weights.
struct ApexWeights {
  Row distance, weight;  // the eighth weight is zero

  // `first` is the coordinate of the first pixel relative to the apex.
  explicit ApexWeights(double first) {
    static const Row centered_weights = CenteredWeights();
    // exp(-(first + i)^2 / 2 sigma^2), without the factor exp(-first^2 / 2 sigma^2) that all
    // weights have in common.
    const float ratio = std::exp(static_cast<float>(-first / (kApexSigma * kApexSigma)));
    float power = 1.0f;
    for (int i = 0; i < 8; ++i, power *= ratio) {
      distance[i] = static_cast<float>(first + i);
      weight[i] = power * centered_weights[i];
    }
  }

 private:
  // exp(-i^2 / 2 sigma^2)
  static Row CenteredWeights() {
    Row weights = Row::Zero();
    for (int i = 0; i < kApexWindow; ++i) {
      weights[i] = static_cast<float>(std::exp(-0.5 * i * i / (kApexSigma * kApexSigma)));
    }
    return weights;
  }
};

// Estimates the apex of a corner. Every iteration solves a linear least-squares problem and centres
// the window on the solution.
class ApexSearch {
 public:
  ApexSearch(const cv::Mat& smooth, const Eigen::Vector2d& start) : smooth_(smooth), apex_(start) {}

  // Returns false if the lines along the edges around `start` do not intersect, or too far away.
  bool Run() {
    const Eigen::Vector2d start = apex_;
    for (int i = 0; i < kMaxApexSteps; ++i) {
      if (!SumMoments()) return false;
      const double determinant = moments_.determinant();
      // Zero for a straight edge, up to rounding.
      if (!(determinant > 1e-6 * moments_.trace() * moments_.trace())) return false;
      const Eigen::Vector2d step = moments_.inverse() * offset_;
      apex_ += step;
      if (!((apex_ - start).norm() <= kMaxApexDistance)) return false;
      if (step.squaredNorm() < kApexTolerance * kApexTolerance) break;
    }
    return SumMoments() && moments_.trace() > 0.0;
  }

  const Eigen::Vector2d& apex() const { return apex_; }
  // Mean square distance of the apex from the lines along the edges, pixels^2.
  double misfit() const { return misfit_; }

 private:
  // Computes the weighted sums over the window at the apex. Returns false if the window leaves the
  // image.
  bool SumMoments() {
    if (!MoveWindow({cvRound(apex_.x()) - kApexRadius, cvRound(apex_.y()) - kApexRadius})) {
      return false;
    }
    const ApexWeights x(window_.x - apex_.x()), y(window_.y - apex_.y());
    // Sums over the rows of the window: g g^T, its second column times y, its last entry times y^2.
    Row xx = Row::Zero(), xy = xx, yy = xx, xy_y = xx, yy_y = xx, yy_yy = xx;
    for (int v = 0; v < kApexWindow; ++v) {
      const GradientProducts& row = products_[v];
      const Row weighted_xy = y.weight[v] * row.xy, weighted_yy = y.weight[v] * row.yy;
      xx += y.weight[v] * row.xx;
      xy += weighted_xy;
      yy += weighted_yy;
      xy_y += y.distance[v] * weighted_xy;
      yy_y += y.distance[v] * weighted_yy;
      yy_yy += y.distance[v] * y.distance[v] * weighted_yy;
    }
    moments_(0, 0) = Sum(x.weight * xx);
    moments_(0, 1) = moments_(1, 0) = Sum(x.weight * xy);
    moments_(1, 1) = Sum(x.weight * yy);
    offset_.x() = Sum(x.weight * (xx * x.distance + xy_y));
    offset_.y() = Sum(x.weight * (xy * x.distance + yy_y));
    const Row squares = (xx * x.distance + 2.0f * xy_y) * x.distance + yy_yy;
    misfit_ = Sum(x.weight * squares) / moments_.trace();
    return true;
  }

  // Computes the gradients of the window whose first pixel is `first_pixel`, unless they are
  // known. Returns false if the window leaves the image.
  bool MoveWindow(const cv::Point& first_pixel) {
    if (first_pixel == window_) return true;
    // Includes the eighth pixel of a row and the neighbours that gradients need.
    const cv::Rect inner(1, 1, smooth_.cols - 2 - kApexWindow, smooth_.rows - 2 - kApexWindow);
    if (!inner.contains(first_pixel)) return false;
    window_ = first_pixel;
    for (int v = 0; v < kApexWindow; ++v) {
      products_[v] = {smooth_.ptr<uint8_t>(first_pixel.y + v) + first_pixel.x, smooth_.step};
    }
    return true;
  }

  const cv::Mat& smooth_;
  Eigen::Vector2d apex_;
  cv::Point window_{-1, -1};  // first pixel of the window; (-1, -1): no gradients yet
  std::array<GradientProducts, kApexWindow> products_;
  Eigen::Matrix2d moments_;
  Eigen::Vector2d offset_;  // the step to the solution is moments_^-1 offset_
  double misfit_ = 0.0;
};

}  // namespace

RefinedCorner CornerRefiner::Refine(const cv::Point& corner) const {
  cv::Point pixel = corner;
  ResponsePatch patch(gray_, pixel);
  for (int step = 0; step < kMaxSteps; ++step) {
    const cv::Point offset = patch.OffsetOfMaximum();
    if (offset == cv::Point(0, 0) || !area_.contains(pixel + offset)) break;
    pixel += offset;
    patch = ResponsePatch(gray_, pixel);
  }
  return {pixel, BlendWithApex(Eigen::Vector2d(pixel.x, pixel.y) + patch.QuadraticVertex())};
}

Eigen::Vector2d CornerRefiner::BlendWithApex(const Eigen::Vector2d& maximum) const {
  ApexSearch search(smooth_, maximum);
  if (!search.Run()) return maximum;
  const double weight = (kNoCornerMisfit - search.misfit()) / (kNoCornerMisfit - kCornerMisfit);
  return maximum + std::clamp(weight, 0.0, 1.0) * (search.apex() - maximum);
}

}  // namespace msc_vo
