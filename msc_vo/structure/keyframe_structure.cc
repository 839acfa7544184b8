// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/keyframe_structure.h"

#include <vector>

namespace msc_vo {

std::shared_ptr<const Frame> RefineStructure(const FrameStructureOptions& options,
                                             const NoiseScale& scale, bool keep_covariance,
                                             std::shared_ptr<const Frame> frame) {
  const double variance_scale = scale.line_depth * scale.line_depth;
  std::vector<StructureLine> fits;
  for (const LineFeature& line : frame->lines) {
    if (!line.depth) continue;
    fits.push_back({line.segment, *line.depth, scale.line_pixel * line.sigma});
    fits.back().depth.covariance *= variance_scale;
  }
  if (!RefineFrameStructure(options, frame->camera, &fits).usable) return frame;
  // A copy, because tracking may still use the frame.
  auto refined = std::make_shared<Frame>(*frame);
  auto fit = fits.begin();
  for (LineFeature& line : refined->lines) {
    if (!line.depth) continue;
    const Eigen::Matrix2d covariance =
        keep_covariance ? line.depth->covariance : fit->depth.covariance / variance_scale;
    line.depth = (fit++)->depth;
    line.depth->covariance = covariance;
  }
  return refined;
}

}  // namespace msc_vo
