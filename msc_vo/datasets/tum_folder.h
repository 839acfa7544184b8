// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

// Parts of a TUM-style folder, which several layouts share. All throw std::runtime_error naming
// file, line and fix.

// Pairs from an association file if there is one, else from rgb.txt and depth.txt by nearest time
// within 0.02 s. Stamps that are frame numbers are taken at kDefaultFrameRate.
void ReadTumEntries(const std::string& directory, SequenceIndex* index);

// groundtruth.txt, or *.gt.freiburg; none is no error. Frame numbers are taken as times as above.
void ReadTumGroundTruth(const std::string& directory, SequenceIndex* index);

// camera.txt; none is no error.
void ReadFolderCamera(const std::string& directory, SequenceIndex* index);

// The first *.gt.freiburg file of the folder; empty: there is none.
std::string FindFreiburgTruth(const std::string& directory);

}  // namespace msc_vo
