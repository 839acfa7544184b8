// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/localizer.h"

#include <stdexcept>
#include <utility>

#include "msc_vo/odometry/localization.h"

namespace msc_vo {

Localizer::Localizer(const OdometryOptions& options, const PinholeCamera& camera,
                     const LensDistortion& distortion, MapContents map)
    : odometry_(options, camera, distortion), num_worlds_(static_cast<int>(map.submaps.size())) {
  if (map.submaps.empty()) throw std::invalid_argument("localizer: the map has no keyframes");
  odometry_.SetMap(std::move(map));
}

FrameResult Localizer::Process(const RgbdImage& image) {
  return KeepLocalizedPose(num_worlds_, odometry_.Process(image));
}

OdometryResult Localizer::Finish() { return odometry_.Finish(/*only_localized=*/true); }

}  // namespace msc_vo
