// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

namespace msc_vo {

// Every observation in front of its camera takes part at first; the others are counted.
WindowInlierMask AllInFront(const BundleAdjustmentOptions& options, const WindowIndex& index,
                            const WindowData& data, int* num_behind);

// Chi-square test, at `state`, of everything that takes part; what fails is counted in *summary.
void ClassifyAll(const BundleAdjustmentOptions& options, const WindowTerms& terms,
                 const WindowState& state, WindowInlierMask* inlier_mask,
                 BundleAdjustmentSummary* summary);

}  // namespace msc_vo
