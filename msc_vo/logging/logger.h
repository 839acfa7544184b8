// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <spdlog/logger.h>

namespace msc_vo {

/// The logger of the library, named "msc_vo". It is silent (level off, null sink) until the program
/// that embeds the library configures it, before the first image is processed:
///
///   msc_vo::Log().sinks() = {std::make_shared<spdlog::sinks::stderr_color_sink_mt>()};
///   msc_vo::Log().set_level(spdlog::level::info);
///
/// Levels: debug for events of single frames (keyframes), info for those of a run (camera,
/// Manhattan axes, self-calibration, files), warn for weak or lost frames and rejected input, err
/// for failures. Sinks must be thread-safe (_mt). Logging does not change results.
spdlog::logger& Log();

}  // namespace msc_vo
