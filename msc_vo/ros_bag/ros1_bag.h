// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include "msc_vo/ros_bag/bag_file.h"

namespace msc_vo {

/// Opens a bag of ROS 1. Throws std::runtime_error, naming the file and the fix, if it is damaged
/// or msc_vo was built without rosbag_storage.
std::unique_ptr<BagFile> OpenRos1Bag(const std::string& path);

}  // namespace msc_vo
