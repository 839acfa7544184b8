// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

/// The input or result of a local bundle adjustment, with its options.
struct RecordedWindow {
  BundleAdjustmentOptions options;
  WindowData data;
};

/// Formats a window as text, one record per line (docs/window_file.md). Numbers are exact: solving
/// a window that was read gives the same bytes as solving the window that was written. Numbers that
/// are not finite are written as well, because a window may be recorded to find their cause.
std::string FormatWindow(const BundleAdjustmentOptions& options, const WindowData& data);

/// Writes the result of FormatWindow() to a file. Throws std::runtime_error, naming the file, if it
/// cannot be written.
void WriteWindow(const std::string& path, const BundleAdjustmentOptions& options,
                 const WindowData& data);

/// Reads a window file. Options that the file does not name keep their defaults. Ids and sigmas are
/// validated by LocalBundleAdjustment().
/// Throws std::runtime_error naming file, line and fix if the file is not a window file, is of a
/// newer version or truncated, or contains an unknown record, a wrong number of fields, an invalid
/// field, a number that is not finite, or an option or the camera twice.
RecordedWindow ReadWindow(const std::string& path);

}  // namespace msc_vo
