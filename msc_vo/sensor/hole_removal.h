// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

/// Removes the background that an image of inverse depths shows through holes of the measurement:
/// pixels that have a nearer pixel of one surface on both sides, horizontally or vertically, within
/// a radius. Takes the image row by row and keeps only the rows within the radius.
class HoleRemoval {
 public:
  /// `radius`: pixels, at least 1.
  HoleRemoval(cv::Size size, int radius);

  /// Returns the row that is next, to be filled with inverse depths (1/metres; 0: none). It has
  /// room for kTile - 1 elements more.
  float* NextRow() { return Row(next_); }
  /// Takes the row that NextRow() returned.
  void AddRow();
  /// Returns depths (CV_32FC1, metres; 0: none) after the last row was added.
  cv::Mat TakeDepth();

  /// Width and height of the tiles that are tested together for a difference of depths, pixels.
  static constexpr int kTile = 4;

 private:
  int num_rows() const { return rows_.rows; }
  float* Row(int y) { return rows_.ptr<float>((y + num_rows()) % num_rows()) + border_; }
  float* Nearest(int tile_row) {
    return nearest_.ptr<float>((tile_row + nearest_.rows) % nearest_.rows) + reach_;
  }
  void ClearRows(int first, int last);
  // Sums up the tiles of a row of tiles whose last row was added.
  void AddTiles(int tile_row);
  void FinishTiles(int tile_row);
  void RemoveHoles(int y, int x);

  int radius_;
  int reach_;   // the radius in tiles, rounded up
  int border_;  // columns without depth on both sides of a row
  int next_ = 0;
  cv::Mat depth_;
  cv::Mat rows_;                              // inverse depths of the last rows
  std::vector<float> nearest_row_, far_row_;  // largest inverse depth and depth in the last rows
  cv::Mat nearest_;                           // largest inverse depth of the last tiles
  cv::Mat farthest_;                          // largest depth of the last tiles
  std::vector<float> around_;                 // largest inverse depth around every tile of a row
};

}  // namespace msc_vo
