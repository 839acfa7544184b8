// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Determines the calibration of a sequence. Sources in order of precedence: the values of
/// `settings`, the preset named by `settings`, a file of the folder, the preset named by `preset`,
/// the preset guessed from the folder. If all intrinsics and the depth scale are set, `settings` is
/// the only source. A missing image size is taken from the first image, and the calibration is
/// fitted to the sizes of the images, see FitToImageSizes(). A guessed preset provides no readout
/// time, because the name of a folder does not identify the shutter. Adds warnings for the user to
/// `index->warnings`, among them `index->camera_warnings` about cameras that `settings` does not
/// give. Throws std::runtime_error, listing the alternatives, if the calibration is
/// incomplete; std::invalid_argument on an unknown preset.
Calibration ResolveCalibration(const CameraSettings& settings, const std::string& preset,
                               SequenceIndex* index);

enum class ImageKind { kColor, kDepth };

/// Returns the size of the images of a kind, from the first one that can be read; damaged ones
/// before it are left to the run. Throws std::runtime_error, naming the first image, if none of the
/// first ten can be read.
ImageSize FirstImageSize(const SequenceIndex& index, ImageKind kind);

}  // namespace msc_vo
