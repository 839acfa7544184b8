// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/map/map_contents.h"

namespace msc_vo {

/// The keyframes `first`, ..., `end` - 1.
struct KeyframeRange {
  KeyframeId first = 0, end = 0;
  bool Contains(KeyframeId id) const { return first <= id && id < end; }
};

/// The index of the image whose time stamp is nearest to that of the keyframe.
int NearestEntry(const Keyframe& keyframe, const std::vector<SequenceEntry>& entries);

/// Describes the session of a map that is looked for.
struct SessionQuery {
  std::string map_file;
  std::string sequence;  ///< path of the sequence when it was run
  std::string session;   ///< full name of the session (--session); empty: that of the sequence
  /// Whether the session of a map that has only one must have the name of the sequence, too.
  bool requires_name = true;
  std::string fix;  ///< end of the messages of errors
};

/// Finds the session that recorded the images of a sequence. Its name must be NewSessionName() of
/// the sequence, the time stamps of its keyframes those of the images, and the images of its
/// keyframes in the map file, if there are any, must show the same as those of the sequence.
/// Returns the newest session with the same images, if there are several; without images in the map
/// file, several sessions are refused. A full name that only one session has is not compared with
/// the sequence. Throws std::runtime_error that names the files, the sessions and the fix.
KeyframeRange FindSession(const SessionQuery& query, const MapContents& contents,
                          const RgbdDecoder& images);

}  // namespace msc_vo
