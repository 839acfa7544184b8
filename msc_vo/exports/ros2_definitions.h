// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/exports/mcap_writer.h"

namespace msc_vo {

/// The schema of a type of message, by its name in ROS 1: "nav_msgs/Odometry". The definition is
/// that of ROS 2 Humble and later without its comments, followed by those of all types in it.
/// Throws std::out_of_range for a type that is not exported.
McapSchema Ros2Schema(const std::string& type);

}  // namespace msc_vo
