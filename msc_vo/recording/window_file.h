// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_data.h"

namespace msc_vo {

// A window with the options that it is solved with.
struct RecordedWindow {
  BundleAdjustmentOptions options;
  WindowData data;
};

// The window as text, one record per line (docs/window_file.md). Every number reads back to the
// same bits, so that solving what was read gives the same bytes as solving what was written.
// Writes what it is given, numbers that are not finite included: a window may be recorded because
// it is wrong.
std::string FormatWindow(const BundleAdjustmentOptions& options, const WindowData& data);

// Throws std::runtime_error naming the file if it cannot be written.
void WriteWindow(const std::string& path, const BundleAdjustmentOptions& options,
                 const WindowData& data);

// Throws std::runtime_error naming file, line and fix: no window file or one of a newer version, a
// record that is not known, has a wrong number of fields or a field that does not fit, a number
// that is not finite, an option or the camera twice, a file cut short. Options that the file does
// not name keep their defaults. What the records mean together (ids, sigmas) is checked by
// LocalBundleAdjustment.
RecordedWindow ReadWindow(const std::string& path);

}  // namespace msc_vo
