// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/corner_refinement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

namespace msc_vo {

namespace {

constexpr int kMaxSteps = 3;
// The window of a response, and its Gaussian weights: the smaller the window the nearer its
// maximum is to the corner, the larger the less it is moved by noise; 3x3 to 11x11 were measured.
constexpr int kWindowRadius = 2;
constexpr float kWindowSigma = 1.2f;
constexpr int kWindow = 2 * kWindowRadius + 1;
// Gradients for the 3x3 responses around a pixel.
constexpr int kPatchRadius = kWindowRadius + 1;
constexpr int kPatch = 2 * kPatchRadius + 1;

// The window of an apex and its weights. Blurred before gradients are taken: differences of single
// pixels see an edge at a place that depends on where the pixels lie. In simulation (corners of 60
// to 120 degrees, noise of 3 grey values) that takes a third off the scatter of the apex.
constexpr double kApexBlur = 1.0;  // pixels
constexpr int kApexRadius = 3;
constexpr int kApexWindow = 2 * kApexRadius + 1;
constexpr double kApexSigma = 1.5;  // pixels
// From the response's maximum: it is up to 2 px from the apex of a corner of 60 degrees.
constexpr double kMaxApexDistance = 3.0;
constexpr int kMaxApexSteps = 10;
constexpr double kApexTolerance = 0.01;  // pixels
// Pixels^2, mean square distance of the apex from the lines along the edges. In simulation corners
// of 60 to 120 degrees have 0.55 to 0.75 where images are sharp (blur of up to 0.5 px) and 0.7 to
// 0.9 at 0.8 px. Geometric means of the errors of ten rendered sequences and of six with other
// noise, in a first form: 0.69 and 1.06 mm with these two, 0.79 and 1.12 with the apex for all
// features, 0.75 and 1.19 with the maximum for all.
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

// Corner responses of the 3x3 pixels around one.
class ResponsePatch {
 public:
  ResponsePatch(const cv::Mat& gray, const cv::Point& center) {
    static const std::array<float, kWindow> weights = GaussianWeights();
    // Columns of the three moments, summed over the rows of each of the three windows.
    float xx[3][kPatch] = {};
    float xy[3][kPatch] = {};
    float yy[3][kPatch] = {};
    for (int y = 0; y < kPatch; ++y) {
      const uint8_t* row = gray.ptr<uint8_t>(center.y + y - kPatchRadius) + center.x - kPatchRadius;
      const uint8_t* above = row - gray.step;
      const uint8_t* below = row + gray.step;
      for (int v = 0; v < 3; ++v) {
        if (y < v || y >= v + kWindow) continue;
        const float weight = weights[y - v];
        for (int x = 0; x < kPatch; ++x) {
          const float gx = static_cast<float>(row[x + 1] - row[x - 1]);
          const float gy = static_cast<float>(below[x] - above[x]);
          xx[v][x] += weight * gx * gx;
          xy[v][x] += weight * gx * gy;
          yy[v][x] += weight * gy * gy;
        }
      }
    }
    for (int v = 0; v < 3; ++v) {
      for (int u = 0; u < 3; ++u) {
        float a = 0.0f;
        float b = 0.0f;
        float c = 0.0f;
        for (int x = 0; x < kWindow; ++x) {
          a += weights[x] * xx[v][u + x];
          b += weights[x] * xy[v][u + x];
          c += weights[x] * yy[v][u + x];
        }
        const double trace = static_cast<double>(a) + c;
        response_[v][u] = trace > 0.0 ? (static_cast<double>(a) * c - b * b) / trace : 0.0;
      }
    }
  }

  // Offset of the largest response; zero if it is the centre's.
  cv::Point Uphill() const {
    cv::Point best(0, 0);
    for (int v = -1; v <= 1; ++v) {
      for (int u = -1; u <= 1; ++u) {
        if (At(u, v) > At(best.x, best.y)) best = {u, v};
      }
    }
    return best;
  }

  // Maximum of the quadratic through the responses, as an offset from the centre; zero if there is
  // none within the patch.
  Eigen::Vector2d Vertex() const {
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

// The apex of a corner: Gauss-Newton is one linear solution after the other, as the window follows.
class ApexSearch {
 public:
  ApexSearch(const cv::Mat& smooth, const Eigen::Vector2d& start) : smooth_(smooth), apex_(start) {}

  // False if the gradients around `start` have no common point, or one that is not nearby.
  bool Run() {
    const Eigen::Vector2d start = apex_;
    for (int i = 0; i < kMaxApexSteps; ++i) {
      if (!SumMoments()) return false;
      const double determinant = moments_.determinant();
      // Of a straight edge it is zero, to rounding.
      if (!(determinant > 1e-6 * moments_.trace() * moments_.trace())) return false;
      const Eigen::Vector2d step = moments_.inverse() * offset_;
      apex_ += step;
      if (!((apex_ - start).norm() <= kMaxApexDistance)) return false;
      if (step.squaredNorm() < kApexTolerance * kApexTolerance) break;
    }
    return SumMoments();
  }

  const Eigen::Vector2d& apex() const { return apex_; }
  // Mean square distance of the apex from the lines along the edges, pixels^2.
  double misfit() const { return misfit_; }

 private:
  // Weighted sums over the window at the apex. False if that leaves the image.
  bool SumMoments() {
    const int x0 = cvRound(apex_.x()) - kApexRadius;
    const int y0 = cvRound(apex_.y()) - kApexRadius;
    const cv::Rect inner(1, 1, smooth_.cols - 2 - kApexWindow, smooth_.rows - 2 - kApexWindow);
    if (!inner.contains(cv::Point(x0, y0))) return false;
    const std::array<double, kApexWindow> weights_x = Weights(x0 - apex_.x());
    const std::array<double, kApexWindow> weights_y = Weights(y0 - apex_.y());
    moments_.setZero();
    offset_.setZero();
    double squares = 0.0;
    for (int v = 0; v < kApexWindow; ++v) {
      const uint8_t* row = smooth_.ptr<uint8_t>(y0 + v) + x0;
      const uint8_t* above = row - smooth_.step;
      const uint8_t* below = row + smooth_.step;
      for (int u = 0; u < kApexWindow; ++u) {
        const Eigen::Vector2d g(row[u + 1] - row[u - 1], below[u] - above[u]);
        const double distance =
            g.x() * (x0 + u - apex_.x()) + g.y() * (y0 + v - apex_.y());  // times |g|
        const Eigen::Vector2d weighted = weights_x[u] * weights_y[v] * g;
        moments_.noalias() += weighted * g.transpose();
        offset_ += weighted * distance;
        squares += weights_x[u] * weights_y[v] * distance * distance;
      }
    }
    misfit_ = squares / moments_.trace();
    return true;
  }

  static std::array<double, kApexWindow> Weights(double first) {
    std::array<double, kApexWindow> weights;
    for (int i = 0; i < kApexWindow; ++i) {
      const double x = (first + i) / kApexSigma;
      weights[i] = std::exp(-0.5 * x * x);
    }
    return weights;
  }

  const cv::Mat& smooth_;
  Eigen::Vector2d apex_;
  Eigen::Matrix2d moments_;
  Eigen::Vector2d offset_;  // of the linear solution: moments^-1 offset leads from the apex to it
  double misfit_ = 0.0;
};

}  // namespace

CornerRefiner::CornerRefiner(const cv::Mat& gray, const cv::Rect& area) : gray_(gray), area_(area) {
  cv::GaussianBlur(gray, smooth_, cv::Size(), kApexBlur);
}

RefinedCorner CornerRefiner::Refine(const cv::Point& corner) const {
  cv::Point pixel = corner;
  ResponsePatch patch(gray_, pixel);
  for (int step = 0; step < kMaxSteps; ++step) {
    const cv::Point uphill = patch.Uphill();
    if (uphill == cv::Point(0, 0) || !area_.contains(pixel + uphill)) break;
    pixel += uphill;
    patch = ResponsePatch(gray_, pixel);
  }
  return {pixel, TowardsApex(Eigen::Vector2d(pixel.x, pixel.y) + patch.Vertex())};
}

Eigen::Vector2d CornerRefiner::TowardsApex(const Eigen::Vector2d& maximum) const {
  ApexSearch search(smooth_, maximum);
  if (!search.Run()) return maximum;
  const double share = (kNoCornerMisfit - search.misfit()) / (kNoCornerMisfit - kCornerMisfit);
  return maximum + std::clamp(share, 0.0, 1.0) * (search.apex() - maximum);
}

}  // namespace msc_vo
