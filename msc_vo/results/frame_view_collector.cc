// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/frame_view_collector.h"

#include <algorithm>
#include <utility>

#include "msc_vo/results/thumbnail.h"
#include "msc_vo/results/tracked_features.h"

namespace msc_vo {

FrameViewCollector::FrameViewCollector(int num_frames, const LensDistortion& distortion,
                                       const FrameViewLimits& limits)
    : distortion_(distortion), limits_(limits) {
  while (num_frames / stride_ > limits.max_spaced) stride_ *= 2;
}

void FrameViewCollector::Add(const TrackedImage& tracked) {
  const int frame = static_cast<int>(tracked.result.id);
  const int keyframe = tracked.result.is_keyframe ? num_keyframes_++ : -1;
  if (!IsKept(frame, keyframe)) return;
  auto view = std::make_shared<FrameView>(
      FrameView{frame, EncodeThumbnail(tracked.image.gray), TrackedFeatures(tracked, distortion_)});
  num_bytes_ += NumBytes(*view);
  entries_[frame] = {std::move(view), keyframe};
  while (num_bytes_ > limits_.max_bytes && Thin()) {
  }
}

bool FrameViewCollector::IsKept(int frame, int keyframe) const {
  return keyframe >= 0 ? keyframe % keyframe_stride_ == 0 : frame % stride_ == 0;
}

bool FrameViewCollector::Thin() {
  // Frame 0 and keyframe 0 are multiples of every stride.
  const auto is_spaced = [](const auto& item) {
    return item.first > 0 && item.second.keyframe < 0;
  };
  const auto is_keyframe = [](const auto& item) { return item.second.keyframe > 0; };
  if (std::any_of(entries_.begin(), entries_.end(), is_spaced)) {
    stride_ *= 2;
  } else if (std::any_of(entries_.begin(), entries_.end(), is_keyframe)) {
    keyframe_stride_ *= 2;
  } else {
    return false;
  }
  for (auto it = entries_.begin(); it != entries_.end();) {
    if (IsKept(it->first, it->second.keyframe)) {
      ++it;
    } else {
      num_bytes_ -= NumBytes(*it->second.view);
      it = entries_.erase(it);
    }
  }
  return true;
}

std::vector<FrameView> FrameViewCollector::Take() {
  std::vector<FrameView> views;
  for (auto& [frame, entry] : entries_) views.push_back(std::move(*entry.view));
  entries_.clear();
  num_bytes_ = 0;
  return views;
}

}  // namespace msc_vo
