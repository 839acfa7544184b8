// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/exported_features.h"

#include <stdexcept>
#include <utility>

#include "apps/cli/overlay_video.h"
#include "msc_vo/exports/recorded_run.h"
#include "msc_vo/image_files/opencv_codecs.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/results/tracked_features.h"

namespace msc_vo {

ExportedFeatures::ExportedFeatures(const SessionQuery& run, RgbdDecoder images)
    : images_(std::move(images)), contents_(LoadMap(run.map_file)) {
  std::map<int64_t, int> stamps;
  for (int i = 0; i < images_.size(); ++i) {
    stamps[Microseconds(images_.index().entries[static_cast<size_t>(i)].timestamp)] = i;
  }
  const KeyframeRange session = FindSession(run, contents_, images_);
  for (const SavedSubMap& submap : contents_.submaps) {
    for (const auto& [id, keyframe] : submap.map.keyframes()) {
      const auto image = stamps.find(Microseconds(keyframe.frame->timestamp));
      if (!session.Contains(id) || image == stamps.end()) continue;
      keyframes_[image->first] = {&submap, &keyframe, image->second};
    }
  }
  if (!keyframes_.empty()) return;
  throw std::runtime_error(run.map_file + ": has no keyframe at the time of an image of " +
                           images_.index().directory + "; " + run.fix);
}

std::string ExportedFeatures::Draw(int64_t microseconds) const {
  const auto found = keyframes_.find(microseconds);
  if (found == keyframes_.end()) return "";
  const auto& [submap, keyframe, image] = found->second;
  const ViewedFeatures features = ObservedFeatures(*keyframe, submap->map, submap->axes);
  return EncodeWithOpenCv(".jpg", DrawFeatures(images_.Decode(image).gray, features), {});
}

}  // namespace msc_vo
