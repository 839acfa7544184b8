// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "msc_vo/geometry/pose_covariance.h"

namespace msc_vo {

/// Names of the columns with the six standard deviations of a pose covariance: `prefix`, then
/// sigma_rx_deg to sigma_tz.
std::vector<std::string> SigmaColumns(const std::string& prefix);
/// Names of those with its 15 correlations, by rows of the upper triangle: `prefix`, then rho_rx_ry
/// to rho_ty_tz.
std::vector<std::string> CorrelationColumns(const std::string& prefix);

/// The values of these columns in a row, each after a comma: degrees and metres. All are 0 if there
/// is no covariance.
std::string FormatSigmas(const std::optional<PoseCovariance>& covariance);
std::string FormatCorrelations(const std::optional<PoseCovariance>& covariance);

}  // namespace msc_vo
