// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/keyframe_structure.h"

#include <vector>

namespace msc_vo {

std::shared_ptr<const Frame> RefineStructure(const FrameStructureOptions& options,
                                             std::shared_ptr<const Frame> frame) {
  std::vector<StructureLine> fits;
  for (const LineFeature& line : frame->lines) {
    if (line.depth) fits.push_back({line.segment, *line.depth, line.sigma});
  }
  if (!RefineFrameStructure(options, frame->camera, &fits).usable) return frame;
  // A copy: tracking may still be at work with the frame.
  auto refined = std::make_shared<Frame>(*frame);
  auto fit = fits.begin();
  for (LineFeature& line : refined->lines) {
    if (line.depth) line.depth = (fit++)->depth;
  }
  return refined;
}

}  // namespace msc_vo
