// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/plane_extractor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <Eigen/LU>

#include "msc_vo/camera/image_scale.h"
#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/geometry/erase_if.h"

namespace msc_vo {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

// Lengths are pixels at an image width of 640.

// A cell is large enough that noise tilts its plane little, and small enough that furniture leaves
// some of a wall free.
constexpr int kCellSize = 16;
// Spacing of the pixels that are used: closer ones hardly tell more, as their errors are correlated
// (half of a structured-light sensor's matching window of 9 pixels, as for surface normals).
constexpr int kStep = 2;
// Fraction of the pixels of a cell that must have a depth.
constexpr double kMinDepthRatio = 0.75;
// Largest root mean square residual of a cell, and difference between a cell and the plane of a
// region, in sigmas of the random part of the image: the rest is the roughness of real walls.
constexpr double kMaxCellResidual = 2.0;
constexpr double kMaxDifference = 3.0;
// That random part, in lower quartiles of the residuals of the cells: a cell hides what is common
// to its pixels.
constexpr double kNoiseOfQuartile = 2.0;
// Walls are not flatter, 1/metres: 0.8 mm at 2 m.
constexpr double kFlatness = 2e-4;
// Rounds in which cells that do not lie on the plane of their region leave it.
constexpr int kTrimRounds = 3;
// Cells that share one error: with their neighbours to the right and below.
constexpr double kCellsOfOneError = 4.0;
// Error that all cells of a plane have in common, in sigmas of the random part.
constexpr double kCommonPart = 0.5;
// Cells of a row that are summed at once.
constexpr int kLanes = 8;
using Lanes = Eigen::Array<float, kLanes, 1>;

// A positive definite matrix, which is singular for a region that is seen edge-on only: the result
// is then not finite, and the region is no plane.
Vector3d Solve(const Matrix3d& a, const Vector3d& b) { return a.inverse() * b; }

}  // namespace

// Sums over the pixels of one cell or several, of b b^T and b w with ray b and inverse depth w, and
// the plane that they fit.
struct PlaneExtractor::Cell {
  Matrix3d square_rays = Matrix3d::Zero();
  Vector3d rays_times_depth = Vector3d::Zero();
  int count = 0;
  Vector3d inverse_depth = Vector3d::Zero();  // of the plane; 1/metres
  // Of a single cell: root mean square, 1/metres.
  double residual = std::numeric_limits<double>::infinity();
  bool taken = false;

  void Add(const Cell& other) {
    square_rays += other.square_rays;
    rays_times_depth += other.rays_times_depth;
    count += other.count;
  }
  void Fit() { inverse_depth = Solve(square_rays, rays_times_depth); }
};

// Sums over the pixels of neighbouring cells, each in its lane, relative to the ray and the inverse
// depth of a pixel of the cell: single precision would lose the residuals of near surfaces.
struct PlaneExtractor::CellSums {
  Lanes count = Lanes::Zero();
  Lanes xx = count, xy = count, yy = count, x = count, y = count;
  Lanes xw = count, yw = count, w = count, ww = count;

  void Add(const Lanes& is_valid, const Lanes& ray_x, const Lanes& ray_y,
           const Lanes& inverse_depth) {
    const Lanes valid_x = is_valid * ray_x, valid_y = is_valid * ray_y;
    const Lanes valid_w = is_valid * inverse_depth;
    count += is_valid;
    x += valid_x;
    y += valid_y;
    xx += valid_x * ray_x;
    xy += valid_x * ray_y;
    yy += valid_y * ray_y;
    w += valid_w;
    xw += valid_w * ray_x;
    yw += valid_w * ray_y;
    ww += valid_w * inverse_depth;
  }

  // The cell of lane k, whose ray and inverse depth are those that the sums are relative to.
  Cell MakeCell(int k, const Vector2d& ray, double inverse_depth) const {
    Matrix3d square_rays;
    square_rays << xx[k], xy[k], x[k], xy[k], yy[k], y[k], x[k], y[k], count[k];
    const Vector3d rays_times_depth(xw[k], yw[k], w[k]);
    const Vector3d rays = square_rays.col(2);
    const Vector3d plane = Solve(square_rays, rays_times_depth);
    const Vector3d shift(ray.x(), ray.y(), 0.0);
    Cell cell;
    cell.count = static_cast<int>(count[k]);
    cell.residual = std::sqrt(std::max(0.0, ww[k] - plane.dot(rays_times_depth)) / cell.count);
    cell.inverse_depth = plane + (inverse_depth - plane.dot(shift)) * Vector3d::UnitZ();
    cell.square_rays = square_rays + shift * rays.transpose() + rays * shift.transpose() +
                       cell.count * shift * shift.transpose();
    cell.rays_times_depth =
        rays_times_depth + inverse_depth * rays + (w[k] + cell.count * inverse_depth) * shift;
    return cell;
  }
};

bool PlaneExtractorOptions::IsValid(std::string* error) const {
  if (!(min_depth > 0.0 && max_depth > min_depth)) {
    *error = "planes: 0 < min_depth < max_depth (metres) must hold";
  } else if (!(inverse_depth_noise > 0.0)) {
    *error = "planes: inverse_depth_noise must be positive";
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
  cells_.resize(static_cast<size_t>(columns_) * rows_);
  ComputeRays(distortion);
}

void PlaneExtractor::ComputeRays(const LensDistortion& distortion) {
  // Returns NaN for what a wide lens records, but the undistorted image does not show.
  const auto ray_of = [&](Vector2d pixel) -> Vector2d {
    if (!distortion.IsZero()) pixel = distortion.Undistort(camera_, pixel);
    const bool is_shown = !distortion.IsCropped() || camera_.IsInside(pixel);
    return is_shown ? Vector2d(camera_.Ray(pixel).head<2>())
                    : Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
  };
  const int per_side = cell_size_ / step_;
  groups_ = (columns_ + kLanes - 1) / kLanes;
  const size_t size = static_cast<size_t>(rows_) * groups_ * per_side * per_side * kLanes;
  rays_x_.assign(size, 0.0f);
  rays_y_.assign(size, 0.0f);
  max_depth_.assign(size, 0.0f);
  first_rays_.assign(cells_.size(), Vector2d::Zero());
  for (int cell = 0; cell < columns_ * rows_; ++cell) {
    const int column = cell % columns_, row = cell / columns_;
    bool is_first = true;
    for (int i = 0; i < per_side * per_side; ++i) {
      const Vector2d ray = ray_of({column * cell_size_ + (i % per_side) * step_,
                                   row * cell_size_ + (i / per_side) * step_});
      if (!ray.allFinite()) continue;
      if (std::exchange(is_first, false)) first_rays_[cell] = ray;
      const size_t index = FirstRay(row, column / kLanes) + i * kLanes + column % kLanes;
      rays_x_[index] = static_cast<float>(ray.x() - first_rays_[cell].x());
      rays_y_[index] = static_cast<float>(ray.y() - first_rays_[cell].y());
      max_depth_[index] = static_cast<float>(options_.max_depth);
    }
  }
  for (int row = 0; row <= rows_; ++row) {
    for (int column = 0; column <= columns_; ++column) {
      // The last corner may be half a pixel outside the image.
      corners_.push_back(ray_of({std::min(column * cell_size_, camera_.width - 1),
                                 std::min(row * cell_size_, camera_.height - 1)}));
    }
  }
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
    const std::vector<int> cells = Grow(seed, &region);
    if (region.count * step_ * step_ < min_pixels) continue;
    planes.push_back(MakeFeature(region, cells));
  }
  std::stable_sort(planes.begin(), planes.end(), [](const PlaneFeature& a, const PlaneFeature& b) {
    return a.num_pixels > b.num_pixels;
  });
  return planes;
}

// Random part of the inverse depths of this image, 1/metres. Most cells of a scene with planes are
// flat; that of the options, which stands for a whole kind of sensor, is the largest that a sensor
// of that kind shows.
double PlaneExtractor::NoiseOfCells() const {
  std::vector<double> residuals;
  for (const Cell& cell : cells_) {
    if (std::isfinite(cell.residual)) residuals.push_back(cell.residual);
  }
  if (residuals.empty()) return options_.inverse_depth_noise;
  const auto quartile = residuals.begin() + static_cast<std::ptrdiff_t>(residuals.size() / 4);
  std::nth_element(residuals.begin(), quartile, residuals.end());
  return std::min(std::max(kNoiseOfQuartile * *quartile, kFlatness), options_.inverse_depth_noise);
}

// Index of the first ray of a group of cells.
size_t PlaneExtractor::FirstRay(int row, int group) const {
  const int per_side = cell_size_ / step_;
  return (static_cast<size_t>(row) * groups_ + group) * per_side * per_side * kLanes;
}

void PlaneExtractor::FitCells(const cv::Mat& depth) {
  for (int row = 0; row < rows_; ++row) {
    for (int group = 0; group < groups_; ++group) FitGroup(depth, row, group);
  }
}

// The first valid inverse depth of a cell, 1/metres; 0 if there is none.
float PlaneExtractor::FirstInverseDepth(const cv::Mat& depth, int row, int column) const {
  for (int y = row * cell_size_; y < (row + 1) * cell_size_; y += step_) {
    const float* z = depth.ptr<float>(y) + column * cell_size_;
    for (int x = 0; x < cell_size_; x += step_) {
      if (z[x] >= options_.min_depth && z[x] <= options_.max_depth) return 1.0f / z[x];
    }
  }
  return 0.0f;
}

// Each cell is summed pixel by pixel, in its lane.
void PlaneExtractor::FitGroup(const cv::Mat& depth, int row, int group) {
  const int per_side = cell_size_ / step_;
  std::array<int, kLanes> first_pixels;  // of the cells in an image row
  Lanes first_depth;
  for (int k = 0; k < kLanes; ++k) {
    const int column = std::min(group * kLanes + k, columns_ - 1);
    first_pixels[k] = column * cell_size_;
    first_depth[k] = FirstInverseDepth(depth, row, column);
  }
  const auto nearest = static_cast<float>(options_.min_depth);
  size_t ray = FirstRay(row, group);
  CellSums sums;
  for (int v = 0; v < per_side; ++v) {
    const float* image_row = depth.ptr<float>(row * cell_size_ + v * step_);
    for (int u = 0; u < per_side; ++u, ray += kLanes) {
      Lanes is_valid, inverse_depth;
      for (int k = 0; k < kLanes; ++k) {
        const float z = image_row[first_pixels[k] + u * step_];
        const bool valid = (z >= nearest) & (z <= max_depth_[ray + k]);
        is_valid[k] = valid ? 1.0f : 0.0f;
        inverse_depth[k] = 1.0f / (valid ? z : 1.0f) - first_depth[k];
      }
      sums.Add(is_valid, Eigen::Map<const Lanes>(&rays_x_[ray]),
               Eigen::Map<const Lanes>(&rays_y_[ray]), inverse_depth);
    }
  }
  for (int k = 0; k < std::min(kLanes, columns_ - group * kLanes); ++k) {
    const size_t index = static_cast<size_t>(row) * columns_ + group * kLanes + k;
    const bool has_depth = sums.count[k] >= kMinDepthRatio * per_side * per_side;
    cells_[index] = has_depth ? sums.MakeCell(k, first_rays_[index], first_depth[k]) : Cell();
  }
}

// Whether the plane of the region explains the depths of the cell.
bool PlaneExtractor::LiesOn(const Cell& cell, const Vector3d& inverse_depth) const {
  const double limit = kMaxDifference * noise_;
  const Vector3d difference = cell.inverse_depth - inverse_depth;
  return difference.dot(cell.square_rays * difference) <= limit * limit * cell.count;
}

// Marks the cells of the region around a seed as taken, and sums them. Returns those that remain on
// its plane.
std::vector<int> PlaneExtractor::Grow(int seed, Cell* region) {
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
  for (int round = 0; round < kTrimRounds; ++round) {
    const Vector3d plane = region->inverse_depth;
    EraseIf(&cells, [&](int index) { return !LiesOn(cells_[index], plane); });
    *region = Cell();
    for (const int index : cells) region->Add(cells_[index]);
    if (cells.empty()) break;
    region->Fit();
  }
  return cells;
}

// Of the corners of the outermost cells in each row: those between them are in their hull.
ConvexPolygon PlaneExtractor::Hull(const std::vector<int>& cells) const {
  std::vector<std::pair<int, int>> ends(rows_, {columns_, -1});  // first and last column
  for (const int cell : cells) {
    auto& [first, last] = ends[cell / columns_];
    first = std::min(first, cell % columns_);
    last = std::max(last, cell % columns_);
  }
  std::vector<Vector2d> points;
  for (int row = 0; row < rows_; ++row) {
    const auto& [first, last] = ends[row];
    if (last < 0) continue;
    for (const int y : {row, row + 1}) {
      for (const int x : {first, last + 1}) {
        const Vector2d& corner = corners_[static_cast<size_t>(y) * (columns_ + 1) + x];
        if (corner.allFinite()) points.push_back(corner);
      }
    }
  }
  ConvexPolygon hull = ConvexHull(std::move(points));
  Simplify(PlaneFeature::kMaxHullVertices, &hull);
  return hull;
}

// The cells, each with its own plane, tell how well they agree.
PlaneFeature PlaneExtractor::MakeFeature(const Cell& region, const std::vector<int>& cells) const {
  Matrix3d square_rays = Matrix3d::Zero();
  double squares = 0.0;
  for (const int index : cells) {
    const Cell& cell = cells_[index];
    const Vector3d difference = cell.inverse_depth - region.inverse_depth;
    square_rays += cell.square_rays / cell.count;
    squares += difference.dot(cell.square_rays * difference) / cell.count;
  }
  const double variance = squares / static_cast<double>(cells.size()) + kFlatness * kFlatness;
  PlaneFeature plane;
  plane.inverse_depth = region.inverse_depth;
  plane.covariance = kCellsOfOneError * variance * square_rays.inverse() +
                     std::pow(kCommonPart * noise_, 2) * Matrix3d::Identity();
  plane.mean_square_ray = region.square_rays / region.count;
  plane.num_pixels = region.count * step_ * step_;
  plane.hull = Hull(cells);
  return plane;
}

}  // namespace msc_vo
