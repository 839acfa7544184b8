// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "msc_vo/camera/pinhole_camera.h"
#include "msc_vo/evaluation/trajectory_error.h"
#include "msc_vo/report/report_statistics.h"

namespace msc_vo {

/// Keeps the order of insertion.
using Json = nlohmann::ordered_json;

/// The value, or null if `count` is not positive, that is, without samples.
Json ValueOrNull(double count, double value);

/// Intrinsics and size.
Json CameraToJson(const PinholeCamera& camera);

/// Errors of a trajectory in metres and degrees.
Json ToJson(const TrajectoryError& error);

Json ToJson(const StageTimeStatistics& stage);

/// Text of a JSON file, indented by two spaces. Invalid UTF-8, for instance in paths, is replaced.
std::string FormatJson(const Json& json);

}  // namespace msc_vo
