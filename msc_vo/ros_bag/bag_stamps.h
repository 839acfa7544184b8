// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/image_list.h"

namespace msc_vo {

/// Times of a message, seconds.
struct MessageTimes {
  double header = 0.0;   ///< stamp in the header
  double receive = 0.0;  ///< when the message was recorded
};

/// The messages of two topics with images, in the order of recording.
struct TopicTimes {
  std::vector<MessageTimes> color;
  std::vector<MessageTimes> depth;
};

/// Sets the stamps of the images of two topics, which are in the order of recording, and sorts them
/// by time. The stamps are those of the headers. They are the times of recording, with a warning,
/// if more than half of the headers of a topic have no stamp, if it has fewer different stamps than
/// half of its messages, if they go back in time, or if the stamps of both topics are of different
/// clocks: where messages were recorded at the same time, their stamps differ by more than
/// transport explains. Messages without a stamp among others that have one are left out, with a
/// warning. Throws std::runtime_error, naming the image, if the times of recording are needed and
/// go back in time as well.
void StampImages(const TopicTimes& times, ImageLists* images, std::vector<std::string>* warnings);

}  // namespace msc_vo
