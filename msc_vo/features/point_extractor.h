// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

#include "msc_vo/frame/frame.h"

namespace msc_vo {

struct PointExtractorOptions {
  /// Largest number of points per image; distributed over the levels in inverse proportion to their
  /// scale.
  int num_points = 600;
  /// Levels of the image pyramid; those that become too small are omitted. With 8, points are
  /// matched over a ratio of distances of 1.2^8 = 4.3.
  int num_levels = 8;
  int fast_threshold = 20;     ///< grey values, of a FAST corner
  int min_fast_threshold = 7;  ///< grey values, in cells without a corner at fast_threshold
};

/// Extracts FAST corners from an image pyramid, evenly distributed over the image, with orientation
/// and descriptor. Keeps its buffers between calls; not thread-safe except for ExtractLevel().
class PointExtractor {
 public:
  /// The options must be valid (OdometryOptions::IsValid).
  explicit PointExtractor(const PointExtractorOptions& options);

  /// Returns the points of an 8-bit grey image, without depth, in pixels of that image. Sigma is
  /// the scale of the point's level (1 on level 0). Ordered by level, within a level by selection.
  /// Throws std::invalid_argument if the image is not CV_8UC1.
  std::vector<PointFeature> Extract(const cv::Mat& gray);

  /// Builds the pyramid and returns its number of levels, for ExtractLevel(). `distance_to_mask`,
  /// of the size of the image or empty, see DistanceToMask(): no point is extracted whose
  /// descriptor would see the mask. Throws as Extract().
  int SetImage(const cv::Mat& gray, const cv::Mat& distance_to_mask = cv::Mat());
  /// Extracts the points of one level. Different levels may be extracted in any order and
  /// concurrently.
  std::vector<PointFeature> ExtractLevel(int level);

 private:
  struct Level {
    cv::Mat image;
    cv::Mat smooth;
    int num_points = 0;  // upper limit
    double scale = 1.0;
  };

  // Whether the descriptor of a pixel of a level sees no pixel that is left out.
  bool IsFarFromMask(const Level& level, const cv::Point& pixel) const;

  PointExtractorOptions options_;
  std::vector<Level> levels_;
  cv::Mat distance_to_mask_;
};

}  // namespace msc_vo
