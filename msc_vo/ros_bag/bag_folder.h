// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include "msc_vo/ros_bag/bag_file.h"

namespace msc_vo {

/// Opens the folder of a bag of ROS 2: the files that its metadata.yaml lists, one after the other,
/// or all of its files .db3 and .mcap in the order of their names and numbers if it has none.
/// Throws std::runtime_error, naming the file and the fix, if a file is missing or cannot be read.
std::unique_ptr<BagFile> OpenBagFolder(const std::string& folder);

}  // namespace msc_vo
