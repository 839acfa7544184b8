// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <string>

namespace msc_vo {

/// Replaces the earlier export in `folder`, if there is one, by that which `write` writes into the
/// folder that it is given. The list export.json names the files of an export: only they are
/// replaced or removed. The new files are complete before the first one is moved to its place, so
/// that the earlier export stays if they cannot be written. Throws std::runtime_error if one of
/// them has the name of a file that is not in the list, if `input` is in the list, or as
/// UnfinishedFolder.
void ReplaceExport(const std::string& folder, const std::string& input,
                   const std::function<void(const std::string&)>& write);

}  // namespace msc_vo
