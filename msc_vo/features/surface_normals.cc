// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/surface_normals.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>

#include "msc_vo/camera/image_scale.h"
#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/features/internal/depth_sums.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using Eigen::Vector3d;

// Lengths are pixels at an image width of 640; the reduced image is not wider.

// Distance between normals: 1200 normals.
constexpr int kGridStep = 16;
// Length over which the errors of depth are correlated: half of a structured-light sensor's
// matching window of 9 pixels.
constexpr double kCorrelationLength = 5.0;
// Radius of a window: smaller ones average too few pixels, larger ones extend over several objects
// of a room.
constexpr int kMinRadius = 5;
constexpr int kMaxRadius = 32;
constexpr int kMaxArea = (2 * kMaxRadius + 1) * (2 * kMaxRadius + 1);
// Largest angle between ray and normal, radians (80 degrees): surfaces at a flatter angle cannot be
// distinguished from depth edges, and depth on them is poor.
constexpr double kMaxIncidence = 1.396;
// Fraction of the window's pixels that must have a depth.
constexpr double kMinValidRatio = 0.5;
// A depth step between neighbours is an edge beyond this many sigmas of a difference: 99.7 %.
constexpr double kEdgeSigmas = 3.0;

// Marks the ray of a pixel that does not belong to the undistorted image.
constexpr float kNotShown = 1e9f;

int InUnits(float metres) { return cvRound(metres * static_cast<float>(1.0 / DepthSums::kUnit)); }

}  // namespace

// A square of pixels around (x, y), clipped to the image.
struct SurfaceNormalEstimator::Window {
  int x = 0;
  int y = 0;
  int radius = 0;
  int left = 0;  // first and last pixels
  int top = 0;
  int right = 0;
  int bottom = 0;

  int Area() const { return (right - left + 1) * (bottom - top + 1); }
};

bool SurfaceNormalOptions::IsValid(std::string* error) const {
  if (!(min_depth > 0.0 && max_depth > min_depth)) {
    *error = "normals: 0 < min_depth < max_depth (metres) must hold";
  } else if (kMaxArea * max_depth > DepthSums::kMaxSum) {
    *error = FormatText(
        "normals.max_depth must not exceed %g metres: sums over a window would "
        "overflow",
        DepthSums::kMaxSum / kMaxArea);
  } else {
    return true;
  }
  return false;
}

SurfaceNormalEstimator::SurfaceNormalEstimator(const SurfaceNormalOptions& options,
                                               const PinholeCamera& camera,
                                               const LensDistortion& distortion)
    : options_(options), camera_(camera) {
  std::string error;
  if (!options.IsValid(&error) || !camera.IsValid(&error) ||
      !IsInvertible(distortion, camera, &error)) {
    throw std::invalid_argument("SurfaceNormalEstimator: " + error);
  }
  step_ = ReducingStep(camera.width);
  width_ = (camera.width - 1) / step_ + 1;
  height_ = (camera.height - 1) / step_ + 1;
  focal_length_ = distortion.Recorded(camera).FocalLength() / step_;
  correlation_length_ = kCorrelationLength * ImageScale(width_);
  min_radius_ = ScaledLength(kMinRadius, width_, 2);
  max_radius_ = ScaledLength(kMaxRadius, width_, min_radius_);
  const double widest = DepthSums::kMaxSum / (kMaxArea * options.max_depth);
  rays_.reserve(static_cast<size_t>(width_) * height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      Eigen::Vector2d pixel(step_ * x, step_ * y);
      if (!distortion.IsZero()) pixel = distortion.Undistort(camera, pixel);
      const Vector3d ray = camera.Ray(pixel);
      // Points far to the side, most of which a cropped image does not show, would overflow sums.
      const bool is_shown =
          !distortion.IsCropped() ||
          (camera.IsInside(pixel) && ray.maxCoeff() < widest && ray.minCoeff() > -widest);
      rays_.push_back({static_cast<float>(is_shown ? ray.x() : kNotShown),
                       static_cast<float>(is_shown ? ray.y() : kNotShown)});
    }
  }
  integral_.resize(static_cast<size_t>(width_ + 1) * (height_ + 1));
}

SurfaceNormalEstimator::~SurfaceNormalEstimator() = default;

cv::Mat SurfaceNormalEstimator::Reduce(const cv::Mat& depth) const {
  if (step_ == 1) return depth;
  cv::Mat reduced(height_, width_, CV_32FC1);
  for (int y = 0; y < height_; ++y) {
    const float* const from = depth.ptr<float>(step_ * y);
    float* const to = reduced.ptr<float>(y);
    for (int x = 0; x < width_; ++x) to[x] = from[step_ * x];
  }
  return reduced;
}

void SurfaceNormalEstimator::Integrate(const cv::Mat& depth) {
  const int width = width_;
  const auto nearest = static_cast<float>(options_.min_depth);
  const auto farthest = static_cast<float>(options_.max_depth);
  // Relative change of depth between neighbouring pixels: of the steepest surface, and of noise,
  // whose sigma relative to z is z sigma_w for each of the two pixels.
  const auto steepest = static_cast<float>(std::tan(kMaxIncidence) / focal_length_);
  const auto noise = static_cast<float>(kEdgeSigmas * std::sqrt(2.0) * kInverseDepthSigma);
  const auto is_edge = [&](float z, float neighbour) {
    return neighbour >= nearest && neighbour <= farthest &&
           std::abs(z - neighbour) > z * (steepest + noise * z);
  };
  for (int y = 0; y < height_; ++y) {
    const float* z_row = depth.ptr<float>(y);
    const float* z_above = depth.ptr<float>(std::max(y - 1, 0));
    const std::array<float, 2>* ray = &rays_[static_cast<size_t>(y) * width];
    const DepthSums* above = &integral_[static_cast<size_t>(y) * (width + 1)];
    DepthSums* here = &integral_[static_cast<size_t>(y + 1) * (width + 1)];
    DepthSums row;
    for (int x = 0; x < width; ++x) {
      const float z = z_row[x];
      if (z >= nearest && z <= farthest && ray[x][0] < kNotShown) {  // false for NaN
        row.AddPoint(InUnits(z * ray[x][0]), InUnits(z * ray[x][1]), InUnits(z),
                     is_edge(z, z_row[std::max(x - 1, 0)]) || is_edge(z, z_above[x]));
      }
      here[x + 1] = above[x + 1] + row;
    }
  }
}

DepthSums SurfaceNormalEstimator::SumOver(int left, int top, int right, int bottom) const {
  const size_t stride = width_ + 1;
  const DepthSums* above = &integral_[top * stride];
  const DepthSums* below = &integral_[(bottom + 1) * stride];
  return below[right + 1] - above[right + 1] - below[left] + above[left];
}

// Standard deviation of a normal's angle at depth z, radians, for a window of the given radius. The
// mean points of the two halves of a window are radius pixels, radius z / f metres, apart; the
// noise of each along the ray is z^2 sigma_w / sqrt(n), with n = 2 radius^2 / correlation^2
// independent pixels. The angle is the quotient.
double SurfaceNormalEstimator::NormalSigma(double z, double radius) const {
  return z * focal_length_ * kInverseDepthSigma * correlation_length_ / (radius * radius);
}

// Selects the largest window without a depth edge, from the one that meets kTargetSigma at depth z
// downwards. Returns false if there is none with enough depth.
bool SurfaceNormalEstimator::SelectWindow(int x, int y, double z, Window* window) const {
  const double wanted = std::sqrt(NormalSigma(z, 1.0) / kTargetSigma);
  int radius = static_cast<int>(std::clamp<double>(std::ceil(wanted), min_radius_, max_radius_));
  for (; radius >= min_radius_; radius = radius * 3 / 4) {
    *window = {x,
               y,
               radius,
               std::max(x - radius, 0),
               std::max(y - radius, 0),
               std::min(x + radius, width_ - 1),
               std::min(y + radius, height_ - 1)};
    const DepthSums sums = SumOver(window->left, window->top, window->right, window->bottom);
    if (sums.NumEdges() == 0) return sums.NumPoints() >= kMinValidRatio * window->Area();
  }
  return false;
}

bool SurfaceNormalEstimator::EstimateInWindow(const Window& window, SurfaceNormal* normal) const {
  const DepthSums left = SumOver(window.left, window.top, window.x - 1, window.bottom);
  const DepthSums right = SumOver(window.x + 1, window.top, window.right, window.bottom);
  const DepthSums upper = SumOver(window.left, window.top, window.right, window.y - 1);
  const DepthSums lower = SumOver(window.left, window.y + 1, window.right, window.bottom);
  for (const DepthSums* half : {&left, &right, &upper, &lower}) {
    if (half->NumPoints() == 0) return false;
  }
  const Vector3d horizontal = right.MeanPoint() - left.MeanPoint();
  const Vector3d vertical = lower.MeanPoint() - upper.MeanPoint();
  const Vector3d cross = horizontal.cross(vertical);
  if (cross.norm() < 1e-12) return false;  // tangents shorter than DepthSums::kUnit
  normal->position = SumOver(window.left, window.top, window.right, window.bottom).MeanPoint();
  normal->direction = cross.normalized();
  if (normal->direction.dot(normal->position) > 0.0) normal->direction = -normal->direction;
  const double cosine = -normal->direction.dot(normal->position.normalized());
  if (cosine < std::cos(kMaxIncidence)) return false;
  normal->sigma = NormalSigma(normal->position.z(), window.radius);
  return true;
}

std::vector<SurfaceNormal> SurfaceNormalEstimator::Estimate(const cv::Mat& depth) {
  if (depth.type() != CV_32FC1 || depth.cols != camera_.width || depth.rows != camera_.height) {
    throw std::invalid_argument(
        "SurfaceNormalEstimator: the depth image must be float (CV_32FC1, metres) of " +
        std::to_string(camera_.width) + "x" + std::to_string(camera_.height) +
        " pixels, like the camera; it is " + std::to_string(depth.cols) + "x" +
        std::to_string(depth.rows) + ", OpenCV type " + std::to_string(depth.type()));
  }
  const cv::Mat reduced = Reduce(depth);
  Integrate(reduced);
  std::vector<SurfaceNormal> normals;
  const int step = ScaledLength(kGridStep, width_, 1);
  for (int y = step / 2; y < height_; y += step) {
    for (int x = step / 2; x < width_; x += step) {
      const double z = reduced.at<float>(y, x);
      Window window;
      SurfaceNormal normal;
      if (!(z >= options_.min_depth && z <= options_.max_depth)) continue;
      if (SelectWindow(x, y, z, &window) && EstimateInWindow(window, &normal)) {
        normals.push_back(normal);
      }
    }
  }
  return normals;
}

}  // namespace msc_vo
