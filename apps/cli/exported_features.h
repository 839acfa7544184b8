// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "apps/cli/recorded_session.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/map/map_contents.h"

namespace msc_vo {

/// Draws the features that the keyframes of a run observe landmarks with.
class ExportedFeatures {
 public:
  /// `run`: its session in the map that it was saved to, see FindSession(). `images`: the sequence,
  /// possibly in another place. Throws std::runtime_error, naming the files and the fix, if the map
  /// has no keyframe of the sequence.
  ExportedFeatures(const SessionQuery& run, RgbdDecoder images);

  /// Returns a JPEG file of the image at this time with its features; empty if it is no keyframe.
  /// Throws UnreadableImage.
  std::string Draw(int64_t microseconds) const;

 private:
  struct Source {
    const SavedSubMap* submap = nullptr;
    const Keyframe* keyframe = nullptr;
    int image = 0;
  };

  RgbdDecoder images_;
  MapContents contents_;
  std::map<int64_t, Source> keyframes_;  // by their time in microseconds
};

}  // namespace msc_vo
