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

// The transform of a pair of worlds from poses that are given in both: its rotation R minimises
// sum |target_i.R - R source_i.R|^2 over the rotation matrices, its translation brings the mean
// positions together. Throws std::invalid_argument if the sizes differ or there is no pair.
Rigid3 AlignPoses(const std::vector<Rigid3>& source, const std::vector<Rigid3>& target);

}  // namespace msc_vo
