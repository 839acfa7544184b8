// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

/// Returns the rigid transform target_from_source (no scale) that minimises
/// sum |target_i - target_from_source * source_i|^2 (Umeyama 1991). Points in metres.
/// Throws std::invalid_argument if the sizes differ or there are fewer than three pairs.
Rigid3 AlignRigid(const std::vector<Eigen::Vector3d>& source,
                  const std::vector<Eigen::Vector3d>& target);

/// Returns the scale s > 0 of the similarity s R p + t that minimises the same sum (Umeyama 1991),
/// whose R and t are AlignRigid() of the scaled source points. Throws std::invalid_argument as
/// AlignRigid() does, and if the source points coincide.
double AlignmentScale(const std::vector<Eigen::Vector3d>& source,
                      const std::vector<Eigen::Vector3d>& target);

/// Returns the transform target_from_source between two world frames from poses given in both: its
/// rotation R minimises sum |R_target,i - R R_source,i|^2 (Frobenius norm), its translation aligns
/// the mean positions. Throws std::invalid_argument if the sizes differ or there is no pair.
Rigid3 AlignPoses(const std::vector<Rigid3>& source, const std::vector<Rigid3>& target);

}  // namespace msc_vo
