// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace msc_vo {

/// Ways in which a colour image may be mirrored with respect to its depth image.
enum class Mirroring { kNone, kHorizontal, kVertical, kBoth };
constexpr int kNumMirrorings = 4;

constexpr int kNumFarSides = 4;

/// Agreement of depth edges with image gradients as a function of the shift between the two: the
/// mean gradient at the depth edges of the shifted image, in standard deviations of the gradients
/// above their mean. A depth edge is between the pixels of the nearer and the farther surface.
struct EdgeScore {
  /// Pixels of the full image per step of the score.
  double step = 1.0;
  /// Largest shift in steps; the score is square with 2 * reach + 1 values on each side.
  int reach = 0;
  /// CV_64FC1, sums over the edges whose farther surface is to the right, to the left, below, and
  /// above; row: dy + reach, column: dx + reach. A peak at (dx, dy) says that the depth edge at p
  /// belongs to the image edge at p + (dx, dy).
  std::array<cv::Mat, kNumFarSides> by_side;
  int num_edges = 0;  ///< pixels with a depth edge

  /// Sum over all edges if the depth images show near surfaces wider by `widening` steps on each
  /// side: stereo matchers with large windows do.
  cv::Mat Sum(int widening = 0) const;
};

/// Scores of an image; those of several images add up.
struct EdgeAlignment {
  EdgeScore coarse;  ///< at 320 pixels in width, for large shifts
  EdgeScore fine;    ///< at 640 pixels in width, for the place of the peak; may be empty
  /// CV_8UC2: depth edges along rows and along columns in each cell of 4 x 4 pixels at 320 pixels
  /// in width; of several images the maximum. See NumDistinctEdges().
  cv::Mat cells;
  double depth_delay = 0.0;  ///< of a single image: RgbdImage::depth_delay, seconds
  /// Best coarse score within two steps of no shift for each Mirroring of the colour image; sum
  /// over the edges.
  std::array<double, kNumMirrorings> mirrored_score = {};
};

/// Peak of the scores.
struct EdgeShift {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();  ///< pixels of the full image
  double peak = 0.0;                                ///< mean coarse score at the peak
  double background = 0.0;                          ///< median mean coarse score over all shifts
  /// Pixels by which the depth images show near surfaces wider on each side at the peak.
  double widening = 0.0;
  /// Mean coarse score without a shift, the largest of widenings near that one; at least 0.
  double at_zero = 0.0;
};

/// Compares the edges of a depth image (metres, 0: none) with those of a grey image of the same
/// size. `with_fine`: also computes the fine score, which takes most of the time of large images.
EdgeAlignment AlignEdges(const cv::Mat& gray, const cv::Mat& depth, bool with_fine = true);

/// A score at shifts that are larger by `steps`: that of the depth image moved by as much.
cv::Mat MovedScore(const cv::Mat& score, const Eigen::Vector2d& steps);

/// Adds scores of the same size; an empty sum takes the size of the first.
void Add(const EdgeAlignment& image, EdgeAlignment* sum);

/// Number of depth edge pixels at different places of the image. A camera at rest repeats its
/// edges, which count once.
int NumDistinctEdges(const EdgeAlignment& alignment);

/// Peak of the coarse score, with the widening of up to 8 pixels of 640 that makes it highest.
/// Without a widening, the shift is that of the fine score's peak beside it; it stays that of the
/// coarse score if the fine one does not reach as far, has less than half of the edges, or has no
/// peak there. To a fraction of a step. Zero if there are no edges.
EdgeShift FindPeak(const EdgeAlignment& alignment);

}  // namespace msc_vo
