// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/registration_geometry.h"

#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "msc_vo/sensor/lens_remap.h"

namespace msc_vo {

namespace {

// Distance of the positions where the displacement by the lens of the depth camera is sampled,
// pixels. It is interpolated between them.
constexpr float kLensStep = 4.0f;
// Surfaces that are displaced in the depth image by more than its size are not seen.
constexpr float kMaxRelativeDisplacement = 1.0f;
// Smallest magnification at which every other colour pixel is interpolated: those that are not are
// at most 4/3 of a depth pixel apart.
constexpr float kMinInterpolated = 1.5f;

Eigen::Matrix3d Intrinsics(const PinholeCamera& camera) {
  Eigen::Matrix3d k;
  k << camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0;
  return k;
}

}  // namespace

RegistrationGeometry::RegistrationGeometry(const DepthCamera& depth_camera,
                                           const PinholeCamera& color,
                                           const LensDistortion& color_distortion)
    : width(depth_camera.camera.width),
      height(depth_camera.camera.height),
      color_width(color.width),
      color_height(color.height),
      center(0.5f * static_cast<float>(width - 1), 0.5f * static_cast<float>(height - 1)),
      inverse_depth_offset(static_cast<float>(depth_camera.inverse_depth_offset)) {
  PinholeCamera centered = depth_camera.camera;
  centered.cx -= static_cast<double>(center.x());
  centered.cy -= static_cast<double>(center.y());
  const Eigen::Matrix3d infinity_from_color =
      Intrinsics(centered) * depth_camera.depth_from_color.rotation().toRotationMatrix() *
      Intrinsics(color).inverse();
  matrix = infinity_from_color.cast<float>();
  epipole = (Intrinsics(centered) * -depth_camera.depth_from_color.translation()).cast<float>();
  // Root of the area of the central depth pixel in the colour image.
  const Eigen::Matrix3d color_from_infinity = infinity_from_color.inverse();
  const double z = color_from_infinity(2, 2);
  magnification =
      static_cast<float>(std::sqrt(std::abs(color_from_infinity.determinant() / (z * z * z))));
  grid.cells_per_pixel = 0.5f / kHalfSide;
  color_step = magnification >= kMinInterpolated ? 2 : 1;
  SetColorPixels(color, color_distortion);
  SetDepthPixels(depth_camera);
  SetGrid();
  const float size_x = 0.5f * static_cast<float>(width), size_y = 0.5f * static_cast<float>(height);
  const float pixels = std::max(std::abs(epipole.x()) + size_x * std::abs(epipole.z()),
                                std::abs(epipole.y()) + size_y * std::abs(epipole.z()));
  inverse_depth_per_pixel = 1.0f / std::max(pixels, 1e-3f);
}

void RegistrationGeometry::SetColorPixels(const PinholeCamera& color, const LensDistortion& lens) {
  const int size = (color.width + color_step - 1) / color_step;
  const int rows = lens.IsZero() ? 1 : color.height;
  if (!lens.IsZero()) color_pixels_ = UndistortedPixels(color, lens);
  color_x.values.create(rows, size, CV_32FC1);
  color_y.values = cv::Mat::zeros(rows, size, CV_32FC1);
  for (int v = 0; v < rows; ++v) {
    for (int i = 0; i < size; ++i) {
      const Eigen::Vector2f pixel = ColorPixel(i * color_step, v);
      color_x.values.at<float>(v, i) = pixel.x();
      color_y.values.at<float>(v, i) = pixel.y();
    }
  }
}

Eigen::Vector2f RegistrationGeometry::ColorPixel(int x, int y) const {
  if (color_pixels_.empty()) return {static_cast<float>(x), static_cast<float>(y)};
  const cv::Vec2f& pixel = color_pixels_.at<cv::Vec2f>(y, x);
  return {pixel[0], pixel[1]};
}

void RegistrationGeometry::SetDepthPixels(const DepthCamera& depth_camera) {
  if (!depth_camera.distortion.IsZero()) {
    const cv::Mat pixels = UndistortedPixels(depth_camera.camera, depth_camera.distortion) -
                           cv::Scalar(center.x(), center.y());
    cv::extractChannel(pixels, depth_x.values, 0);
    cv::extractChannel(pixels, depth_y.values, 1);
    SetDepthLens(depth_camera);
    return;
  }
  depth_x.values.create(1, width, CV_32FC1);
  depth_y.values = cv::Mat::zeros(1, width, CV_32FC1);
  for (int u = 0; u < width; ++u) {
    depth_x.values.at<float>(u) = static_cast<float>(u) - center.x();
  }
}

int RegistrationGeometry::Grid::IndexAround(const Eigen::Vector2f& position) const {
  const Eigen::Vector2f cell =
      (position - origin) * cells_per_pixel - Eigen::Vector2f::Constant(0.5f);
  const int x = static_cast<int>(std::min(std::max(cell.x(), 1.0f), static_cast<float>(width - 2)));
  const int y =
      static_cast<int>(std::min(std::max(cell.y(), 1.0f), static_cast<float>(height - 2)));
  return y * width + x;
}

void RegistrationGeometry::SetDepthLens(const DepthCamera& depth_camera) {
  const auto position = [&](int u, int v) -> Eigen::Vector2f {
    return {depth_x.values.at<float>(v, u), depth_y.values.at<float>(v, u)};
  };
  depth_derivative.create(height, width, CV_32FC4);
  float largest = 1.0f;
  for (int v = 0; v < height; ++v) {
    const int above = std::max(v - 1, 0), below = std::min(v + 1, height - 1);
    for (int u = 0; u < width; ++u) {
      const int left = std::max(u - 1, 0), right = std::min(u + 1, width - 1);
      Eigen::Matrix2f derivative;
      derivative.col(0) =
          (position(right, v) - position(left, v)) / static_cast<float>(std::max(1, right - left));
      derivative.col(1) = (position(u, below) - position(u, above)) /
                          static_cast<float>(std::max(1, below - above));
      largest = std::max(largest, derivative.cwiseAbs().rowwise().sum().maxCoeff());
      const Eigen::Matrix2f inverse = derivative.inverse();
      depth_derivative.at<cv::Vec4f>(v, u) = {inverse(0, 0), inverse(1, 0), inverse(0, 1),
                                              inverse(1, 1)};
    }
  }
  grid.cells_per_pixel /= largest;
  double min_x = 0.0, max_x = 0.0, min_y = 0.0, max_y = 0.0;
  cv::minMaxLoc(depth_x.values, &min_x, &max_x);
  cv::minMaxLoc(depth_y.values, &min_y, &max_y);
  lens_origin_ = Eigen::Vector2d(min_x, min_y).cast<float>();
  lens_offset_.create(cvCeil((max_y - min_y) / kLensStep) + 2,
                      cvCeil((max_x - min_x) / kLensStep) + 2, CV_32FC2);
  for (int v = 0; v < lens_offset_.rows; ++v) {
    for (int u = 0; u < lens_offset_.cols; ++u) {
      const Eigen::Vector2d pixel =
          (lens_origin_ + kLensStep * Eigen::Vector2f(u, v) + center).cast<double>();
      const Eigen::Vector2d offset =
          depth_camera.distortion.Distort(depth_camera.camera, pixel) - pixel;
      lens_offset_.at<cv::Vec2f>(v, u) = {static_cast<float>(offset.x()),
                                          static_cast<float>(offset.y())};
    }
  }
}

Eigen::Vector2f RegistrationGeometry::DepthLensOffset(float x, float y) const {
  const float last_x = static_cast<float>(lens_offset_.cols - 1) - 1e-3f;
  const float last_y = static_cast<float>(lens_offset_.rows - 1) - 1e-3f;
  const float column = std::min(last_x, std::max(0.0f, (x - lens_origin_.x()) / kLensStep));
  const float row = std::min(last_y, std::max(0.0f, (y - lens_origin_.y()) / kLensStep));
  const int u = static_cast<int>(column), v = static_cast<int>(row);
  const float a = column - static_cast<float>(u), b = row - static_cast<float>(v);
  const cv::Vec2f* const above = lens_offset_.ptr<cv::Vec2f>(v) + u;
  const cv::Vec2f* const below = lens_offset_.ptr<cv::Vec2f>(v + 1) + u;
  const cv::Vec2f offset = (1.0f - b) * ((1.0f - a) * above[0] + a * above[1]) +
                           b * ((1.0f - a) * below[0] + a * below[1]);
  return {offset[0], offset[1]};
}

void RegistrationGeometry::SetGrid() {
  Eigen::AlignedBox2f color, depth;
  const auto add_color = [&](int u, int v) {
    const Eigen::Vector3f infinity = matrix * ColorPixel(u, v).homogeneous();
    if (!infinity.allFinite()) return;
    color.extend(Eigen::Vector2f(infinity.head<2>() / std::max(infinity.z(), kMinRayZ)));
  };
  // The images of the borders enclose those of all pixels.
  for (int u = 0; u < color_width; ++u) {
    for (const int v : {0, color_height - 1}) add_color(u, v);
  }
  for (int v = 0; v < color_height; ++v) {
    for (const int u : {0, color_width - 1}) add_color(u, v);
  }
  double min_x = 0.0, max_x = 0.0, min_y = -center.y(), max_y = center.y();
  cv::minMaxLoc(depth_x.values, &min_x, &max_x);
  if (HasDepthLens()) cv::minMaxLoc(depth_y.values, &min_y, &max_y);
  depth.extend(Eigen::Vector2d(min_x, min_y).cast<float>().eval());
  depth.extend(Eigen::Vector2d(max_x, max_y).cast<float>().eval());
  const Eigen::Vector2f margin = kMaxRelativeDisplacement * depth.sizes();
  const Eigen::AlignedBox2f box =
      color.intersection(Eigen::AlignedBox2f(depth.min() - margin, depth.max() + margin));
  if (box.isEmpty()) return;
  constexpr int kBorder = 2;
  const float border = kBorder + 1.0f;  // a cell more for positions between cells
  grid.origin = box.min() - Eigen::Vector2f::Constant(border / grid.cells_per_pixel);
  grid.width = cvCeil(box.sizes().x() * grid.cells_per_pixel) + 2 * kBorder + 2;
  grid.height = cvCeil(box.sizes().y() * grid.cells_per_pixel) + 2 * kBorder + 2;
}

}  // namespace msc_vo
