// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

namespace msc_vo {

// Landmarks are not alike: the printed corner is found to a tenth of the pixel that a leaf is found
// to, and the outline of something round is another line from every side. So every landmark has a
// noise of its own, by which the sigmas of all its observations are multiplied. Residuals r_i of a
// landmark, in the sigmas of its observations, then have Student's distribution, and the noise that
// makes them most likely is
//
//   noise^2 = (prior + sum r_i^2) / (prior + n - p),   n residuals, p parameters of the landmark.
//
// A loss on single residuals does not do this: an outline is off by one or two sigmas, but always.
//
// Likewise the depths of a line have an offset of its own, WindowData::Line::depth_offset: a mean
// over many views removes their noise, but not that edges of depth and of colour are different
// edges.
//
// Learns both for all points and lines in *data from the observations that are active, at `state`.
void LearnLandmarkNoise(const LandmarkNoiseOptions& options, const WindowIndex& index,
                        const WindowInlierMask& inlier_mask, const WindowState& state,
                        WindowData* data);

}  // namespace msc_vo
