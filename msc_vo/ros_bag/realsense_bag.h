// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>

#include "msc_vo/ros_bag/bag_file.h"

namespace msc_vo {

/// Tests whether a bag of ROS 2 is a recording of the RealSense viewer (version 2.57 of its library
/// and later), whose messages are none of ROS: bare pixels, and values as text.
bool IsRealSenseBag(const BagFile& bag);

/// Shows such a bag with messages of ROS: Image, CameraInfo, Transform and Float32.
std::unique_ptr<BagFile> TranslateRealSenseBag(std::unique_ptr<BagFile> bag);

}  // namespace msc_vo
