// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Bags of ROS 2 in a build without the libraries for them.

#include <stdexcept>

#include "msc_vo/ros_bag/bag_formats.h"
#include "msc_vo/ros_bag/ros_fields.h"

namespace msc_vo {

namespace {

constexpr char kMissing[] =
    "msc_vo was built without bags of ROS 2; install libfastcdr-dev, libzstd-dev and liblz4-dev "
    "and "
    "build it again";

}  // namespace

std::unique_ptr<BagFile> OpenRos2Bag(const std::string& path) {
  throw std::runtime_error(path + ": " + kMissing);
}

std::unique_ptr<RosFields> OpenCdrFields(std::string_view /*message*/) {
  throw std::runtime_error(kMissing);
}

}  // namespace msc_vo
