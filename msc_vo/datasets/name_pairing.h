// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Pairs colour and depth images by their names, see ReadImageNames(), and adds the pairs to the
/// entries: by time if both streams have times of one clock, or else by equal frame numbers, with
/// the times of one stream or frame number / kDefaultFrameRate. Images whose names hold neither are
/// paired by equal names or, without any, by their order, with a warning, and so are frame numbers
/// that differ by the same number in all pairs and have no number in common. Adds warnings for
/// images that are left out. Throws std::runtime_error that says what the names hold if that does
/// not determine the pairs.
void PairByName(const std::vector<std::string>& color_paths,
                const std::vector<std::string>& depth_paths, SequenceIndex* index);

}  // namespace msc_vo
