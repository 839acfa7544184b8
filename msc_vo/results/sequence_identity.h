// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// What distinguishes a sequence from others with the same name.
struct SequenceIdentity {
  std::string path;    ///< absolute, without symbolic links; or the name of a live camera
  std::string stamps;  ///< checksum of the time stamps
  std::string images;  ///< checksum of the names and sizes of the image files

  /// Whether it is the same sequence: in the same place, or moved to another one.
  bool IsSame(const SequenceIdentity& other) const;
};

SequenceIdentity IdentifySequence(const SequenceIndex& index);
/// The path only, which does not need the sequence to be opened.
SequenceIdentity IdentifySequence(const std::string& directory);

/// Writes sequence.json, which says of which sequence the results in `directory` are.
void WriteIdentity(const std::string& directory, const SequenceIdentity& sequence);

/// The sequence whose results are in a folder; none if there are no results or they do not say it.
std::optional<SequenceIdentity> ReadIdentity(const std::string& directory);

/// Throws std::runtime_error that names the other sequence if `directory` holds results of one, or
/// that names one of the files `names` if there is one, but neither sequence.json nor summary.json,
/// so that it is no result of a run.
void RefuseToOverwriteOthers(const std::string& directory, const SequenceIdentity& sequence,
                             const std::vector<std::string>& names);

}  // namespace msc_vo
