// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/depth_registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include <Eigen/LU>

#include "msc_vo/sensor/lens_remap.h"
#include "msc_vo/sensor/registration_target.h"

namespace msc_vo {

namespace {

// Half the side of the square that a depth pixel covers, pixels. The part above 0.5 closes the gaps
// that noise opens between neighbours on a surface.
constexpr float kHalfSide = 0.6f;
// Smallest area of a depth pixel in the colour image, square pixels.
constexpr float kMinDeterminant = 1e-6f;
// Smaller depths are no measurement, metres.
constexpr float kMinDepth = 1e-3f;
// Smallest z of a viewing ray of the depth camera in the colour camera frame.
constexpr float kMinRayZ = 0.01f;
// Half the width of the holes through which the background is removed, depth pixels.
constexpr double kHoleRadius = 2.0;

Eigen::Matrix3d Intrinsics(const PinholeCamera& camera) {
  Eigen::Matrix3d k;
  k << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  return k;
}

// Values of three neighbours in a row or in a column, by element.
struct Neighbours {
  const float *before, *here, *after;
};

}  // namespace

// A row of the depth image as seen by the colour camera. Element u + 1 belongs to pixel u; the
// first and the last element have no depth.
struct DepthRegistration::Row {
  explicit Row(int width)
      : x(width + 2), y(width + 2), raw_x(width + 2), raw_y(width + 2), inverse_depth(width + 2) {}

  std::vector<float> x, y;           // undistorted colour pixel
  std::vector<float> raw_x, raw_y;   // distorted colour pixel
  std::vector<float> inverse_depth;  // in the colour camera, 1/metres; 0: none
};

// Changes from a depth pixel to its neighbours on the same surface, elements as in Row.
struct DepthRegistration::Footprints {
  // Changes by one pixel in one direction.
  struct Steps {
    explicit Steps(int size) : x(size), y(size), inverse_depth(size) {}

    // Central differences; one-sided ones if only one neighbour is on the surface; `nominal` if
    // none is.
    void Compute(const Neighbours& px, const Neighbours& py, const Neighbours& w,
                 const Eigen::Vector2f& nominal) {
      const int size = static_cast<int>(x.size()) - 1;
      const float nominal_x = nominal.x(), nominal_y = nominal.y();
      float* const to_x = x.data();
      float* const to_y = y.data();
      float* const to_w = inverse_depth.data();
#pragma GCC ivdep
      for (int i = 1; i < size; ++i) {
        const float here = w.here[i], before = w.before[i], after = w.after[i];
        const float x_before = px.before[i], x_here = px.here[i], x_after = px.after[i];
        const float y_before = py.before[i], y_here = py.here[i], y_after = py.after[i];
        const float threshold = EdgeThreshold(here);
        constexpr float kNone = 1e9f;  // more than any threshold
        const float gap_before = std::abs(here - before) + (before > 0.0f ? 0.0f : kNone);
        const float gap_after = std::abs(after - here) + (after > 0.0f ? 0.0f : kNone);
        // Factors instead of branches, so that the compiler can process several pixels at once.
        const float with_before = gap_before <= threshold ? 1.0f : 0.0f;
        const float with_after = gap_after <= threshold ? 1.0f : 0.0f;
        const float without = (1.0f - with_before) * (1.0f - with_after);
        const float weight = 1.0f - 0.5f * with_before * with_after;
        const float step_x = with_after * (x_after - x_here) + with_before * (x_here - x_before);
        const float step_y = with_after * (y_after - y_here) + with_before * (y_here - y_before);
        const float step_w = with_after * (after - here) + with_before * (here - before);
        to_x[i] = weight * step_x + without * nominal_x;
        to_y[i] = weight * step_y + without * nominal_y;
        to_w[i] = weight * step_w;
      }
    }

    std::vector<float> x, y, inverse_depth;
  };

  explicit Footprints(int width)
      : right(width + 2),
        down(width + 2),
        scale(width + 2),
        first_x(width + 2),
        first_y(width + 2),
        last_x(width + 2),
        last_y(width + 2) {}

  // Computes everything below `down` for a colour image of width x height pixels. `orientation`:
  // sign of the determinant of a surface that the colour camera sees from the front. `stretch`:
  // largest size of an undistorted pixel in the distorted image.
  void ComputeBoxes(const Row& row, int width, int height, float orientation, float stretch);

  Steps right, down;
  std::vector<float> scale;  // reciprocal of the determinant of the two steps
  // Colour pixels around the footprint; the first is larger than the last if there is none.
  std::vector<int> first_x, first_y, last_x, last_y;
};

void DepthRegistration::Footprints::ComputeBoxes(const Row& row, int width, int height,
                                                 float orientation, float stretch) {
  // Data of the vectors, so that the compiler can process several elements at once.
  const float *ax = right.x.data(), *ay = right.y.data(), *bx = down.x.data(), *by = down.y.data();
  const float *px = row.raw_x.data(), *py = row.raw_y.data(), *w = row.inverse_depth.data();
  int *to_first_x = first_x.data(), *to_first_y = first_y.data();
  int *to_last_x = last_x.data(), *to_last_y = last_y.data();
  float* const to_scale = scale.data();
  const float border_x = static_cast<float>(width - 1), border_y = static_cast<float>(height - 1);
  const float half = kHalfSide * stretch;
  const int size = static_cast<int>(scale.size()) - 1;
#pragma GCC ivdep
  for (int i = 1; i < size; ++i) {
    const float determinant = ax[i] * by[i] - ay[i] * bx[i];
    const float size_x = half * (std::abs(ax[i]) + std::abs(bx[i]));
    const float size_y = half * (std::abs(ay[i]) + std::abs(by[i]));
    const float from_x = px[i] - size_x, to_x = px[i] + size_x;
    const float from_y = py[i] - size_y, to_y = py[i] + size_y;
    // Positive if the pixel has a depth, its surface is not seen from behind, and the box overlaps
    // the image.
    const float front = std::min(w[i], determinant * orientation - kMinDeterminant);
    const float inside_x = std::min(to_x, border_x - from_x);
    const float inside_y = std::min(to_y, border_y - from_y);
    const float margin = std::min(front, std::min(inside_x, inside_y));
    // The order of the arguments turns NaN, from a lens far outside the image, into a bound.
    const float low_x = std::min(border_x, std::max(0.0f, from_x));
    const float low_y = std::min(border_y, std::max(0.0f, from_y));
    const float high_x = margin > 0.0f ? std::min(border_x, to_x) : -1.0f;
    const float high_y = margin > 0.0f ? std::min(border_y, to_y) : -1.0f;
    const int floor_x = static_cast<int>(low_x), floor_y = static_cast<int>(low_y);
    to_first_x[i] = floor_x + (static_cast<float>(floor_x) < low_x ? 1 : 0);
    to_first_y[i] = floor_y + (static_cast<float>(floor_y) < low_y ? 1 : 0);
    to_last_x[i] = static_cast<int>(high_x);
    to_last_y[i] = static_cast<int>(high_y);
    to_scale[i] = 1.0f / (margin > 0.0f ? determinant : 1.0f);
  }
}

DepthRegistration::DepthRegistration(const DepthCamera& depth_camera, const PinholeCamera& color,
                                     const LensDistortion& color_distortion)
    : depth_camera_(depth_camera), color_(color), distortion_(color_distortion) {
  const Rigid3 color_from_depth = depth_camera.depth_from_color.Inverse();
  const Eigen::Matrix3d k = Intrinsics(color);
  const Eigen::Matrix3d matrix = k * color_from_depth.rotation().toRotationMatrix() *
                                 Intrinsics(depth_camera.camera).inverse();
  matrix_ = matrix.cast<float>();
  shift_ = (k * color_from_depth.translation()).cast<float>();
  const Eigen::Vector2d center(0.5 * (depth_camera.camera.width - 1),
                               0.5 * (depth_camera.camera.height - 1));
  const auto project = [&](double u, double v) -> Eigen::Vector2d {
    return (matrix * Eigen::Vector3d(u, v, 1.0)).hnormalized();
  };
  const Eigen::Vector2d here = project(center.x(), center.y());
  right_ = (project(center.x() + 1.0, center.y()) - here).cast<float>();
  down_ = (project(center.x(), center.y() + 1.0) - here).cast<float>();
  const LensDistortion& depth_lens = depth_camera.distortion;
  if (!depth_lens.IsZero()) depth_pixels_ = UndistortedPixels(depth_camera.camera, depth_lens);
  if (color_distortion.IsZero()) return;
  ideal_ = UndistortedPixels(color, color_distortion);
  stretch_ = static_cast<float>(LargestStretch(color, color_distortion));
}

void DepthRegistration::ProjectRow(const cv::Mat& depth, int v, Row* row) const {
  if (!depth_pixels_.empty()) return ProjectDistortedRow(depth, v, row);
  const int width = depth.cols;
  const float* const z = depth.ptr<float>(v);
  const Eigen::Vector3f first = matrix_.col(1) * static_cast<float>(v) + matrix_.col(2);
  const Eigen::Vector3f step = matrix_.col(0);
  const float first_x = first.x(), first_y = first.y(), first_z = first.z();
  const float step_x = step.x(), step_y = step.y(), step_z = step.z();
  const float shift_x = shift_.x(), shift_y = shift_.y(), shift_z = shift_.z();
  const float offset = static_cast<float>(depth_camera_.inverse_depth_offset);
  float* const to_x = row->x.data() + 1;
  float* const to_y = row->y.data() + 1;
  float* const to_w = row->inverse_depth.data() + 1;
#pragma GCC ivdep
  for (int u = 0; u < width; ++u) {
    const float column = static_cast<float>(u);
    const float measured = z[u];
    const float w = 1.0f / (measured > kMinDepth ? measured : 1.0f) + offset;
    const float denominator = first_z + column * step_z + shift_z * w;
    // Positive if there is a depth, which the comparison denies for NaN.
    const float margin = measured > kMinDepth ? std::min(w, denominator - kMinRayZ) : 0.0f;
    const float scale = 1.0f / (margin > 0.0f ? denominator : 1.0f);
    to_x[u] = (first_x + column * step_x + shift_x * w) * scale;
    to_y[u] = (first_y + column * step_y + shift_y * w) * scale;
    to_w[u] = margin > 0.0f ? w * scale : 0.0f;
  }
  DistortRow(row);
}

void DepthRegistration::ProjectDistortedRow(const cv::Mat& depth, int v, Row* row) const {
  const float* const z = depth.ptr<float>(v);
  const cv::Vec2f* const pixel = depth_pixels_.ptr<cv::Vec2f>(v);
  const float offset = static_cast<float>(depth_camera_.inverse_depth_offset);
  for (int u = 0; u < depth.cols; ++u) {
    const float w = z[u] > kMinDepth ? 1.0f / z[u] + offset : 0.0f;
    const Eigen::Vector3f color =
        matrix_ * Eigen::Vector3f(pixel[u][0], pixel[u][1], 1.0f) + shift_ * w;
    const bool is_seen = w > 0.0f && color.z() > kMinRayZ;
    row->x[u + 1] = is_seen ? color.x() / color.z() : 0.0f;
    row->y[u + 1] = is_seen ? color.y() / color.z() : 0.0f;
    row->inverse_depth[u + 1] = is_seen ? w / color.z() : 0.0f;
  }
  DistortRow(row);
}

void DepthRegistration::DistortRow(Row* row) const {
  if (distortion_.IsZero()) {
    row->raw_x = row->x;
    row->raw_y = row->y;
    return;
  }
  if (distortion_.model != LensModel::kRadialTangential || distortion_.recorded) {
    for (size_t i = 0; i < row->x.size(); ++i) {
      const Eigen::Vector2d raw = distortion_.Distort(color_, {row->x[i], row->y[i]});
      row->raw_x[i] = static_cast<float>(raw.x());
      row->raw_y[i] = static_cast<float>(raw.y());
    }
    return;
  }
  // As LensDistortion::Distort(), for several pixels at once. The model has five coefficients.
  std::array<float, 5> k;
  std::transform(distortion_.k.begin(), distortion_.k.begin() + k.size(), k.begin(),
                 [](double value) { return static_cast<float>(value); });
  const float fx = static_cast<float>(color_.fx), fy = static_cast<float>(color_.fy);
  const float cx = static_cast<float>(color_.cx), cy = static_cast<float>(color_.cy);
  const float *from_x = row->x.data(), *from_y = row->y.data();
  float *to_x = row->raw_x.data(), *to_y = row->raw_y.data();
  const int size = static_cast<int>(row->x.size());
#pragma GCC ivdep
  for (int i = 0; i < size; ++i) {
    const float x = (from_x[i] - cx) / fx, y = (from_y[i] - cy) / fy;
    const float r2 = x * x + y * y, xy2 = 2.0f * x * y;
    const float radial = 1.0f + r2 * (k[0] + r2 * (k[1] + r2 * k[4]));
    to_x[i] = fx * (radial * x + k[2] * xy2 + k[3] * (r2 + 2.0f * x * x)) + cx;
    to_y[i] = fy * (radial * y + k[3] * xy2 + k[2] * (r2 + 2.0f * y * y)) + cy;
  }
}

void DepthRegistration::ComputeFootprints(const Row& above, const Row& here, const Row& below,
                                          Footprints* footprints) const {
  const auto along = [](const std::vector<float>& row) -> Neighbours {
    return {row.data() - 1, row.data(), row.data() + 1};
  };
  footprints->right.Compute(along(here.x), along(here.y), along(here.inverse_depth), right_);
  footprints->down.Compute(
      {above.x.data(), here.x.data(), below.x.data()},
      {above.y.data(), here.y.data(), below.y.data()},
      {above.inverse_depth.data(), here.inverse_depth.data(), below.inverse_depth.data()}, down_);
  const float determinant = right_.x() * down_.y() - right_.y() * down_.x();
  footprints->ComputeBoxes(here, color_.width, color_.height, determinant > 0.0f ? 1.0f : -1.0f,
                           stretch_);
}

void DepthRegistration::Draw(const Row& row, const Footprints& footprints,
                             RegistrationTarget* target) const {
  const bool is_distorted = !ideal_.empty();
  for (size_t i = 1; i + 1 < row.x.size(); ++i) {
    const int last_x = footprints.last_x[i], last_y = footprints.last_y[i];
    for (int v = footprints.first_y[i]; v <= last_y; ++v) {
      const cv::Vec2f* const ideal = is_distorted ? ideal_.ptr<cv::Vec2f>(v) : nullptr;
      for (int u = footprints.first_x[i]; u <= last_x; ++u) {
        const float dx = (is_distorted ? ideal[u][0] : static_cast<float>(u)) - row.x[i];
        const float dy = (is_distorted ? ideal[u][1] : static_cast<float>(v)) - row.y[i];
        // Position in the depth image relative to the centre of the depth pixel.
        const float a =
            (footprints.down.y[i] * dx - footprints.down.x[i] * dy) * footprints.scale[i];
        const float b =
            (footprints.right.x[i] * dy - footprints.right.y[i] * dx) * footprints.scale[i];
        const float distance = std::max(std::abs(a), std::abs(b));
        if (!(distance <= kHalfSide)) continue;
        target->Offer(u, v,
                      row.inverse_depth[i] + a * footprints.right.inverse_depth[i] +
                          b * footprints.down.inverse_depth[i],
                      distance);
      }
    }
  }
}

cv::Mat DepthRegistration::Register(const cv::Mat& depth) const {
  const PinholeCamera& camera = depth_camera_.camera;
  if (depth.type() != CV_32FC1 || depth.cols != camera.width || depth.rows != camera.height) {
    throw std::invalid_argument(
        "DepthRegistration: the depth image must be CV_32FC1 and of the "
        "size of the depth camera");
  }
  const float pixels = std::sqrt(std::abs(right_.x() * down_.y() - right_.y() * down_.x()));
  RegistrationTarget target(color_, std::max(1, cvRound(kHoleRadius * pixels)));
  // Rows v - 1, v and v + 1 are elements v, v + 1 and v + 2, modulo 3.
  std::vector<Row> rows(3, Row(camera.width));
  Footprints footprints(camera.width);
  ProjectRow(depth, 0, &rows[1]);
  for (int v = 0; v < camera.height; ++v) {
    Row& below = rows[(v + 2) % 3];
    if (v + 1 < camera.height) {
      ProjectRow(depth, v + 1, &below);
    } else {
      std::fill(below.inverse_depth.begin(), below.inverse_depth.end(), 0.0f);
    }
    const Row& here = rows[(v + 1) % 3];
    ComputeFootprints(rows[v % 3], here, below, &footprints);
    Draw(here, footprints, &target);
  }
  return target.Depth();
}

cv::Mat RegisterDepth(const DepthCamera& depth_camera, const PinholeCamera& color,
                      const LensDistortion& color_distortion, const cv::Mat& depth) {
  return DepthRegistration(depth_camera, color, color_distortion).Register(depth);
}

}  // namespace msc_vo
