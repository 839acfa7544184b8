// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include "msc_vo/features/internal/image_gradient.h"

namespace msc_vo {

/// Edge drawing (Topal and Akinlar 2012): anchors, pixels with the largest gradient across an edge,
/// are connected to chains of pixels by following the ridge of the gradient magnitude, starting
/// with the strongest anchor. Keeps its buffers between calls.
class EdgeDrawing {
 public:
  /// A chain of neighbouring pixels, in order: indices [begin, end) of pixels().
  struct Chain {
    int begin = 0;
    int end = 0;
  };

  void Draw(const ImageGradient& gradient);

  /// Pixels of all chains, indexed as in ImageGradient.
  const std::vector<int>& pixels() const { return pixels_; }
  const std::vector<Chain>& chains() const { return chains_; }

 private:
  enum class Mark : uint8_t { kFree, kBeside, kDrawn };

  void FindAnchors(const ImageGradient& gradient);
  void SortAnchors(const ImageGradient& gradient);
  void DrawThrough(const ImageGradient& gradient, int anchor);
  void FollowRidge(const ImageGradient& gradient, int pixel, int dx, int dy);
  void Append(const ImageGradient& gradient, int pixel);

  std::vector<int> anchors_;  // strongest first
  std::vector<int> unsorted_anchors_;
  std::vector<int16_t> in_column_;       // 1 in the columns that are searched, else 0
  std::vector<int16_t> is_anchor_;       // of one row, 1 or 0
  std::vector<int> first_of_magnitude_;  // counting sort: next position in anchors_
  std::vector<Mark> marks_;
  std::vector<int> pixels_;
  std::vector<Chain> chains_;
};

}  // namespace msc_vo
