// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/image_files/image_file.h"

namespace msc_vo {

/// Colour images that are wider are reduced to this width unless a configuration gives another one:
/// twice the width of 640 pixels to which lengths in pixels refer (camera/image_scale.h).
constexpr int kDefaultMaxWidth = 1280;

/// Returns the camera of an image that is scaled to another size. Pixel centres are at integer
/// coordinates, so the coordinate plus one half is scaled.
PinholeCamera ScaledCamera(const PinholeCamera& camera, const ImageSize& size);

/// Fits a calibration to colour and depth images of these sizes; it is that of the recorded images,
/// SetUndistorted() must follow.
///
/// - Depth images of another size than the colour images, but of the same shape, without a depth
///   camera: they show the same view, as those of a telephone do. They get a depth camera with the
///   scaled intrinsics, so that they are sampled at the pixels that they have. The calibration may
///   be that of either size.
/// - Colour images wider than `max_width`: they are reduced to it.
///
/// Both add a sentence to `index->warnings`.
void FitToImageSizes(const ImageSize& color, const ImageSize& depth, int max_width,
                     SequenceIndex* index, Calibration* calibration);

}  // namespace msc_vo
