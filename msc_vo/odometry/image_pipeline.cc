// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/image_pipeline.h"

#include <algorithm>
#include <utility>

#include "msc_vo/odometry/input_checks.h"
#include "msc_vo/sensor/image_mask.h"
#include "msc_vo/sensor/standalone_image.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

constexpr int kMaxThreads = 10;  // as many as FrameBuilder has tasks

}  // namespace

ImagePipeline::ImagePipeline(const OdometryOptions& options, const PinholeCamera& camera,
                             const LensDistortion& distortion)
    : options_(options),
      builder_(options.features, camera, distortion),
      preparation_(builder_.intrinsics()),
      normals_(std::in_place, NormalOptions(options), camera, distortion),
      side_workers_(std::min(options.threads, kMaxThreads) - 1) {}

void ImagePipeline::Check(const RgbdImage& image) const {
  CheckDepthDelay(image.id, image.depth_delay);
  builder_.Check(image);
  CheckRecordedDepth(image.id, image.recorded_depth);
  CheckDepthUnits(image.id, image.depth);
}

AlignedImage ImagePipeline::Align(const RgbdImage& given,
                                  const std::optional<CameraVelocity>& velocity) {
  AlignedImage image;
  Timed(&image.milliseconds, [&] {
    image.recorded = StandaloneImages(given);
    RemoveMaskedDepth(&image.recorded);
    if (finds_clipped_depth_) image.recorded = preparation_.RemoveClipped(image.recorded);
    if (!options_.align_depth) image.recorded.depth_delay = 0.0;
    image.aligned = preparation_.Align(image.recorded, velocity);
  });
  return image;
}

ExtractedFrame ImagePipeline::Extract(const AlignedImage& image, StageTimes* times) {
  const TaskRunner run = [this](const Tasks& tasks) { side_workers_.RunAll(tasks); };
  times->features = image.milliseconds;
  RgbdImage registered =
      Timed(&times->features, [&] { return preparation_.Register(image.aligned); });
  RemoveMaskedDepth(&registered);  // which alignment and registration move
  times->depth = times->features;
  const auto frame = Timed(
      &times->features, [&] { return std::make_shared<Frame>(builder_.Build(registered, run)); });
  times->depth += builder_.times().depth;
  times->points = builder_.times().points;
  times->lines = builder_.times().lines;
  if (!options_.use_points) {
    frame->points.clear();
    frame->grid = FeatureGrid(frame->camera, frame->points);
  }
  if (!options_.use_lines) frame->lines.clear();
  return {std::move(registered), frame};
}

std::vector<AxisEvidence> ImagePipeline::Normals(const RgbdImage& image) {
  std::vector<AxisEvidence> evidence;
  for (const SurfaceNormal& normal : normals_->Estimate(image.depth)) {
    evidence.push_back({normal.direction, normal.sigma});
  }
  return evidence;
}

bool ImagePipeline::UseIntrinsics(const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  if (!intrinsics || intrinsics == builder_.intrinsics()) return false;
  builder_.SetIntrinsics(intrinsics);
  preparation_.SetIntrinsics(*intrinsics);
  normals_.emplace(NormalOptions(options_), intrinsics->camera, intrinsics->distortion);
  return true;
}

}  // namespace msc_vo
