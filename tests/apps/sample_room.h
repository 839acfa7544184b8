// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

namespace msc_vo {

// The folder of the sample sequence.
inline const std::string kRoom = MSC_VO_DATA_FOLDER "/room";

}  // namespace msc_vo
