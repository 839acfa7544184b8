// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <stdexcept>

#include "msc_vo/ros_bag/bag_formats.h"

namespace msc_vo {

std::unique_ptr<BagFile> OpenRos1Bag(const std::string& path) {
  throw std::runtime_error(
      path +
      ": msc_vo was built without bags of ROS 1; install librosbag-storage-dev and build it "
      "again");
}

}  // namespace msc_vo
