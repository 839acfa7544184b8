// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/diagnosis/edge_alignment.h"
#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

/// Shift of the depth images against the colour images, and mirrored images, from the edges of
/// several images. `width` is that of the images, pixels.
void AddRegistrationFindings(const std::vector<EdgeAlignment>& images, int width,
                             Findings* findings);

}  // namespace msc_vo
