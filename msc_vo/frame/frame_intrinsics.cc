// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/frame_intrinsics.h"

namespace msc_vo {

namespace {

void RemoveDepths(Frame* frame) {
  for (PointFeature& point : frame->points) {
    point.inverse_depth = 0.0;
    point.inverse_depth_sigma = 0.0;
  }
  for (LineFeature& line : frame->lines) line.depth.reset();
  frame->depth_ranges = {};
}

}  // namespace

std::shared_ptr<const Frame> ChangeIntrinsics(
    std::shared_ptr<const Frame> frame, const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  if (!intrinsics || !frame->intrinsics || frame->intrinsics == intrinsics) return frame;
  const CameraIntrinsics& from = *frame->intrinsics;
  const auto moved = std::make_shared<Frame>(*frame);
  moved->intrinsics = intrinsics;
  moved->camera = intrinsics->camera;
  if (moved->lens) moved->lens = intrinsics->distortion;
  if (intrinsics->registration && !from.registration) RemoveDepths(&*moved);
  if (from.distortion.IsZero() && intrinsics->distortion.IsZero()) return moved;
  const auto move = [&](const Eigen::Vector2d& pixel) {
    return MovePixel(from, *intrinsics, pixel);
  };
  for (PointFeature& point : moved->points) point.pixel = move(point.pixel);
  for (LineFeature& line : moved->lines) {
    line.segment.start = move(line.segment.start);
    line.segment.end = move(line.segment.end);
  }
  moved->grid = FeatureGrid(moved->camera, moved->points);
  return moved;
}

}  // namespace msc_vo
