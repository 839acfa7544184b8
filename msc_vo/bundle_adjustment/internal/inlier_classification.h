// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

namespace msc_vo {

/// Inlier mask before the first solve: all observations in front of their camera, all pairs and
/// alignments. Adds the number of the other observations to *num_behind.
WindowInlierMask InitialInlierMask(const BundleAdjustmentOptions& options, const WindowIndex& index,
                                   const WindowData& data, int* num_behind);

/// The same without the measurements and the depths that the data mark as rejected: the inliers of
/// a solved window.
WindowInlierMask UnrejectedInlierMask(const BundleAdjustmentOptions& options,
                                      const WindowIndex& index, const WindowData& data);

/// Removes the measurements that fail the chi-square test at `state` from *inlier_mask, and adds
/// their numbers to the num_rejected counts of *summary.
void RejectOutliers(const BundleAdjustmentOptions& options, const WindowTerms& terms,
                    const WindowState& state, WindowInlierMask* inlier_mask,
                    BundleAdjustmentSummary* summary);

}  // namespace msc_vo
