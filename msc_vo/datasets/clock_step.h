// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "msc_vo/datasets/image_list.h"

namespace msc_vo {

/// Returns the position of the first image, in the order of the list, at which the clock was set
/// back: a list that ascends otherwise goes back there into a time that it has passed, so that
/// sorting it would interleave two passages. None if the list ascends, has fewer than ten images,
/// or is not in order anyway, and where sorting does no harm: for lists that were joined in the
/// wrong order, displaced images, and rows that are repeated.
std::optional<size_t> FindClockStep(const std::vector<ListedImage>& images);

}  // namespace msc_vo
