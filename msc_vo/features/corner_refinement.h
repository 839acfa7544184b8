// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>

namespace msc_vo {

struct RefinedCorner {
  cv::Point pixel;           // of the corner response's maximum
  Eigen::Vector2d position;  // of the maximum between pixels
};

// Moves a FAST corner to the maximum of the corner response det(M) / trace(M) nearby, M the moments
// of the gradient in a 5x5 window (Harris' response without his constant), and on to sub-pixels by
// the vertex of the quadratic through the 3x3 responses around it. At most three pixels uphill and
// not out of `area`; where there is no maximum the corner stays.
//
// Why uphill: FAST answers a pixel or two inside a corner, and at another place in the next image.
// Measured on rendered sequences, between frames: 0.35 px without, 0.25 px with the quadratic
// alone, 0.12 px with both (standard deviation per coordinate, in pixels of the level).
RefinedCorner RefineCorner(const cv::Mat& gray, const cv::Rect& area, const cv::Point& corner);

}  // namespace msc_vo
