// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/image_size_fit.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

bool IsOfSize(const PinholeCamera& camera, const ImageSize& size) {
  return camera.width == size.width && camera.height == size.height;
}

ImageSize ReducedTo(int max_width, const ImageSize& size) {
  if (size.width <= max_width) return size;
  const double height = static_cast<double>(size.height) * max_width / size.width;
  return {max_width, static_cast<int>(std::lround(height))};
}

// A depth camera at the place of the colour camera, with its lens.
DepthCamera CameraAtSameView(const PinholeCamera& camera, const LensDistortion& lens) {
  DepthCamera depth_camera;
  depth_camera.camera = camera;
  depth_camera.distortion = lens;
  depth_camera.distortion.recorded.reset();
  return depth_camera;
}

}  // namespace

bool HaveSameShape(const ImageSize& a, const ImageSize& b) {
  const double height = static_cast<double>(a.height) * b.width / a.width;
  return std::abs(height - b.height) <= 1.0;
}

bool HaveSimilarShape(const ImageSize& a, const ImageSize& b) {
  constexpr double kMaxDeviation = 0.01;
  const double height = static_cast<double>(a.height) * b.width / a.width;
  return std::abs(height - b.height) <= std::max(1.0, kMaxDeviation * b.height);
}

PinholeCamera ScaledCamera(const PinholeCamera& camera, const ImageSize& size) {
  const double sx = static_cast<double>(size.width) / camera.width;
  const double sy = static_cast<double>(size.height) / camera.height;
  return {
      sx * camera.fx, sy * camera.fy, sx * (camera.cx + 0.5) - 0.5, sy * (camera.cy + 0.5) - 0.5,
      size.width,     size.height};
}

void FitToImageSizes(const ImageSize& color, const ImageSize& depth, std::optional<int> max_width,
                     SequenceIndex* index, Calibration* calibration) {
  const PinholeCamera recorded = calibration->Recorded();
  const bool is_known_size =
      IsOfSize(recorded, color) || (!calibration->depth_camera && IsOfSize(recorded, depth));
  const bool differ = color.width != depth.width || color.height != depth.height;
  const int default_width = differ || calibration->depth_camera ? kDefaultMaxWidth : color.width;
  const ImageSize reduced = ReducedTo(max_width.value_or(default_width), color);
  const bool is_reduced = reduced.width < color.width;
  if (!is_known_size || (!differ && !is_reduced)) return;
  if (!calibration->depth_camera) {
    if (!HaveSameShape(color, depth)) return;
    calibration->depth_camera =
        CameraAtSameView(ScaledCamera(recorded, depth), calibration->distortion);
    if (differ && !index->is_same_view) {
      index->warnings.push_back(
          FormatText("depth images of %dx%d are taken for the view of the colour images of %dx%d; "
                     "describe the "
                     "depth camera if they are not registered to colour",
                     depth.width, depth.height, color.width, color.height));
    }
  }
  calibration->SetRecorded(ScaledCamera(recorded, reduced));
  if (!is_reduced) return;
  index->scale_color = true;
  index->reduced_from = color;
  index->warnings.push_back(
      FormatText("colour images of %dx%d are reduced to %dx%d; camera.max_width sets another width",
                 color.width, color.height, reduced.width, reduced.height));
}

Calibration StoredCalibration(const Calibration& calibration,
                              const std::optional<ImageSize>& stored_size) {
  Calibration stored = calibration;
  if (stored_size) {
    stored.SetRecorded(ScaledCamera(calibration.Recorded(), *stored_size));
    stored.SetUndistorted();
  }
  return stored;
}

}  // namespace msc_vo
