// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

/// Says what a file is that is given instead of the folder of a sequence, and what to do: "is a bag
/// of ROS 2; convert it ...". The first bytes of the file tell it, or else the ending of its name.
/// Empty if the kind of the file is unknown.
std::string DescribeFile(const std::string& path);

/// Tests whether a file is of a kind that may hold a sequence: a recording, a video, an archive.
bool IsSequenceFile(const std::string& path);

}  // namespace msc_vo
