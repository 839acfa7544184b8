// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/point_extractor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/features/corner_refinement.h"
#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

// Radius of the patch whose intensity centroid gives the orientation, pixels of the level (ORB).
constexpr int kPatchRadius = 15;
// No corner nearer than this to a level's border: ORB's tests reach 13 px along x and y, rotated
// 18.4 px.
constexpr int kBorder = 19;
// FAST looks at a circle of this radius.
constexpr int kFastRadius = 3;

struct Corner {
  cv::Point pixel;  // of the level
  float response = 0.0f;
};

bool Stronger(const Corner& a, const Corner& b) {
  return std::make_tuple(-a.response, a.pixel.y, a.pixel.x) <
         std::make_tuple(-b.response, b.pixel.y, b.pixel.x);
}

// FAST corners whose centres lie in `area`; one pixel more is looked at around it, so that a corner
// is a maximum of the response also across the border of the area.
void DetectFast(const cv::Mat& image, const cv::Rect& area, int threshold,
                std::vector<Corner>* corners) {
  const int margin = kFastRadius + 1;
  const cv::Rect window(area.x - margin, area.y - margin, area.width + 2 * margin,
                        area.height + 2 * margin);
  std::vector<cv::KeyPoint> found;
  cv::FAST(image(window), found, threshold, /*nonmaxSuppression=*/true);
  for (const cv::KeyPoint& keypoint : found) {
    const cv::Point pixel(static_cast<int>(keypoint.pt.x) + window.x,
                          static_cast<int>(keypoint.pt.y) + window.y);
    if (area.contains(pixel)) corners->push_back({pixel, keypoint.response});
  }
}

// The corners of one level, in square cells of about the size that gives each corner wanted its
// own.
class CellGrid {
 public:
  CellGrid(const cv::Rect& area, int num_wanted) : area_(area) {
    const double size = std::sqrt(static_cast<double>(area.area()) / std::max(1, num_wanted));
    columns_ = std::max(1, static_cast<int>(std::lround(area.width / size)));
    rows_ = std::max(1, static_cast<int>(std::lround(area.height / size)));
    counts_.resize(static_cast<size_t>(columns_) * rows_, 0);
  }

  void Add(const std::vector<Corner>& corners) {
    for (const Corner& corner : corners) ++counts_[CellOf(corner)];
    corners_.insert(corners_.end(), corners.begin(), corners.end());
  }

  // The empty cells, neighbours in a row as one area: each search also looks around its area.
  std::vector<cv::Rect> EmptyAreas() const {
    std::vector<cv::Rect> areas;
    for (int row = 0; row < rows_; ++row) {
      for (int column = 0; column < columns_; ++column) {
        if (counts_[row * columns_ + column] > 0) continue;
        const bool continues = column > 0 && counts_[row * columns_ + column - 1] == 0;
        const cv::Rect area = CellArea(row, column);
        if (continues) {
          areas.back() |= area;
        } else {
          areas.push_back(area);
        }
      }
    }
    return areas;
  }

  // The strongest corner of every cell, then the second of every cell, and so on, `num_wanted` in
  // all; within one round the stronger first.
  std::vector<Corner> Choose(int num_wanted) {
    const std::vector<int> begins = SortByCell();
    std::vector<Corner> chosen;
    for (int round = 0; static_cast<int>(chosen.size()) < num_wanted; ++round) {
      const size_t before = chosen.size();
      for (size_t cell = 0; cell < counts_.size(); ++cell) {
        if (round < counts_[cell]) chosen.push_back(corners_[begins[cell] + round]);
      }
      if (chosen.size() == before) break;
      std::sort(chosen.begin() + before, chosen.end(), Stronger);
    }
    if (static_cast<int>(chosen.size()) > num_wanted) chosen.resize(num_wanted);
    return chosen;
  }

 private:
  int CellOf(const Corner& corner) const {
    const int column = (corner.pixel.x - area_.x) * columns_ / area_.width;
    const int row = (corner.pixel.y - area_.y) * rows_ / area_.height;
    return row * columns_ + column;
  }

  // Puts the corners cell by cell, the strongest first in each, and returns where cells begin.
  std::vector<int> SortByCell() {
    std::vector<int> begins(counts_.size(), 0);
    std::partial_sum(counts_.begin(), counts_.end() - 1, begins.begin() + 1);
    std::vector<int> next = begins;
    std::vector<Corner> sorted(corners_.size());
    for (const Corner& corner : corners_) sorted[next[CellOf(corner)]++] = corner;
    for (size_t cell = 0; cell < counts_.size(); ++cell) {
      std::sort(sorted.begin() + begins[cell], sorted.begin() + next[cell], Stronger);
    }
    corners_ = std::move(sorted);
    return begins;
  }

  // First coordinates that CellOf() sends to this column and row, up to those of the next.
  cv::Rect CellArea(int row, int column) const {
    const auto first = [](int index, int extent, int count) {
      return (index * extent + count - 1) / count;
    };
    const int x0 = first(column, area_.width, columns_);
    const int y0 = first(row, area_.height, rows_);
    const int x1 = first(column + 1, area_.width, columns_);
    const int y1 = first(row + 1, area_.height, rows_);
    return {area_.x + x0, area_.y + y0, x1 - x0, y1 - y0};
  }

  cv::Rect area_;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<Corner> corners_;
  std::vector<int> counts_;  // of corners in each cell, row by row
};

cv::Rect DetectionArea(const cv::Mat& level) {
  return {kBorder, kBorder, level.cols - 2 * kBorder, level.rows - 2 * kBorder};
}

std::vector<Corner> DetectCorners(const cv::Mat& level, int num_wanted,
                                  const PointExtractorOptions& options) {
  const cv::Rect area = DetectionArea(level);
  CellGrid grid(area, num_wanted);
  std::vector<Corner> corners;
  DetectFast(level, area, options.fast_threshold, &corners);
  grid.Add(corners);
  corners.clear();
  for (const cv::Rect& empty : grid.EmptyAreas()) {
    DetectFast(level, empty, options.min_fast_threshold, &corners);
  }
  grid.Add(corners);
  return grid.Choose(num_wanted);
}

// Pixel of the full image from one of a level. Resizing keeps the image's outline, which is half a
// pixel outside the centre of the first pixel, and sizes are whole numbers.
Eigen::Vector2d ToFullImage(const Eigen::Vector2d& pixel, const cv::Size& level,
                            const cv::Size& image) {
  return {(pixel.x() + 0.5) * image.width / level.width - 0.5,
          (pixel.y() + 0.5) * image.height / level.height - 0.5};
}

// Half width of the circular patch in each of its rows.
std::array<int, kPatchRadius + 1> PatchHalfWidths() {
  std::array<int, kPatchRadius + 1> half_widths;
  for (int y = 0; y <= kPatchRadius; ++y) {
    half_widths[y] = static_cast<int>(std::lround(std::sqrt(kPatchRadius * kPatchRadius - y * y)));
  }
  return half_widths;
}

// Direction from the centre of a patch to its intensity centroid, radians.
double IntensityCentroidAngle(const cv::Mat& level, const cv::Point& center) {
  static const std::array<int, kPatchRadius + 1> half_widths = PatchHalfWidths();
  int moment_x = 0;
  int moment_y = 0;
  for (int y = -kPatchRadius; y <= kPatchRadius; ++y) {
    const int half = half_widths[std::abs(y)];
    const uint8_t* row = level.ptr<uint8_t>(center.y + y) + center.x;
    int sum = 0;
    for (int x = -half; x <= half; ++x) {
      sum += row[x];
      moment_x += x * row[x];
    }
    moment_y += y * sum;
  }
  return std::atan2(static_cast<double>(moment_y), static_cast<double>(moment_x));
}

// Where the corners of one level are, to sub-pixels; those that end at the same pixel are one.
std::vector<RefinedCorner> RefineCorners(const cv::Mat& level, const std::vector<Corner>& corners) {
  const CornerRefiner refiner(level, DetectionArea(level));
  cv::Mat taken = cv::Mat::zeros(level.size(), CV_8UC1);
  std::vector<RefinedCorner> refined;
  for (const Corner& corner : corners) {
    const RefinedCorner candidate = refiner.Refine(corner.pixel);
    uint8_t& is_taken = taken.at<uint8_t>(candidate.pixel);
    if (is_taken == 0) refined.push_back(candidate);
    is_taken = 1;
  }
  return refined;
}

// Points of one level, in its pixels, with orientation and descriptor. OpenCV may leave out and
// reorder key points; class_id tells whose descriptor a row is.
std::vector<PointFeature> DescribeCorners(const cv::Mat& level,
                                          const std::vector<RefinedCorner>& corners,
                                          cv::Feature2D* orb) {
  std::vector<cv::KeyPoint> keypoints;
  std::vector<double> angles;
  for (size_t i = 0; i < corners.size(); ++i) {
    angles.push_back(IntensityCentroidAngle(level, corners[i].pixel));
    const double degrees = RadiansToDegrees(angles[i]);
    keypoints.emplace_back(cv::Point2f(corners[i].pixel), 2.0f * kPatchRadius + 1.0f,
                           static_cast<float>(degrees < 0.0 ? degrees + 360.0 : degrees),
                           /*response=*/0.0f, /*octave=*/0, /*class_id=*/static_cast<int>(i));
  }
  cv::Mat descriptors;
  orb->compute(level, keypoints, descriptors);
  std::vector<PointFeature> points(keypoints.size());
  for (size_t i = 0; i < keypoints.size(); ++i) {
    const int corner = keypoints[i].class_id;
    points[i].pixel = corners[corner].position;
    points[i].angle = angles[corner];
    std::memcpy(points[i].descriptor.data(), descriptors.ptr(static_cast<int>(i)),
                points[i].descriptor.size());
  }
  return points;
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
    // One call of ORB per level, told that it is the only one: our pyramid is the only pyramid.
    level.orb = cv::ORB::create(/*nfeatures=*/1, /*scaleFactor=*/1.2f, /*nlevels=*/1,
                                /*edgeThreshold=*/kBorder);
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
    if (std::min(size.width, size.height) <= 2 * kBorder) return static_cast<int>(l);
    if (l == 0) continue;
    cv::resize(levels_[l - 1].image, levels_[l].image, size, 0.0, 0.0, cv::INTER_LINEAR);
  }
  return static_cast<int>(levels_.size());
}

std::vector<PointFeature> PointExtractor::ExtractLevel(int l) {
  const Level& level = levels_[l];
  std::vector<PointFeature> points = DescribeCorners(
      level.image,
      RefineCorners(level.image, DetectCorners(level.image, level.num_points, options_)),
      level.orb.get());
  for (PointFeature& point : points) {
    point.pixel = ToFullImage(point.pixel, level.image.size(), levels_[0].image.size());
    point.sigma = level.scale;
    point.level = l;
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
