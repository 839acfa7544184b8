// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>

#include "msc_vo/ros_bag/bag_file.h"

namespace msc_vo {

// The formats of bags, each implemented in a file of its own.

/// Opens a bag of ROS 1. Throws std::runtime_error, naming the file and the fix, if it is damaged
/// or msc_vo was built without rosbag_storage.
std::unique_ptr<BagFile> OpenRos1Bag(const std::string& path);

/// Opens an SQLite or MCAP file of ROS 2, which may be compressed as a whole with zstd, as may its
/// messages. A compressed file is unpacked to the folder of temporary files. Recordings of the
/// RealSense viewer are seen as sensor_msgs. Throws std::runtime_error, naming the file and the
/// fix, if it is damaged or msc_vo was built without the libraries for it.
std::unique_ptr<BagFile> OpenRos2Bag(const std::string& path);

/// Opens the folder of a bag of ROS 2: the files that its metadata.yaml lists, one after the other,
/// or all of its files .db3 and .mcap in the order of their names and numbers if it has none.
/// Empty files among others are left out, with a warning.
/// Throws std::runtime_error, naming the file and the fix, if a file is missing or cannot be read.
std::unique_ptr<BagFile> OpenBagFolder(const std::string& folder);

/// Opens an MCAP file with messages of ROS 2 or ROS 1. `path` names it in messages, its contents
/// are read from `file`, which may be removed afterwards. Throws std::runtime_error, naming the
/// file, if it is damaged.
std::unique_ptr<BagFile> OpenMcapBag(const std::string& path, const std::string& file);

/// Opens an SQLite file of ROS 2, read-only. `path` names it in messages, its contents are read
/// from `file`, which may be removed afterwards. Throws std::runtime_error, naming the file, if it
/// has not the tables of such a file or is damaged.
std::unique_ptr<BagFile> OpenDb3Bag(const std::string& path, const std::string& file);

/// Tests whether a bag of ROS 2 is a recording of the RealSense viewer (version 2.57 of its library
/// and later), whose messages are none of ROS: bare pixels, and values as text.
bool IsRealSenseBag(const BagFile& bag);

/// Shows such a bag with messages of ROS: Image, CameraInfo, Transform and Float32.
std::unique_ptr<BagFile> TranslateRealSenseBag(std::unique_ptr<BagFile> bag);

}  // namespace msc_vo
