// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/tracking_status.h"

#include "msc_vo/text/enum_names.h"

namespace msc_vo {

const char* ToString(TrackingStatus status) {
  return EnumName<TrackingStatus::kUnreadable>(
      status, {"tracked", "weak", "predicted", "lost", "dropped", "unreadable"});
}

bool IsEstimated(TrackingStatus status) {
  return status == TrackingStatus::kTracked || status == TrackingStatus::kWeak;
}

bool HasImage(TrackingStatus status) {
  return status != TrackingStatus::kDropped && status != TrackingStatus::kUnreadable;
}

}  // namespace msc_vo
