// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/point_extractor.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <tuple>

#include <opencv2/imgproc.hpp>

#include "msc_vo/features/internal/corner_refinement.h"
#include "msc_vo/features/internal/fast_corners.h"
#include "msc_vo/features/internal/point_descriptor_extractor.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/sensor/standalone_image.h"

namespace msc_vo {

namespace {

constexpr int kBorder = PointDescriptorExtractor::kBorder;
static_assert(kFastMinColumns > 2 * kBorder);

bool Stronger(const FastCorner& a, const FastCorner& b) {
  return std::make_tuple(-a.response, a.pixel.y, a.pixel.x) <
         std::make_tuple(-b.response, b.pixel.y, b.pixel.x);
}

// Corners of one level in a grid of square cells, about as many cells as corners are wanted.
class CellGrid {
 public:
  CellGrid(const cv::Rect& area, int num_wanted, const std::vector<FastCorner>& corners)
      : area_(area), num_wanted_(num_wanted), corners_(corners.size()) {
    const double size = std::sqrt(static_cast<double>(area.area()) / std::max(1, num_wanted));
    columns_ = std::max(1, static_cast<int>(std::lround(area.width / size)));
    rows_ = std::max(1, static_cast<int>(std::lround(area.height / size)));
    cells_.resize(static_cast<size_t>(columns_) * rows_);
    for (const FastCorner& corner : corners) ++cells_[CellOf(corner)].count;
    for (size_t i = 1; i < cells_.size(); ++i) cells_[i].begin = cells_[i - 1].end();
    for (Cell& cell : cells_) cell.count = 0;
    for (const FastCorner& corner : corners) {
      Cell& cell = cells_[CellOf(corner)];
      corners_[cell.begin + cell.count++] = corner;
    }
    for (const Cell& cell : cells_) {
      std::sort(corners_.begin() + cell.begin, corners_.begin() + cell.end(), Stronger);
    }
  }

  // Removes corners that do not exceed the threshold from cells with a corner that does.
  void RemoveWeakBesideStrong(int threshold) {
    for (Cell& cell : cells_) {
      if (cell.count == 0 || corners_[cell.begin].response <= threshold) continue;
      while (corners_[cell.end() - 1].response <= threshold) --cell.count;
    }
  }

  // Selects the strongest corner of every cell, then the second of every cell, and so on up to the
  // wanted number; within one round the stronger ones first.
  std::vector<FastCorner> Select() const {
    std::vector<FastCorner> selected;
    for (int round = 0; static_cast<int>(selected.size()) < num_wanted_; ++round) {
      const size_t before = selected.size();
      for (const Cell& cell : cells_) {
        if (round < cell.count) selected.push_back(corners_[cell.begin + round]);
      }
      if (selected.size() == before) break;
      std::sort(selected.begin() + before, selected.end(), Stronger);
    }
    if (static_cast<int>(selected.size()) > num_wanted_) selected.resize(num_wanted_);
    return selected;
  }

 private:
  // Range of the corners in a cell.
  struct Cell {
    int begin = 0;
    int count = 0;
    int end() const { return begin + count; }
  };

  int CellOf(const FastCorner& corner) const {
    const int column = (corner.pixel.x - area_.x) * columns_ / area_.width;
    const int row = (corner.pixel.y - area_.y) * rows_ / area_.height;
    return row * columns_ + column;
  }

  cv::Rect area_;
  int num_wanted_;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<FastCorner> corners_;  // cell by cell, each with the strongest first
  std::vector<Cell> cells_;          // row by row
};

cv::Rect DetectionArea(const cv::Mat& level) {
  return {kBorder, kBorder, level.cols - 2 * kBorder, level.rows - 2 * kBorder};
}

// `is_usable`: of the pixels of corners; empty: all are.
std::vector<FastCorner> DetectCorners(const cv::Mat& level, int num_wanted,
                                      const PointExtractorOptions& options,
                                      const std::function<bool(const cv::Point&)>& is_usable) {
  const cv::Rect area = DetectionArea(level);
  std::vector<FastCorner> corners = DetectFastCorners(level, area, options.min_fast_threshold);
  if (is_usable) {
    const auto is_left_out = [&](const FastCorner& corner) { return !is_usable(corner.pixel); };
    EraseIf(&corners, is_left_out);
  }
  CellGrid grid(area, num_wanted, corners);
  grid.RemoveWeakBesideStrong(options.fast_threshold);
  return grid.Select();
}

// Converts a pixel of a level to the full image. Resizing preserves the outline of the image, half
// a pixel outside the centres of the border pixels; the sizes are rounded to integers.
Eigen::Vector2d ToFullImage(const Eigen::Vector2d& pixel, const cv::Size& level,
                            const cv::Size& image) {
  return {(pixel.x() + 0.5) * image.width / level.width - 0.5,
          (pixel.y() + 0.5) * image.height / level.height - 0.5};
}

// Refines the corners of one level to sub-pixels. Keeps the first of several corners that converge
// to the same pixel.
std::vector<RefinedCorner> RefineCorners(const cv::Mat& level, const cv::Mat& smooth,
                                         const std::vector<FastCorner>& corners) {
  const CornerRefiner refiner(level, smooth, DetectionArea(level));
  cv::Mat taken = cv::Mat::zeros(level.size(), CV_8UC1);
  std::vector<RefinedCorner> refined;
  for (const FastCorner& corner : corners) {
    const RefinedCorner candidate = refiner.Refine(corner.pixel);
    uint8_t& is_taken = taken.at<uint8_t>(candidate.pixel);
    if (is_taken == 0) refined.push_back(candidate);
    is_taken = 1;
  }
  return refined;
}

}  // namespace

PointExtractor::PointExtractor(const PointExtractorOptions& options) : options_(options) {
  levels_.resize(options.num_levels);
  // The number of points is proportional to the level's side length, as in ORB: for level l the
  // fraction q^l (1 - q) / (1 - q^levels).
  const double q = 1.0 / kPyramidScale;
  double num_on_level = options.num_points * (1.0 - q) / (1.0 - std::pow(q, options.num_levels));
  double scale = 1.0;
  int num_left = options.num_points;  // rounded numbers may exceed the total
  for (Level& level : levels_) {
    level.num_points = std::min(cvRound(num_on_level), num_left);
    level.scale = scale;
    num_left -= level.num_points;
    num_on_level *= q;
    scale *= kPyramidScale;
  }
}

bool PointExtractor::IsFarFromMask(const Level& level, const cv::Point& pixel) const {
  const Eigen::Vector2d position =
      ToFullImage({pixel.x, pixel.y}, level.image.size(), levels_[0].image.size());
  const int x = std::clamp(cvRound(position.x()), 0, distance_to_mask_.cols - 1);
  const int y = std::clamp(cvRound(position.y()), 0, distance_to_mask_.rows - 1);
  return distance_to_mask_.at<float>(y, x) > kBorder * level.scale;
}

int PointExtractor::SetImage(const cv::Mat& gray, const cv::Mat& distance_to_mask) {
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("PointExtractor: the image must be 8-bit grey (CV_8UC1)");
  }
  distance_to_mask_ = distance_to_mask;
  levels_[0].image = StandaloneImage(gray);
  for (size_t l = 0; l < levels_.size(); ++l) {
    const cv::Size size(cvRound(gray.cols / levels_[l].scale),
                        cvRound(gray.rows / levels_[l].scale));
    if (size.width < kFastMinColumns || size.height <= 2 * kBorder) return static_cast<int>(l);
    if (l == 0) continue;
    cv::resize(levels_[l - 1].image, levels_[l].image, size, 0.0, 0.0, cv::INTER_LINEAR);
  }
  return static_cast<int>(levels_.size());
}

std::vector<PointFeature> PointExtractor::ExtractLevel(int l) {
  Level& level = levels_[l];
  std::function<bool(const cv::Point&)> is_usable;
  if (!distance_to_mask_.empty()) {
    is_usable = [&](const cv::Point& pixel) { return IsFarFromMask(level, pixel); };
  }
  const std::vector<FastCorner> corners =
      DetectCorners(level.image, level.num_points, options_, is_usable);
  // Binomial filter of size five: approximately a Gaussian of one pixel.
  cv::GaussianBlur(level.image, level.smooth, cv::Size(5, 5), /*sigmaX=*/0.0);
  const PointDescriptorExtractor descriptor_extractor(level.image, level.smooth);
  std::vector<PointFeature> points;
  for (const RefinedCorner& corner : RefineCorners(level.image, level.smooth, corners)) {
    if (is_usable && !is_usable(corner.pixel)) continue;  // refinement has moved it
    PointFeature point;
    point.pixel = ToFullImage(corner.position, level.image.size(), levels_[0].image.size());
    point.sigma = level.scale;
    point.level = l;
    point.angle = descriptor_extractor.Angle(corner.pixel);
    point.descriptor = descriptor_extractor.Describe(corner.pixel, point.angle);
    points.push_back(point);
  }
  return points;
}

std::vector<PointFeature> PointExtractor::Extract(const cv::Mat& gray) {
  std::vector<PointFeature> points;
  const int num_levels = SetImage(gray);
  for (int l = 0; l < num_levels; ++l) {
    const std::vector<PointFeature> level_points = ExtractLevel(l);
    points.insert(points.end(), level_points.begin(), level_points.end());
  }
  return points;
}

}  // namespace msc_vo
