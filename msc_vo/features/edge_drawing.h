// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <vector>

#include "msc_vo/features/image_gradient.h"

namespace msc_vo {

// Edge drawing (Topal and Akinlar 2012): anchors, pixels where the gradient is largest across the
// edge, are joined to chains of pixels by walking along the ridge of the gradient's magnitude, the
// strongest anchor first. Keeps its buffers between calls.
class EdgeDrawing {
 public:
  // A chain of neighbouring pixels, in order: indices [begin, end) of pixels().
  struct Chain {
    int begin = 0;
    int end = 0;
  };

  void Draw(const ImageGradient& gradient);

  // Pixels of all chains, as ImageGradient addresses them.
  const std::vector<int>& pixels() const { return pixels_; }
  const std::vector<Chain>& chains() const { return chains_; }

 private:
  enum class Mark : uint8_t { kFree, kBeside, kDrawn };

  void FindAnchors(const ImageGradient& gradient);
  void DrawThrough(const ImageGradient& gradient, int anchor);
  void Walk(const ImageGradient& gradient, int pixel, int dx, int dy);
  void Append(const ImageGradient& gradient, int pixel);

  std::vector<int> anchors_;  // strongest first
  std::vector<int> candidates_;
  std::vector<int> first_of_magnitude_;
  std::vector<Mark> marks_;
  std::vector<int> pixels_;
  std::vector<Chain> chains_;
};

}  // namespace msc_vo
