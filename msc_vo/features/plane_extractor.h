// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

#include "msc_vo/camera/lens_distortion.h"
#include "msc_vo/frame/plane_feature.h"

namespace msc_vo {

struct PlaneExtractorOptions {
  double min_depth = 0.2;  ///< metres; depth outside [min_depth, max_depth] is invalid
  double max_depth = 10.0;
  /// Largest standard deviation of the random part of inverse depth, 1/metres; that of an image is
  /// estimated from the image.
  double inverse_depth_noise = 0.002;
  /// Smallest part of the image that a plane covers.
  double min_ratio = 0.02;

  bool IsValid(std::string* error) const;
};

/// Extracts planes from a depth image by region growing: a plane is fitted to the inverse depths of
/// each cell of a grid; beginning with the flattest cell, a region takes in the neighbours that lie
/// on its plane. Keeps its buffers between calls; not thread-safe.
class PlaneExtractor {
 public:
  /// `distortion` is that of the raw depth image. Throws std::invalid_argument on invalid options
  /// or an invalid camera.
  PlaneExtractor(const PlaneExtractorOptions& options, const PinholeCamera& camera,
                 const LensDistortion& distortion);
  ~PlaneExtractor();

  /// `depth`: raw image, CV_32FC1, metres along the optical axis, 0 where nothing was measured.
  /// Returns the planes, largest first. Throws std::invalid_argument if type or size of the image
  /// do not match the camera.
  std::vector<PlaneFeature> Extract(const cv::Mat& depth);

 private:
  struct Cell;
  struct CellSums;

  void ComputeRays(const LensDistortion& distortion);
  double NoiseOfCells() const;
  void FitCells(const cv::Mat& depth);
  void FitGroup(const cv::Mat& depth, int row, int group);
  size_t FirstRay(int row, int group) const;
  float FirstInverseDepth(const cv::Mat& depth, int row, int column) const;
  std::vector<int> Grow(int seed, Cell* region);
  bool LiesOn(const Cell& cell, const Eigen::Vector3d& inverse_depth) const;
  PlaneFeature MakeFeature(const Cell& region, const std::vector<int>& cells) const;
  ConvexPolygon Hull(const std::vector<int>& cells) const;

  PlaneExtractorOptions options_;
  PinholeCamera camera_;
  int cell_size_ = 0;  // pixels
  int step_ = 0;       // between the pixels that are used
  int columns_ = 0, rows_ = 0;
  int groups_ = 0;  // of neighbouring cells in a row, which are fitted together
  std::vector<Eigen::Vector2d> first_rays_;  // of each cell: x / z and y / z of its first pixel
  // x / z and y / z of the pixels that are used, relative to the first ray of the cell, and the
  // largest depth that is valid there, 0 where the pixel does not belong to the undistorted image:
  // for each group of cells and each pixel of a cell, one value per cell of the group.
  std::vector<float> rays_x_, rays_y_, max_depth_;
  // x / z and y / z of the corners of the cells; NaN if they do not belong to the undistorted
  // image.
  std::vector<Eigen::Vector2d> corners_;
  std::vector<Cell> cells_;
  double noise_ = 0.0;  // random part of the inverse depths of the image, 1/metres
};

}  // namespace msc_vo
