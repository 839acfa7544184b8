// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Largest difference of the stamps of colour and depth image in a pair: the default of the TUM
/// RGB-D tools, less than the 33 ms between two frames.
constexpr double kMaxPairDifference = 0.02;  // seconds

/// Pairs colour and depth images by time, see AssociateStamps(), and adds the pairs to the entries,
/// with the stamp of the colour image. Stamps are in seconds, both lists in order of time, and
/// `max_difference` in seconds. Adds a warning for images without a partner.
void PairByTime(const ImageLists& images, double max_difference, SequenceIndex* index);

/// Pairs the images at the same position of both lists, whose stamps are in seconds, and adds the
/// pairs to the entries in their order.
void PairByRow(const ImageLists& images, SequenceIndex* index);

/// Pairs colour and depth images with the same frame number, see FrameNumber(), and adds the pairs
/// to the entries with the time frame number / kDefaultFrameRate. Adds a warning for images without
/// a partner.
void PairByFrameNumber(const std::vector<std::string>& color_paths,
                       const std::vector<std::string>& depth_paths, SequenceIndex* index);

}  // namespace msc_vo
