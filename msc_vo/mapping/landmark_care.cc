// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_care.h"

#include "msc_vo/mapping/landmark_creation.h"

namespace msc_vo {

void LandmarkCare::Renew(KeyframeId newest, Map* map) {
  CullLandmarks(culling_, newest, &probation_, map);
  CreatePoints(newest, &probation_, map);
  CreateLines(newest, &probation_, map);
}

void LandmarkCare::Fuse(KeyframeId newest, Map* map) const {
  FusePoints(fusion_, newest, map);
  FuseLines(fusion_, newest, map);
}

}  // namespace msc_vo
