// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/corner_refinement.h"

#include <array>
#include <cmath>

#include <Eigen/LU>

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

}  // namespace

RefinedCorner RefineCorner(const cv::Mat& gray, const cv::Rect& area, const cv::Point& corner) {
  cv::Point pixel = corner;
  ResponsePatch patch(gray, pixel);
  for (int step = 0; step < kMaxSteps; ++step) {
    const cv::Point uphill = patch.Uphill();
    if (uphill == cv::Point(0, 0) || !area.contains(pixel + uphill)) break;
    pixel += uphill;
    patch = ResponsePatch(gray, pixel);
  }
  return {pixel, Eigen::Vector2d(pixel.x, pixel.y) + patch.Vertex()};
}

}  // namespace msc_vo
