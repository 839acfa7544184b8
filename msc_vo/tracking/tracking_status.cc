// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/tracking/tracking_status.h"

namespace msc_vo {

const char* ToString(TrackingStatus status) {
  switch (status) {
    case TrackingStatus::kTracked:
      return "tracked";
    case TrackingStatus::kWeak:
      return "weak";
    case TrackingStatus::kPredicted:
      return "predicted";
    case TrackingStatus::kLost:
      return "lost";
    case TrackingStatus::kDropped:
      return "dropped";
    case TrackingStatus::kUnreadable:
      return "unreadable";
  }
  return "unknown";
}

bool IsEstimated(TrackingStatus status) {
  return status == TrackingStatus::kTracked || status == TrackingStatus::kWeak;
}

bool HasImage(TrackingStatus status) {
  return status != TrackingStatus::kDropped && status != TrackingStatus::kUnreadable;
}

}  // namespace msc_vo
