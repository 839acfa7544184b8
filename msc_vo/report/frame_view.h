// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace msc_vo {

/// Color of a tracked line, as in the figures of the paper: red, green, blue by the Manhattan axis
/// that its landmark is parallel to, yellow without axis, orange if the image has no depth for it.
enum class LineColor : uint8_t { kAxis0, kAxis1, kAxis2, kWithoutAxis, kWithoutDepth };

/// A point feature that was matched with the map.
struct ViewedPoint {
  Eigen::Vector2f pixel = Eigen::Vector2f::Zero();  ///< in the recorded image
  bool has_depth = true;
};

/// A line feature that was matched with the map.
struct ViewedLine {
  Eigen::Vector2f start = Eigen::Vector2f::Zero();  ///< pixel in the recorded image
  Eigen::Vector2f end = Eigen::Vector2f::Zero();
  LineColor color = LineColor::kWithoutAxis;
};

/// The tracked features of a frame.
struct ViewedFeatures {
  std::vector<ViewedPoint> points;
  std::vector<ViewedLine> lines;
};

/// What a frame looks like: a reduced image and the features that were tracked in it.
struct FrameView {
  int frame = 0;     ///< index into ReportData::frames
  std::string jpeg;  ///< bytes of a JPEG file
  ViewedFeatures features;
};

/// The place where a run was found in the map of earlier runs, as the run and the map show it.
struct PlaceView {
  int frame = 0;              ///< index into ReportData::frames
  std::string jpeg;           ///< bytes of a JPEG file, of the frame
  int64_t keyframe = 0;       ///< id in the map
  std::string keyframe_jpeg;  ///< bytes of a JPEG file
};

/// Bytes that a view takes in memory and, before base64, in the page.
inline size_t NumBytes(const FrameView& view) {
  return view.jpeg.size() + 5 * view.features.points.size() + 9 * view.features.lines.size();
}

}  // namespace msc_vo
