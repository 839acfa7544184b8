// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

// Readers for the files of a TUM-style folder, which several layouts share. All throw
// std::runtime_error naming file, line and fix.

/// Meaning of stamps that are all whole numbers.
enum class WholeStamps {
  kTimes,
  kFrameNumbers,  ///< time = number / kDefaultFrameRate
};

/// Reads the image pairs from an association file if there is one, and otherwise pairs rgb.txt and
/// depth.txt by time, see PairByTime(). Converts stamps in milliseconds, microseconds or
/// nanoseconds to seconds, with a warning.
void ReadTumEntries(const std::string& directory, WholeStamps whole, SequenceIndex* index);

/// Prefix of the first comment in the reference.txt of a folder; SequenceIndex::reference follows.
inline constexpr char kReferenceComment[] = "poses of ";

/// Reads groundtruth.txt, *.gt.freiburg or reference.txt if one exists; converts stamps like
/// ReadTumEntries(), which must be called first.
void ReadTumGroundTruth(const std::string& directory, WholeStamps whole, SequenceIndex* index);

/// Reads a trajectory as ground truth. The entries must be known: their time range determines the
/// unit of the stamps, unless a header names it. Poses without stamps are those of the images in
/// order, see AssignPosesInOrder(). Adds a warning if the file holds no poses.
void ReadGroundTruthFile(const std::string& path, WholeStamps whole, SequenceIndex* index);

/// Returns the path of the first *.gt.freiburg file of the folder; empty if there is none.
std::string FindFreiburgTruth(const std::string& directory);

}  // namespace msc_vo
