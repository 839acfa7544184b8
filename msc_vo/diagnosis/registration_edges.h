// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

/// Whether depth edges lie on image edges better with the registration of `corrected` than with the
/// calibration of `decoder`, in 20 evenly spaced images, see EdgeComparison. Images that cannot be
/// read are left out. False if `corrected` is no valid calibration.
bool EdgesAgree(const RgbdDecoder& decoder, const Calibration& corrected);

}  // namespace msc_vo
