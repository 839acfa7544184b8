// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <memory>
#include <vector>

#include "msc_vo/map/map.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/place_recognition/binary_words.h"
#include "msc_vo/place_recognition/posting_list.h"

namespace msc_vo {

/// A keyframe that looks like a frame.
struct Place {
  KeyframeId keyframe = kNoId;
  /// The words that the two share, each with the logarithm of its inverse keyframe frequency, over
  /// the geometric mean of the numbers of their words.
  double score = 0.0;
};

/// An inverted index of the words of keyframes. What it returns depends on the keyframes that are
/// in it alone, not on the order in which they came and went.
class PlaceIndex {
 public:
  /// Adds a keyframe that is not in the index.
  void Add(KeyframeId keyframe, std::shared_ptr<const Frame> frame);
  /// No effect if the keyframe is not in the index.
  void Remove(KeyframeId keyframe);
  /// Adds and removes keyframes so that the index has those of all maps of a snapshot.
  void Update(const MapSnapshot& snapshot);

  int size() const { return static_cast<int>(slots_.size()); }

  /// The keyframes of the index that share words with the frame, best score first, then newest
  /// first; at most `max_places`.
  std::vector<Place> Query(const Frame& frame, int max_places) const;

 private:
  // Position of a keyframe in the order of insertion.
  using Slot = PostingList::Slot;
  struct Entry {
    KeyframeId keyframe = kNoId;  // kNoId: it was removed
    std::shared_ptr<const Frame> frame;
    int num_words = 0;
  };
  // The list keeps the slots of removed keyframes until it is renumbered, after half of all slots
  // have been removed.
  struct Word {
    PostingList slots;
    int num_keyframes = 0;  // that were not removed
  };

  // Numbers the keyframes anew, without those that were removed. Lists have the old slots until
  // Renumber() reaches them.
  void Compact();
  // Gives the lists of the next words the new slots.
  void Renumber(size_t max_words);
  bool IsRenumbering() const { return !new_slots_.empty(); }
  bool HasOldSlots(BinaryWord word) const { return IsRenumbering() && word >= num_renumbered_; }

  std::map<KeyframeId, Slot> slots_;
  std::vector<Entry> entries_;   // by slot
  std::vector<Word> words_;      // empty until the first keyframe is added
  std::vector<Slot> new_slots_;  // by old slot; empty if all lists have the new ones
  size_t num_renumbered_ = 0;    // words whose lists have them, as long as others do not
};

}  // namespace msc_vo
