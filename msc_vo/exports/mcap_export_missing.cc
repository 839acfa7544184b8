// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <stdexcept>

#include "msc_vo/exports/mcap_export.h"

namespace msc_vo {

void RequireMcapExport() {
  throw std::runtime_error(
      "mcap: this msc_vo was built without bags of ROS 2; install libfastcdr-dev, libzstd-dev and "
      "liblz4-dev, and build it again");
}

void ExportMcap(const McapRun& /*run*/, const std::string& /*path*/) { RequireMcapExport(); }

}  // namespace msc_vo
