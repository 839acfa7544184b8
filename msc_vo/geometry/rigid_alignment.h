// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// The rigid transform (rotation and translation, no scale) that minimises
// sum |target_i - target_from_source * source_i|^2 (Umeyama 1991).
// Throws std::invalid_argument if the sizes differ or there are fewer than three pairs.
Rigid3 AlignRigid(const std::vector<Eigen::Vector3d>& source,
                  const std::vector<Eigen::Vector3d>& target);

}  // namespace msc_vo
