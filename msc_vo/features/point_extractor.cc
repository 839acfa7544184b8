// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/point_extractor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include <opencv2/imgproc.hpp>

#include "msc_vo/features/corner_refinement.h"
#include "msc_vo/features/fast_corners.h"
#include "msc_vo/features/point_descriptor_extractor.h"

namespace msc_vo {

namespace {

constexpr int kBorder = PointDescriptorExtractor::kBorder;
static_assert(kFastMinColumns > 2 * kBorder);

bool Stronger(const FastCorner& a, const FastCorner& b) {
  return std::make_tuple(-a.response, a.pixel.y, a.pixel.x) <
         std::make_tuple(-b.response, b.pixel.y, b.pixel.x);
}

// Corners of one level, in square cells of about the size that gives each corner wanted its own.
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

  // Leaves out what does not exceed the threshold where a cell has corners that do.
  void DropWeakBesideStrong(int threshold) {
    for (Cell& cell : cells_) {
      if (cell.count == 0 || corners_[cell.begin].response <= threshold) continue;
      while (corners_[cell.end() - 1].response <= threshold) --cell.count;
    }
  }

  // The strongest corner of every cell, then the second of every cell, and so on, as many as are
  // wanted; within one round the stronger first.
  std::vector<FastCorner> Choose() const {
    std::vector<FastCorner> chosen;
    for (int round = 0; static_cast<int>(chosen.size()) < num_wanted_; ++round) {
      const size_t before = chosen.size();
      for (const Cell& cell : cells_) {
        if (round < cell.count) chosen.push_back(corners_[cell.begin + round]);
      }
      if (chosen.size() == before) break;
      std::sort(chosen.begin() + before, chosen.end(), Stronger);
    }
    if (static_cast<int>(chosen.size()) > num_wanted_) chosen.resize(num_wanted_);
    return chosen;
  }

 private:
  // Which of the corners lie in a cell.
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
  std::vector<FastCorner> corners_;  // cell by cell, the strongest of each first
  std::vector<Cell> cells_;          // row by row
};

cv::Rect DetectionArea(const cv::Mat& level) {
  return {kBorder, kBorder, level.cols - 2 * kBorder, level.rows - 2 * kBorder};
}

std::vector<FastCorner> DetectCorners(const cv::Mat& level, int num_wanted,
                                      const PointExtractorOptions& options) {
  const cv::Rect area = DetectionArea(level);
  CellGrid grid(area, num_wanted, DetectFastCorners(level, area, options.min_fast_threshold));
  grid.DropWeakBesideStrong(options.fast_threshold);
  return grid.Choose();
}

// Pixel of the full image from one of a level. Resizing keeps the image's outline, which is half a
// pixel outside the centre of the first pixel, and sizes are whole numbers.
Eigen::Vector2d ToFullImage(const Eigen::Vector2d& pixel, const cv::Size& level,
                            const cv::Size& image) {
  return {(pixel.x() + 0.5) * image.width / level.width - 0.5,
          (pixel.y() + 0.5) * image.height / level.height - 0.5};
}

// Where the corners of one level are, to sub-pixels; those that end at the same pixel are one.
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

bool PointExtractorOptions::IsValid(std::string* error) const {
  if (num_points < 0) {
    *error = "points.num_points must not be negative";
  } else if (num_levels < 1) {
    *error = "points.num_levels must be at least 1";
  } else if (min_fast_threshold < 1 || fast_threshold > 255) {
    *error = "points: FAST thresholds must be in [1, 255]";
  } else if (min_fast_threshold > fast_threshold) {
    *error = "points.min_fast_threshold must not exceed points.fast_threshold";
  } else {
    return true;
  }
  return false;
}

PointExtractor::PointExtractor(const PointExtractorOptions& options) : options_(options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("PointExtractor: " + error);
  levels_.resize(options.num_levels);
  // Shares fall with the level's side length, as in ORB: q^l (1 - q) / (1 - q^levels).
  const double q = 1.0 / kPyramidScale;
  double share = options.num_points * (1.0 - q) / (1.0 - std::pow(q, options.num_levels));
  double scale = 1.0;
  int left = options.num_points;  // rounded shares may exceed the total
  for (Level& level : levels_) {
    level.num_points = std::min(cvRound(share), left);
    level.scale = scale;
    left -= level.num_points;
    share *= q;
    scale *= kPyramidScale;
  }
}

int PointExtractor::SetImage(const cv::Mat& gray) {
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("PointExtractor: the image must be 8-bit grey (CV_8UC1)");
  }
  levels_[0].image = gray;
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
  const std::vector<FastCorner> corners = DetectCorners(level.image, level.num_points, options_);
  // The binomial filter of five: a Gaussian of one pixel.
  cv::GaussianBlur(level.image, level.smooth, cv::Size(5, 5), /*sigmaX=*/0.0);
  const PointDescriptorExtractor descriptor_extractor(level.image, level.smooth);
  std::vector<PointFeature> points;
  for (const RefinedCorner& corner : RefineCorners(level.image, level.smooth, corners)) {
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
    const std::vector<PointFeature> of_level = ExtractLevel(l);
    points.insert(points.end(), of_level.begin(), of_level.end());
  }
  return points;
}

}  // namespace msc_vo
