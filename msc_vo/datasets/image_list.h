// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

// TUM's own limit for pairing colour and depth: less than the 33 ms between two frames.
constexpr double kMaxPairDifference = 0.02;  // seconds

// A row of rgb.txt or depth.txt, or half a row of an association file.
struct ListedImage {
  double stamp = 0.0;  // as it stands there
  std::string path;
  std::string origin;  // "rgb.txt:12"
};

// Colour and depth images, the i-th of the one list with the i-th of the other.
struct Associations {
  std::vector<ListedImage> color;
  std::vector<ListedImage> depth;
};

// Reads "time path" rows; the paths are relative to the folder of the list.
// Throws std::runtime_error naming file and line if a row is anything else.
std::vector<ListedImage> ReadImageList(const std::string& path);

// Pairs images whose stamps differ by at most `max_difference` seconds, one to one: the closest
// pairs first, of equals the earlier. Both lists are in order of time. Entries carry the stamp of
// the colour image. Images without a partner are left out, with a warning.
void PairByTime(const std::vector<ListedImage>& color, const std::vector<ListedImage>& depth,
                double max_difference, SequenceIndex* index);

// Reads "time path time path" rows, colour and depth in either order. Which is which follows from
// the folder names, or else from the bit depth of the first pair.
// Throws std::runtime_error naming file, line and fix if a row is anything else.
Associations ReadAssociations(const std::string& path);

// Adds the pairs, whose stamps are seconds, in their order.
void AddPairs(const Associations& pairs, SequenceIndex* index);

// The first file of the folder that is called as association files are; empty: there is none.
std::string FindAssociations(const std::string& directory);

// Whether all stamps are whole numbers in steps of at most 60, as frame numbers are.
bool AreFrameNumbers(const std::vector<double>& stamps);

}  // namespace msc_vo
