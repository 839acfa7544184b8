// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/hole_removal.h"

#include <algorithm>
#include <vector>

#include "msc_vo/sensor/registration_geometry.h"

namespace msc_vo {

namespace {

// Whether a surface on both sides is in front of a pixel.
bool IsBehind(float side, float other, float inverse_depth) {
  const float near = std::max(side, other);
  const float far = std::min(side, other);
  return (near - far <= EdgeThreshold(near)) & (far > inverse_depth + EdgeThreshold(inverse_depth));
}

int RoundUp(int value, int step) { return (value + step - 1) / step * step; }

// Largest of four values each.
void ReduceTiles(const std::vector<float>& row, float* tiles) {
  const float* const from = row.data();
  const int size = static_cast<int>(row.size()) / HoleRemoval::kTile;
#pragma GCC ivdep
  for (int i = 0; i < size; ++i) {
    tiles[i] = std::max(std::max(from[4 * i], from[4 * i + 1]),
                        std::max(from[4 * i + 2], from[4 * i + 3]));
  }
}

}  // namespace

HoleRemoval::HoleRemoval(cv::Size size, int radius)
    : radius_(radius),
      reach_((radius + kTile - 1) / kTile),
      border_(reach_ * kTile),
      depth_(size, CV_32FC1),
      rows_(cv::Mat::zeros((2 * reach_ + 1) * kTile, RoundUp(size.width, kTile) + 2 * border_,
                           CV_32FC1)),
      nearest_row_(RoundUp(size.width, kTile), 0.0f),
      far_row_(RoundUp(size.width, kTile), 0.0f),
      nearest_(cv::Mat::zeros(2 * reach_ + 1, RoundUp(size.width, kTile) / kTile + 2 * reach_,
                              CV_32FC1)),
      farthest_(cv::Mat::zeros(2 * reach_ + 1, RoundUp(size.width, kTile) / kTile, CV_32FC1)),
      around_(RoundUp(size.width, kTile) / kTile) {}

void HoleRemoval::AddRow() {
  const int size = depth_.cols;
  const float* const row = Row(next_);
  float* const depth = depth_.ptr<float>(next_);
  float* const nearest = nearest_row_.data();
  float* const farthest = far_row_.data();
#pragma GCC ivdep
  for (int x = 0; x < size; ++x) {
    const float w = row[x];
    const float z = w > 0.0f ? 1.0f / w : 0.0f;
    depth[x] = z;
    nearest[x] = std::max(nearest[x], w);
    farthest[x] = std::max(farthest[x], z);
  }
  ++next_;
  if (next_ == depth_.rows) ClearRows(next_, RoundUp(next_, kTile));
  if (next_ % kTile == 0 || next_ == depth_.rows) AddTiles((next_ - 1) / kTile);
}

void HoleRemoval::AddTiles(int tile_row) {
  ReduceTiles(nearest_row_, Nearest(tile_row));
  ReduceTiles(far_row_, farthest_.ptr<float>(tile_row % farthest_.rows));
  std::fill(nearest_row_.begin(), nearest_row_.end(), 0.0f);
  std::fill(far_row_.begin(), far_row_.end(), 0.0f);
  if (tile_row >= reach_) FinishTiles(tile_row - reach_);
}

void HoleRemoval::FinishTiles(int tile_row) {
  const int size = static_cast<int>(around_.size());
  float* const around = around_.data();
  std::fill(around_.begin(), around_.end(), 0.0f);
  for (int k = -reach_; k <= reach_; ++k) {
    const float* const row = Nearest(tile_row);
    const float* const other = Nearest(tile_row + k);
#pragma GCC ivdep
    for (int i = 0; i < size; ++i) around[i] = std::max(around[i], std::max(row[i + k], other[i]));
  }
  const float* const farthest = farthest_.ptr<float>(tile_row % farthest_.rows);
  const int last = std::min((tile_row + 1) * kTile, depth_.rows);
  for (int i = 0; i < size; ++i) {
    const float inverse_depth = 1.0f / farthest[i];
    if (around[i] <= inverse_depth + EdgeThreshold(inverse_depth)) continue;
    for (int y = tile_row * kTile; y < last; ++y) RemoveHoles(y, i * kTile);
  }
}

void HoleRemoval::RemoveHoles(int y, int x) {
  float left[kTile] = {}, right[kTile] = {}, above[kTile] = {}, below[kTile] = {};
  const float* const row = Row(y) + x;
  // Largest inverse depth on every side within the radius.
  for (int k = 1; k <= radius_; ++k) {
    const float* const up = Row(y - k) + x;
    const float* const down = Row(y + k) + x;
    for (int i = 0; i < kTile; ++i) {
      left[i] = std::max(left[i], row[i - k]);
      right[i] = std::max(right[i], row[i + k]);
      above[i] = std::max(above[i], up[i]);
      below[i] = std::max(below[i], down[i]);
    }
  }
  float* const depth = depth_.ptr<float>(y) + x;
  const int size = std::min(kTile, depth_.cols - x);
  for (int i = 0; i < size; ++i) {
    const bool is_hidden =
        IsBehind(left[i], right[i], row[i]) | IsBehind(above[i], below[i], row[i]);
    if (is_hidden) depth[i] = 0.0f;
  }
}

void HoleRemoval::ClearRows(int first, int last) {
  for (int y = first; y < last; ++y) std::fill(Row(y), Row(y) + depth_.cols, 0.0f);
}

cv::Mat HoleRemoval::TakeDepth() {
  // Tiles below the image have no depth.
  const int num_tiles = (depth_.rows + kTile - 1) / kTile;
  for (int i = num_tiles; i < num_tiles + reach_; ++i) {
    ClearRows(i * kTile, (i + 1) * kTile);
    AddTiles(i);
  }
  return depth_;
}

}  // namespace msc_vo
