// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_care.h"

#include "msc_vo/mapping/landmark_creation.h"

namespace msc_vo {

void LandmarkCare::Renew(KeyframeId newest, Map* map) {
  CullLandmarks(culling_, newest, &probation_, map);
  CreateLandmarks(newest, &probation_, map);
}

}  // namespace msc_vo
