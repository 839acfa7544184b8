// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Bags of ROS 2, from their container to the pixels. The last byte chooses the kind of file. Those
// of ROS 1 are left to rosbag_storage, which is not fuzzed.

#include "tests/fuzz/input_folder.h"
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>

#include "msc_vo/datasets/image_container.h"
#include "msc_vo/ros_bag/bag_sequence.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static const auto level = cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  static_cast<void>(level);
  static InputFolder folder;
  if (size == 0 || AsText(data, size).substr(0, 7) == "#ROSBAG") return 0;
  constexpr const char* kNames[] = {"x.mcap", "x.db3", "x.mcap.zstd", "x.db3.zstd"};
  const std::string path =
      folder.Write(kNames[data[size - 1] % 4], std::string(AsText(data, size - 1)));
  Accepts(path, [&] {
    const SequenceIndex index = OpenBag(path);
    for (const SequenceEntry& entry : index.entries) {
      index.container->ReadColor(entry.color_index);
      index.container->ReadDepth(entry.depth_index);
    }
  });
  return 0;
}
