// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/edge_drawing.h"

#include <algorithm>
#include <array>

namespace msc_vo {

namespace {

// Smallest magnitude of a pixel of an edge: a step of 7 grey values, or three sigmas of a camera's
// noise of 2 to 3 grey values after smoothing.
constexpr int kMinMagnitude = 20;
// Largest: both components at most 3 * 255.
constexpr int kMaxMagnitude = 2 * 3 * 255;
// Anchors are looked for in every so many rows (edges along y) and columns (edges along x): the
// shortest line of use passes several.
constexpr int kScanInterval = 4;
// Shorter chains hold no line.
constexpr int kMinChain = 10;

bool IsAnchor(const ImageGradient& gradient, int pixel, int across) {
  const int magnitude = gradient.Magnitude(pixel);
  // Of two equal neighbours the first one.
  return magnitude >= kMinMagnitude && magnitude > gradient.Magnitude(pixel - across) &&
         magnitude >= gradient.Magnitude(pixel + across);
}

// Of the three pixels ahead of `pixel` the one of the largest magnitude, straight on if equal.
int StrongestAhead(const ImageGradient& gradient, int pixel, int along, int across) {
  int best = pixel + along;
  for (const int candidate : {pixel + along - across, pixel + along + across}) {
    if (gradient.Magnitude(candidate) > gradient.Magnitude(best)) best = candidate;
  }
  return best;
}

}  // namespace

void EdgeDrawing::Draw(const ImageGradient& gradient) {
  const size_t num_pixels = static_cast<size_t>(gradient.width()) * gradient.height();
  marks_.assign(num_pixels, Mark::kFree);
  pixels_.clear();
  chains_.clear();
  FindAnchors(gradient);
  for (const int anchor : anchors_) {
    if (marks_[anchor] == Mark::kFree) DrawThrough(gradient, anchor);
  }
}

// Counting sort by magnitude; of equal ones the first pixel comes first.
void EdgeDrawing::FindAnchors(const ImageGradient& gradient) {
  const int width = gradient.width();
  candidates_.clear();
  for (int y = 1; y + 1 < gradient.height(); ++y) {
    const int row = y * width;
    const bool scan_row = y % kScanInterval == 0;
    for (int x = scan_row ? 1 : kScanInterval; x + 1 < width; x += scan_row ? 1 : kScanInterval) {
      const int pixel = row + x;
      if (gradient.Magnitude(pixel) < kMinMagnitude) continue;
      const bool is_horizontal = gradient.IsHorizontalEdge(pixel);
      const bool scanned = is_horizontal ? x % kScanInterval == 0 : scan_row;
      if (scanned && IsAnchor(gradient, pixel, is_horizontal ? width : 1)) {
        candidates_.push_back(pixel);
      }
    }
  }
  first_of_magnitude_.assign(kMaxMagnitude + 1, 0);
  for (const int pixel : candidates_) {
    const int magnitude = gradient.Magnitude(pixel);
    if (magnitude > 0) ++first_of_magnitude_[magnitude - 1];
  }
  for (int m = kMaxMagnitude - 1; m >= 0; --m) {
    first_of_magnitude_[m] += first_of_magnitude_[m + 1];
  }
  anchors_.resize(candidates_.size());
  for (const int pixel : candidates_) {
    anchors_[first_of_magnitude_[gradient.Magnitude(pixel)]++] = pixel;
  }
}

void EdgeDrawing::DrawThrough(const ImageGradient& gradient, int anchor) {
  const int begin = static_cast<int>(pixels_.size());
  const bool is_horizontal = gradient.IsHorizontalEdge(anchor);
  const int dx = is_horizontal ? 1 : 0;
  const int dy = is_horizontal ? 0 : 1;
  Append(gradient, anchor);
  Walk(gradient, anchor, -dx, -dy);
  std::reverse(pixels_.begin() + begin, pixels_.end());
  Walk(gradient, anchor, dx, dy);
  const int end = static_cast<int>(pixels_.size());
  if (end - begin >= kMinChain) {
    chains_.push_back({begin, end});
  } else {
    pixels_.resize(begin);
  }
}

// From `pixel`, reached by a step (dx, dy), as far as the edge goes.
void EdgeDrawing::Walk(const ImageGradient& gradient, int pixel, int dx, int dy) {
  const int width = gradient.width();
  for (;;) {
    const bool is_horizontal = gradient.IsHorizontalEdge(pixel);
    const int along = is_horizontal ? 1 : width;
    const int across = is_horizontal ? width : 1;
    const int sense = is_horizontal ? dx : dy;
    int next = 0;
    if (sense != 0) {
      next = StrongestAhead(gradient, pixel, sense * along, across);
    } else {
      // The edge turns by a right angle.
      const int forward = StrongestAhead(gradient, pixel, along, across);
      const int backward = StrongestAhead(gradient, pixel, -along, across);
      next = gradient.Magnitude(forward) >= gradient.Magnitude(backward) ? forward : backward;
    }
    // The image's border has no magnitude, so that no step leads out of it.
    if (gradient.Magnitude(next) < kMinMagnitude || marks_[next] == Mark::kDrawn) return;
    const int step = next - pixel;
    dy = (step > 1) - (step < -1);
    dx = step - dy * width;
    Append(gradient, next);
    pixel = next;
  }
}

// Pixels beside an edge are part of its blur: no edge starts there.
void EdgeDrawing::Append(const ImageGradient& gradient, int pixel) {
  pixels_.push_back(pixel);
  marks_[pixel] = Mark::kDrawn;
  const int across = gradient.IsHorizontalEdge(pixel) ? gradient.width() : 1;
  for (const int beside : {pixel - across, pixel + across}) {
    if (marks_[beside] == Mark::kFree) marks_[beside] = Mark::kBeside;
  }
}

}  // namespace msc_vo
