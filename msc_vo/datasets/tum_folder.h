// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

// Parts of a TUM-style folder, which several layouts share. All throw std::runtime_error naming
// file, line and fix.

// What stamps that are all whole numbers mean in a layout.
enum class WholeStamps {
  kTimes,
  kFrameNumbers,  // time = number / kDefaultFrameRate
};

// Pairs from an association file if there is one, else from rgb.txt and depth.txt by nearest time
// within 0.02 s. Times in milliseconds, microseconds or nanoseconds become seconds, with a warning.
void ReadTumEntries(const std::string& directory, WholeStamps whole, SequenceIndex* index);

// groundtruth.txt, or *.gt.freiburg, after the images; none is no error. Stamps as above.
void ReadTumGroundTruth(const std::string& directory, WholeStamps whole, SequenceIndex* index);

// camera.txt; none is no error.
void ReadFolderCamera(const std::string& directory, SequenceIndex* index);

// The first *.gt.freiburg file of the folder; empty: there is none.
std::string FindFreiburgTruth(const std::string& directory);

}  // namespace msc_vo
