// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// OpenBag() of a build without the library rosbag_storage.

#include <stdexcept>

#include "msc_vo/ros_bag/bag_sequence.h"

namespace msc_vo {

bool HasRosBag() { return false; }

SequenceIndex OpenBag(const std::string& path, const BagTopics& /*topics*/) {
  throw std::runtime_error(path +
                           ": this msc_vo was built without support for ROS bags; install the "
                           "Debian package librosbag-storage-dev and build it again");
}

}  // namespace msc_vo
