// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Finds the values at which the depth images of a sequence are clipped, see ClippedDepthFinder,
/// from a sample of images that is spread over the sequence. Images that cannot be
/// read are left out.
ClippedDepth FindClippedDepth(const SequenceIndex& index);

/// One end at which depth is clipped.
struct ClippingReport {
  double depth = 0.0;  ///< metres
  std::string text;    ///< for the user, a sentence
};

/// Returns a report for each end at which depth is clipped. `depth_scale`: raw units per metre.
std::vector<ClippingReport> DescribeClippedDepth(const ClippedDepth& clipped, double depth_scale);

}  // namespace msc_vo
