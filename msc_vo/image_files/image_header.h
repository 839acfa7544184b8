// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/image_files/image_file.h"

namespace msc_vo {

/// Returns the size that the header of an image file gives, without decoding the image. None if the
/// file is damaged before the size or is not a PNG, JPEG, BMP, TIFF, EXR, WebP, PBM, PGM or PPM
/// file.
std::optional<ImageSize> SizeInHeader(const std::string& bytes);

/// Tests whether a file is a TIFF with one channel of unsigned numbers of 32 bits or floating-point
/// numbers of 16 bits, which OpenCV does not read.
bool IsTiffOfOtherNumbers(const std::string& bytes);

/// Tests whether a file is a JPEG without its end, the marker FF D9, which the compressed data
/// cannot contain. Decoders fill the missing part with grey.
bool IsTruncatedJpeg(const std::string& bytes);

/// Tests whether an image of this size may be decoded from so many bytes. A few bytes can claim a
/// size whose pixels fill the memory; no image of a camera is compressed that far.
bool IsPlausibleSize(const ImageSize& size, size_t num_bytes);

}  // namespace msc_vo
