// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/ros_bag/topic_choice.h"

namespace msc_vo {

/// The CameraInfo of each topic of a bag: the first one that is calibrated, unless most differ.
class CameraInfos {
 public:
  /// Damaged messages have a warning and are left out.
  CameraInfos(const BagFile& bag, std::vector<std::string>* warnings);

  bool IsEmpty() const { return infos_.empty(); }
  /// Returns the calibration of a topic with images, whose origin names the CameraInfo: that of
  /// CameraInfoTopicOf(), or else one in the coordinate frame of the images that has their size.
  /// None if neither exists or is calibrated, for which `problem` then gives the reason.
  std::optional<Calibration> Find(const ImageTopic& images, std::string* problem) const;

 private:
  // The topics that may belong to images, the best first.
  std::vector<std::string> TopicsFor(const ImageTopic& images) const;
  // Says that images have no CameraInfo, and which the bag has.
  std::string DescribeMissing(const ImageTopic& images) const;

  std::string bag_path_;
  std::map<std::string, RosCameraInfo> infos_;  // by topic
};

}  // namespace msc_vo
