// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/plane_extractor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "msc_vo/camera/image_scale.h"
#include "msc_vo/camera/lens_validity.h"

namespace msc_vo {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Lengths are pixels at an image width of 640.

// A cell is large enough that noise tilts its plane little, and small enough that furniture leaves
// some of a wall free.
constexpr int kCellSize = 16;
// Spacing of the pixels that are used: closer ones hardly tell more, as their errors are correlated
// (half of a structured-light sensor's matching window of 9 pixels, as for surface normals).
constexpr int kStep = 2;
constexpr double kErrorLength = 5.0;
// Fraction of the pixels of a cell that must have a depth.
constexpr double kMinDepthRatio = 0.75;
// Largest root mean square residual of a cell, and difference between a cell and the plane of a
// region, in sigmas of the random part: the rest is the roughness of real walls.
constexpr double kMaxCellResidual = 2.0;
constexpr double kMaxDifference = 3.0;
// Marks the ray of a pixel that does not belong to the undistorted image.
constexpr float kHidden = 1e9f;

}  // namespace

// Sums over the pixels of one cell or several: of b b^T, b w and w^2, with ray b and inverse depth
// w.
struct PlaneExtractor::Cell {
  Matrix3d square_rays = Matrix3d::Zero();
  Vector3d rays_times_depth = Vector3d::Zero();
  double square_depth = 0.0;
  int count = 0;
  Vector3d inverse_depth = Vector3d::Zero();                  // of the plane; 1/metres
  double residual = std::numeric_limits<double>::infinity();  // root mean square, 1/metres
  bool taken = false;

  void Add(const Cell& other) {
    square_rays += other.square_rays;
    rays_times_depth += other.rays_times_depth;
    square_depth += other.square_depth;
    count += other.count;
  }
  void Fit() {
    inverse_depth = square_rays.ldlt().solve(rays_times_depth);
    const double squares = square_depth - inverse_depth.dot(rays_times_depth);
    residual = std::sqrt(std::max(0.0, squares) / count);
  }
};

bool PlaneExtractorOptions::IsValid(std::string* error) const {
  if (!(min_depth > 0.0 && max_depth > min_depth)) {
    *error = "planes: 0 < min_depth < max_depth (metres) must hold";
  } else if (!(inverse_depth_noise > 0.0 && common_sigma >= 0.0)) {
    *error = "planes: inverse_depth_noise must be positive, and common_sigma not negative";
  } else if (!(min_ratio > 0.0 && min_ratio <= 1.0)) {
    *error = "planes: min_ratio must be in (0, 1]";
  } else {
    return true;
  }
  return false;
}

PlaneExtractor::PlaneExtractor(const PlaneExtractorOptions& options, const PinholeCamera& camera,
                               const LensDistortion& distortion)
    : options_(options), camera_(camera) {
  std::string error;
  if (!options.IsValid(&error) || !camera.IsValid(&error) ||
      !IsInvertible(distortion, camera, &error)) {
    throw std::invalid_argument("PlaneExtractor: " + error);
  }
  step_ = ScaledLength(kStep, camera.width, 1);
  cell_size_ = step_ * std::max(ScaledLength(kCellSize, camera.width, 4) / step_, 4);
  columns_ = camera.width / cell_size_;
  rows_ = camera.height / cell_size_;
  correlation_area_ = std::pow(kErrorLength * ImageScale(camera.width), 2);
  const int per_side = cell_size_ / step_;
  rays_.reserve(static_cast<size_t>(columns_) * rows_ * per_side * per_side);
  for (int cell = 0; cell < columns_ * rows_; ++cell) {
    for (int i = 0; i < per_side * per_side; ++i) {
      const int x = (cell % columns_) * cell_size_ + (i % per_side) * step_;
      const int y = (cell / columns_) * cell_size_ + (i / per_side) * step_;
      Eigen::Vector2d pixel(x, y);
      if (!distortion.IsZero()) pixel = distortion.Undistort(camera, pixel);
      const bool is_shown = !distortion.IsCropped() || camera.IsInside(pixel);
      const Vector3d ray = camera.Ray(pixel);
      rays_.push_back(is_shown ? Eigen::Vector2f(ray.head<2>().cast<float>())
                               : Eigen::Vector2f(kHidden, kHidden));
    }
  }
  cells_.resize(static_cast<size_t>(columns_) * rows_);
}

PlaneExtractor::~PlaneExtractor() = default;

std::vector<PlaneFeature> PlaneExtractor::Extract(const cv::Mat& depth) {
  if (depth.type() != CV_32FC1 || depth.cols != camera_.width || depth.rows != camera_.height) {
    throw std::invalid_argument(
        "PlaneExtractor: the depth image must be float (CV_32FC1, metres) of " +
        std::to_string(camera_.width) + "x" + std::to_string(camera_.height) +
        " pixels, like the camera; it is " + std::to_string(depth.cols) + "x" +
        std::to_string(depth.rows) + ", OpenCV type " + std::to_string(depth.type()));
  }
  FitCells(depth);
  noise_ = NoiseOfCells();
  std::vector<int> seeds;
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (cells_[i].residual <= kMaxCellResidual * noise_) {
      seeds.push_back(static_cast<int>(i));
    }
  }
  std::stable_sort(seeds.begin(), seeds.end(),
                   [&](int a, int b) { return cells_[a].residual < cells_[b].residual; });
  const double min_pixels = options_.min_ratio * camera_.width * camera_.height;
  std::vector<PlaneFeature> planes;
  for (const int seed : seeds) {
    if (cells_[seed].taken) continue;
    Cell region;
    Grow(seed, &region);
    if (region.count * step_ * step_ < min_pixels) continue;
    planes.push_back(MakeFeature(region));
  }
  std::stable_sort(planes.begin(), planes.end(), [](const PlaneFeature& a, const PlaneFeature& b) {
    return a.num_pixels > b.num_pixels;
  });
  return planes;
}

double PlaneExtractor::NoiseOfCells() const {
  std::vector<double> residuals;
  for (const Cell& cell : cells_) {
    if (std::isfinite(cell.residual)) residuals.push_back(cell.residual);
  }
  if (residuals.empty()) return options_.inverse_depth_noise;
  static const double quant = std::getenv("PLQ") ? std::atof(std::getenv("PLQ")) : 0.25;
  static const double fac = std::getenv("PLK") ? std::atof(std::getenv("PLK")) : 2.0;
  const auto middle = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() * quant);
  std::nth_element(residuals.begin(), middle, residuals.end());
  if (std::getenv("PLDUMP")) std::fprintf(stderr, "NOISE %g\n", *middle);
  return std::clamp(fac * *middle, 2e-4, options_.inverse_depth_noise);
}

void PlaneExtractor::FitCells(const cv::Mat& depth) {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      cells_[static_cast<size_t>(row) * columns_ + column] = FitCell(depth, column, row);
    }
  }
}

PlaneExtractor::Cell PlaneExtractor::FitCell(const cv::Mat& depth, int column, int row) const {
  const int per_side = cell_size_ / step_;
  const Eigen::Vector2f* ray =
      &rays_[static_cast<size_t>(row * columns_ + column) * per_side * per_side];
  const auto nearest = static_cast<float>(options_.min_depth);
  const auto farthest = static_cast<float>(options_.max_depth);
  // xx, xy, yy, x, y, xw, yw, w, ww
  std::array<float, 9> sums{};
  Cell cell;
  for (int v = 0; v < per_side; ++v) {
    const float* z = depth.ptr<float>(row * cell_size_ + v * step_) + column * cell_size_;
    for (int u = 0; u < per_side; ++u, ++ray, z += step_) {
      if (!(*z >= nearest && *z <= farthest) || ray->x() == kHidden) continue;
      const float x = ray->x(), y = ray->y(), w = 1.0f / *z;
      const std::array<float, 9> terms{x * x, x * y, y * y, x, y, x * w, y * w, w, w * w};
      for (size_t i = 0; i < sums.size(); ++i) sums[i] += terms[i];
      ++cell.count;
    }
  }
  if (cell.count < kMinDepthRatio * per_side * per_side) return Cell();
  const double n = cell.count;
  cell.square_rays << sums[0], sums[1], sums[3], sums[1], sums[2], sums[4], sums[3], sums[4], n;
  cell.rays_times_depth << sums[5], sums[6], sums[7];
  cell.square_depth = sums[8];
  cell.Fit();
  return cell;
}

// Whether the plane of the region explains the depths of the cell.
bool PlaneExtractor::LiesOn(const Cell& cell, const Vector3d& inverse_depth) const {
  const double limit = kMaxDifference * noise_;
  const Vector3d difference = cell.inverse_depth - inverse_depth;
  return difference.dot(cell.square_rays * difference) <= limit * limit * cell.count;
}

// Marks the cells of the region around a seed as taken, and sums them.
void PlaneExtractor::Grow(int seed, Cell* region) {
  std::vector<int> cells{seed};
  cells_[seed].taken = true;
  *region = cells_[seed];
  for (size_t next = 0; next < cells.size(); ++next) {
    const int column = cells[next] % columns_, row = cells[next] / columns_;
    const std::array<std::array<int, 2>, 4> neighbours{
        {{column - 1, row}, {column + 1, row}, {column, row - 1}, {column, row + 1}}};
    for (const auto& [x, y] : neighbours) {
      if (x < 0 || y < 0 || x >= columns_ || y >= rows_) continue;
      const int index = y * columns_ + x;
      Cell& cell = cells_[index];
      if (cell.taken || !(cell.residual <= kMaxCellResidual * noise_) ||
          !LiesOn(cell, region->inverse_depth)) {
        continue;
      }
      cell.taken = true;
      cells.push_back(index);
      region->Add(cell);
      region->Fit();
    }
  }
  // The plane has moved since its first cells joined.
  for (int round = 0; round < 3; ++round) {
    const Vector3d plane = region->inverse_depth;
    const size_t before = cells.size();
    cells.erase(std::remove_if(cells.begin(), cells.end(),
                               [&](int index) { return !LiesOn(cells_[index], plane); }),
                cells.end());
    if (cells.size() == before && round > 0) break;
    *region = Cell();
    for (const int index : cells) region->Add(cells_[index]);
    if (cells.empty()) break;
    region->Fit();
  }
  Matrix3d info = Matrix3d::Zero();
  double squares = 0.0;
  for (const int index : cells) {
    const Cell& cell = cells_[index];
    const Vector3d difference = cell.inverse_depth - region->inverse_depth;
    info += cell.square_rays / cell.count;
    squares += difference.dot(cell.square_rays * difference) / cell.count;
  }
  scatter_ = (squares / std::max<size_t>(1, cells.size()) + 4e-8) * info.inverse();
}

PlaneFeature PlaneExtractor::MakeFeature(const Cell& region) const {
  PlaneFeature plane;
  plane.inverse_depth = region.inverse_depth;
  const double variance = std::pow(options_.inverse_depth_noise, 2) * correlation_area_ /
                          static_cast<double>(step_ * step_);
  static const double common = std::getenv("PLC") ? std::atof(std::getenv("PLC")) : 1.0;
  plane.covariance = (variance > 0 ? 4.0 : 1.0) * scatter_ +
                     std::pow(common * noise_, 2) * Matrix3d::Identity();
  plane.mean_square_ray = region.square_rays / region.count;
  plane.num_pixels = region.count * step_ * step_;
  return plane;
}

}  // namespace msc_vo
