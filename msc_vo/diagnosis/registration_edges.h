// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/sensor/depth_edges.h"

namespace msc_vo {

/// Adds images of `decoder` (indices) to the comparison, with its registration of depth and with
/// that of `corrected`, a valid calibration. Images that cannot be read are left out.
void CompareEdges(const RgbdDecoder& decoder, const std::vector<int>& images,
                  const Calibration& corrected, EdgeComparison* comparison);

/// Whether depth edges lie on image edges better with the registration of `corrected` than with the
/// calibration of `decoder`, in 20 evenly spaced images, see CompareEdges(). False if `corrected`
/// is no valid calibration.
bool EdgesAgree(const RgbdDecoder& decoder, const Calibration& corrected);

}  // namespace msc_vo
