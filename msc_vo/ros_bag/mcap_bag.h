// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include "msc_vo/ros_bag/bag_file.h"

namespace msc_vo {

/// Opens an MCAP file with messages of ROS 2 or ROS 1. `path` names it in messages, its contents
/// are read from `file`, which may be removed afterwards. Throws std::runtime_error, naming the
/// file, if it is damaged.
std::unique_ptr<BagFile> OpenMcapBag(const std::string& path, const std::string& file);

}  // namespace msc_vo
