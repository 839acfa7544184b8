// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include "msc_vo/datasets/sequence.h"

namespace msc_vo {

/// Topics of the images in a bag; empty: found by their types.
struct BagTopics {
  std::string color;
  std::string depth;
};

/// Opens a bag of ROS 1 or 2, see OpenBagFile(). The time stamps of all images are read, one
/// topic after the other, which decompresses the bag; images are read on demand. Topics that are
/// not given are chosen by their types, see BestPair(): colour in sensor_msgs/Image or
/// CompressedImage with 8 bits per channel, depth with 16UC1 (millimetres), 32FC1 (metres) or
/// compressedDepth. The calibration is that of ReadCalibration(), unless the name of the file
/// suggests a camera preset; recordings of the RealSense viewer give the units of depth too. A
/// file NAME-groundtruth.txt beside the bag is the ground truth, see BagName(). Colour and depth
/// are paired as PairByTime() does. Messages whose header cannot be read are left out, with a
/// warning, unless they are more than half of a topic. Throws std::runtime_error naming the file
/// and the fix.
SequenceIndex OpenBag(const std::string& path, const BagTopics& topics = {});

}  // namespace msc_vo
