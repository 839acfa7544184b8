// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/bundle_adjustment/internal/window_terms.h"

namespace msc_vo {

/// Estimates a noise factor per landmark and a depth offset per line from the residuals of their
/// inlier observations at `state`, and writes them to *data.
///
/// The noise factor multiplies the sigmas of all observations of a landmark: image corners are
/// localised ten times better than leaves, and the outline of a round object is a different line
/// from every viewpoint. With whitened residuals r_i, n of them, and p parameters of the landmark,
///
///   noise^2 = (prior + sum r_i^2) / (prior + n - p),
///
/// the maximum-likelihood scale under a Student distribution of the residuals with `prior` degrees
/// of freedom. A robust loss on single residuals does not replace it: outlines are off by one or
/// two sigmas in every view.
///
/// The depth offset (WindowData::Line::depth_offset) is the mean depth error of a line over its
/// observations, with a prior of zero. It is common to all views because depth edges and intensity
/// edges are different edges.
void EstimateLandmarkNoise(const LandmarkNoiseOptions& options, const WindowIndex& index,
                           const WindowInlierMask& inlier_mask, const WindowState& state,
                           WindowData* data);

/// Multiplies the noise factors so that covariances contain the error of the factors themselves.
/// Residuals of a landmark with a common scale that is estimated from them are an m-dimensional
/// Student distribution with nu degrees of freedom (nu: the prior; m = n - p), whose information is
/// (nu + m) / (nu + m + 2) of that of a normal distribution with the given sigmas. For estimated
/// factors it is an approximation.
void AddNoiseUncertainty(const LandmarkNoiseOptions& options, const WindowIndex& index,
                         const WindowInlierMask& inlier_mask, const WindowState& state,
                         WindowData* data);

}  // namespace msc_vo
