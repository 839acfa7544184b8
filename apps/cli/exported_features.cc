// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/exported_features.h"

#include <stdexcept>
#include <utility>

#include "apps/cli/overlay_video.h"
#include "apps/cli/run_map.h"
#include "msc_vo/exports/recorded_run.h"
#include "msc_vo/image_files/opencv_codecs.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/results/tracked_features.h"

namespace msc_vo {

ExportedFeatures::ExportedFeatures(const std::string& map_file, const std::string& sequence,
                                   RgbdDecoder images)
    : images_(std::move(images)), contents_(LoadMap(map_file)) {
  std::map<int64_t, int> stamps;
  for (int i = 0; i < images_.size(); ++i) {
    stamps[Microseconds(images_.index().entries[static_cast<size_t>(i)].timestamp)] = i;
  }
  const KeyframeRange session = FindSession(contents_.sessions, sequence);
  for (const SavedSubMap& submap : contents_.submaps) {
    for (const auto& [id, keyframe] : submap.map.keyframes()) {
      const auto image = stamps.find(Microseconds(keyframe.frame->timestamp));
      if (!session.Contains(id) || image == stamps.end()) continue;
      keyframes_[image->first] = {&submap, &keyframe, image->second};
    }
  }
  if (!keyframes_.empty()) return;
  throw std::runtime_error(map_file + ": has no keyframe of " + sequence +
                           "; give the map that the run was saved to (replay --map)");
}

std::string ExportedFeatures::Draw(int64_t microseconds) const {
  const auto found = keyframes_.find(microseconds);
  if (found == keyframes_.end()) return "";
  const auto& [submap, keyframe, image] = found->second;
  const ViewedFeatures features = ObservedFeatures(*keyframe, submap->map, submap->axes);
  return EncodeWithOpenCv(".jpg", DrawFeatures(images_.Decode(image).gray, features), {});
}

}  // namespace msc_vo
