// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/sequence.h"
#include "msc_vo/phone_recordings/depth_confidence.h"
#include "msc_vo/phone_recordings/video_reader.h"

namespace msc_vo {

/// How recordings of telephones, and of videos with depth images, are read.
struct PhoneOptions {
  DepthConfidence least_confidence = DepthConfidence::kMedium;  ///< of depths that are used
  MakeVideoReader make_video_reader;  ///< may be empty: recordings with a video are refused
};

/// OpenSequence() for all layouts: those of data sets, and those of the applications that record
/// RGB-D images on telephones. Throws as OpenSequence() does.
SequenceIndex OpenFolder(const std::string& directory, const std::string& format,
                         const PhoneOptions& options);

/// Returns the names that OpenFolder() accepts as `format`, except "auto".
std::vector<std::string> FolderFormatNames();

}  // namespace msc_vo
