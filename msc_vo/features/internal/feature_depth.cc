// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/internal/feature_depth.h"

#include "msc_vo/features/internal/depth_sampler.h"

namespace msc_vo {

void MeasureDepth(const DepthSource& depth, const Eigen::Vector2d& raw_pixel, PointFeature* point) {
  point->inverse_depth = 0.0;
  point->inverse_depth_sigma = 0.0;
  const auto sample = SampleDepth(depth.image(), raw_pixel, depth.model().noise);
  if (!sample) return;
  point->inverse_depth = sample->inverse_depth;
  point->inverse_depth_sigma = depth.model().SigmaPerNoise(sample->inverse_depth) * sample->sigma;
}

void MeasureDepth(const FrameBuilderOptions& options, const DepthSource& depth,
                  const LensRemap& lens, std::vector<LineFeature>* lines) {
  const DepthNoise& noise = depth.model().noise;
  uint32_t seed = 0;
  for (LineFeature& line : *lines) {
    line.depth = options.line_depth == LineDepthMethod::kRobustFit
                     ? FitDepthAlongLine(depth.image(), lens, line.segment, noise, seed)
                     : EndPointDepth(depth.image(), lens, line.segment, noise);
    if (line.depth) {
      const double ratio = depth.model().SigmaPerNoise(line.depth->At(0.5));
      line.depth->covariance *= ratio * ratio;
    }
    ++seed;
  }
}

}  // namespace msc_vo
