// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/edge_drawing.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "msc_vo/geometry/avx2.h"

namespace msc_vo {

namespace {

// Smallest gradient magnitude of an edge pixel: a step of 7 grey values, or three sigmas of sensor
// noise of 2 to 3 grey values after smoothing.
constexpr int kMinMagnitude = 20;
// Largest gradient magnitude: each component is at most 3 * 255.
constexpr int kMaxMagnitude = 2 * 3 * 255;
// Spacing of the rows (for edges along y) and columns (for edges along x) that are searched for
// anchors, pixels. The shortest useful line crosses several.
constexpr int kScanInterval = 4;
// Shortest chain that is kept, pixels.
constexpr int kMinChain = 10;

// Writes which pixels of a row are anchors: edge pixels with the largest magnitude across the edge,
// of two equal neighbours the first. Of edges along x, those in columns that `in_column` marks are
// wanted, of edges along y all if `in_row`. 16-bit arithmetic without branches and non-aliasing
// pointers let the compiler process many pixels at once.
MSC_VO_AVX2_IF_PRESENT
void MarkAnchors(const int16_t* __restrict above, const int16_t* __restrict here,
                 const int16_t* __restrict below, const int16_t* __restrict y, int width,
                 const int16_t* __restrict in_column, int16_t in_row,
                 int16_t* __restrict is_anchor) {
  for (int x = 1; x < width - 1; ++x) {
    const int16_t magnitude = here[x];
    const int16_t is_horizontal = 2 * std::abs(y[x]) >= magnitude;
    const int16_t across_y = (magnitude > above[x]) & (magnitude >= below[x]) & in_column[x];
    const int16_t across_x = (magnitude > here[x - 1]) & (magnitude >= here[x + 1]) & in_row;
    is_anchor[x] = (magnitude >= kMinMagnitude) & (is_horizontal ? across_y : across_x);
  }
}

// Returns the pixel of largest magnitude among the three ahead of `pixel`; the one straight ahead
// if they are equal.
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

void EdgeDrawing::FindAnchors(const ImageGradient& gradient) {
  const int width = gradient.width();
  unsorted_anchors_.clear();
  in_column_.assign(width, 0);
  for (int x = kScanInterval; x + 1 < width; x += kScanInterval) in_column_[x] = 1;
  is_anchor_.assign(width, 0);
  for (int y = 1; y + 1 < gradient.height(); ++y) {
    MarkAnchors(gradient.MagnitudesOf(y - 1), gradient.MagnitudesOf(y),
                gradient.MagnitudesOf(y + 1), gradient.YsOf(y), width, in_column_.data(),
                y % kScanInterval == 0, is_anchor_.data());
    const auto end = is_anchor_.end();
    for (auto x = is_anchor_.begin(); (x = std::find(x, end, 1)) != end; ++x) {
      unsorted_anchors_.push_back(y * width + static_cast<int>(x - is_anchor_.begin()));
    }
  }
  SortAnchors(gradient);
}

// Counting sort by decreasing magnitude, stable.
void EdgeDrawing::SortAnchors(const ImageGradient& gradient) {
  first_of_magnitude_.assign(kMaxMagnitude + 1, 0);
  for (const int pixel : unsorted_anchors_) {
    const int magnitude = gradient.Magnitude(pixel);
    if (magnitude > 0) ++first_of_magnitude_[magnitude - 1];
  }
  for (int m = kMaxMagnitude - 1; m >= 0; --m) {
    first_of_magnitude_[m] += first_of_magnitude_[m + 1];
  }
  anchors_.resize(unsorted_anchors_.size());
  for (const int pixel : unsorted_anchors_) {
    anchors_[first_of_magnitude_[gradient.Magnitude(pixel)]++] = pixel;
  }
}

void EdgeDrawing::DrawThrough(const ImageGradient& gradient, int anchor) {
  const int begin = static_cast<int>(pixels_.size());
  const bool is_horizontal = gradient.IsHorizontalEdge(anchor);
  const int dx = is_horizontal ? 1 : 0;
  const int dy = is_horizontal ? 0 : 1;
  Append(gradient, anchor);
  FollowRidge(gradient, anchor, -dx, -dy);
  std::reverse(pixels_.begin() + begin, pixels_.end());
  FollowRidge(gradient, anchor, dx, dy);
  const int end = static_cast<int>(pixels_.size());
  if (end - begin >= kMinChain) {
    chains_.push_back({begin, end});
  } else {
    pixels_.resize(begin);
  }
}

// Follows the edge to its end from `pixel`, which was reached by a step (dx, dy).
void EdgeDrawing::FollowRidge(const ImageGradient& gradient, int pixel, int dx, int dy) {
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
      // The edge has turned by a right angle.
      const int forward = StrongestAhead(gradient, pixel, along, across);
      const int backward = StrongestAhead(gradient, pixel, -along, across);
      next = gradient.Magnitude(forward) >= gradient.Magnitude(backward) ? forward : backward;
    }
    // The magnitude is zero on the border of the image, so the path stays inside.
    if (gradient.Magnitude(next) < kMinMagnitude || marks_[next] == Mark::kDrawn) return;
    const int step = next - pixel;
    dy = (step > 1) - (step < -1);
    dx = step - dy * width;
    Append(gradient, next);
    pixel = next;
  }
}

// Also marks the pixels beside the edge: they belong to its blur, and no other edge starts there.
void EdgeDrawing::Append(const ImageGradient& gradient, int pixel) {
  pixels_.push_back(pixel);
  marks_[pixel] = Mark::kDrawn;
  const int across = gradient.IsHorizontalEdge(pixel) ? gradient.width() : 1;
  for (const int beside : {pixel - across, pixel + across}) {
    if (marks_[beside] == Mark::kFree) marks_[beside] = Mark::kBeside;
  }
}

}  // namespace msc_vo
