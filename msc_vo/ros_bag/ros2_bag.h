// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include "msc_vo/ros_bag/bag_file.h"

namespace msc_vo {

/// Opens an SQLite or MCAP file of ROS 2, which may be compressed as a whole with zstd, as may its
/// messages. A compressed file is unpacked to the folder of temporary files. Recordings of the
/// RealSense viewer are seen as sensor_msgs. Throws std::runtime_error, naming the file and the
/// fix, if it is damaged or msc_vo was built without the libraries for it.
std::unique_ptr<BagFile> OpenRos2Bag(const std::string& path);

}  // namespace msc_vo
