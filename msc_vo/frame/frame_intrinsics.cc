// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/frame/frame_intrinsics.h"

namespace msc_vo {

namespace {

void RemoveDepths(Frame* frame) {
  ForEachFeatures(*frame, [](auto& features) {
    for (auto& feature : features) feature.RemoveDepth();
  });
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
  const auto move = [&](const Eigen::Vector2d& pixel, double* /*inverse_depth*/) {
    return MovePixel(from, *intrinsics, pixel);
  };
  ForEachFeatures(*moved, [&](auto& features) {
    for (auto& feature : features) feature.MovePixels(move);
  });
  moved->grid = FeatureGrid(moved->camera, moved->points);
  return moved;
}

}  // namespace msc_vo
