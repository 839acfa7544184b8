// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/datasets/image_list.h"
#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Largest difference of the stamps of colour and depth image in a pair, seconds, if the camera
/// with the higher rate takes an image every `interval` seconds: half of that interval, within
/// which every image of the other camera has a partner, and a tenth of it for jitter. It is at
/// least 20 ms, the default of the TUM RGB-D tools, and at most 0.15 s, because the camera motion
/// is not known well enough to move depth over longer times.
double MaxPairDifference(double interval);

/// The same for images whose stamps are in seconds.
double MaxPairDifference(const ImageLists& images);

/// Pairs colour and depth images by time, see AssociateStamps(), and adds the pairs to the entries,
/// with the stamp of the colour image. Stamps are in seconds, both lists in order of time, and
/// `max_difference` in seconds. Adds warnings for images without a partner and for stamps of
/// different clocks; their advice is for lists, or, if the index has a container, for that.
void PairByTime(const ImageLists& images, double max_difference, SequenceIndex* index);

/// Pairs the images at the same position of both lists, whose stamps are in seconds, and adds the
/// pairs to the entries in their order. If the stamps of at least a quarter of the pairs differ by
/// no more than MaxPairDifference(), they are of one clock: pairs whose delay is farther than that
/// from the median of these are left out, with a warning. Otherwise they are of different clocks,
/// on which all or few stamps agree by chance: all pairs are added, without a delay, and a warning
/// if some of the stamps agree or all differ by the same time.
void PairByRow(const ImageLists& images, SequenceIndex* index);

}  // namespace msc_vo
