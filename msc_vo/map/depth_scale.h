// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

namespace msc_vo {

// How many times larger the errors of measured depths are than the sigmas that features come with.
struct DepthScale {
  double points = 1.0;
  double lines = 1.0;
};

}  // namespace msc_vo
