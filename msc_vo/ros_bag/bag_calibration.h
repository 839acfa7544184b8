// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/datasets/sequence.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/ros_bag/camera_infos.h"
#include "msc_vo/ros_bag/topic_choice.h"

namespace msc_vo {

/// Returns the calibration of the images of two topics; none if the bag does not have it.
///
/// The colour camera is that of its CameraInfo, or else, with a warning unless depth is registered,
/// that of the depth images. Depth that neither the name of its topic nor its coordinate frame says
/// is registered has a depth camera with its own CameraInfo. The place of it is in the transforms
/// of a RealSense camera or of tf; there is a warning if it is not known, in which case the depth
/// camera is taken for one at the place of the colour camera.
std::optional<Calibration> ReadCalibration(const BagFile& bag, const CameraInfos& infos,
                                           const TopicPair& topics, CameraWarnings* warnings);

}  // namespace msc_vo
