// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "apps/cli/run_export.h"
#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// The name of an image in the model of COLMAP: its path in the folder of the sequence.
std::string ColmapImageName(const SequenceIndex& index, const SequenceEntry& entry);

/// Text at the beginning of graphs of g2o, see OutputKind.
inline constexpr char kG2oMark[] = "VERTEX_SE3:QUAT";

/// Throws std::runtime_error if an export of a map would replace the map or a file that is no
/// earlier export, or if colmap would write into the folder of a sequence. Files of the binary form
/// of colmap have no mark, so that they are replaced with --overwrite only.
void CheckMapExport(const RunExport& arguments);

/// Writes colmap or g2o of a map file. Throws std::runtime_error, naming the file and the fix.
void WriteMapExport(const RunExport& arguments);

}  // namespace msc_vo
