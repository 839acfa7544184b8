// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/place_index.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace msc_vo {

namespace {

// Words whose lists are loaded into the cache while the list of another one is read: they are
// anywhere in memory.
constexpr size_t kAhead = 8;

// Words whose lists are renumbered whenever a keyframe comes or goes: all of them are done before
// half of some 1,000 keyframes have gone (docs/lab/loops.md).
constexpr size_t kRenumberedAtOnce = kNumBinaryWords / 512;

}  // namespace

void PlaceIndex::Add(KeyframeId keyframe, std::shared_ptr<const Frame> frame) {
  words_.resize(kNumBinaryWords);
  const auto slot = static_cast<Slot>(entries_.size());
  slots_[keyframe] = slot;
  const auto old_slot = static_cast<Slot>(new_slots_.size());
  if (IsRenumbering()) new_slots_.push_back(slot);
  const std::vector<BinaryWord> words = WordsOf(*frame);
  for (const BinaryWord word : words) {
    words_[word].slots.Append(HasOldSlots(word) ? old_slot : slot);
    ++words_[word].num_keyframes;
  }
  entries_.push_back({keyframe, std::move(frame), static_cast<int>(words.size())});
  Renumber(kRenumberedAtOnce);
}

void PlaceIndex::Remove(KeyframeId keyframe) {
  const auto place = slots_.find(keyframe);
  if (place == slots_.end()) return;
  Entry& entry = entries_[place->second];
  for (const BinaryWord word : WordsOf(*entry.frame)) --words_[word].num_keyframes;
  entry = {};
  slots_.erase(place);
  Renumber(kRenumberedAtOnce);
  if (entries_.size() >= 2 * slots_.size()) Compact();
}

void PlaceIndex::Compact() {
  Renumber(words_.size());
  new_slots_.assign(entries_.size(), PostingList::kNoSlot);
  std::vector<Entry> entries;
  entries.reserve(slots_.size());
  for (size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].keyframe == kNoId) continue;
    new_slots_[i] = static_cast<Slot>(entries.size());
    entries.push_back(std::move(entries_[i]));
  }
  for (auto& [id, slot] : slots_) slot = new_slots_[slot];
  entries_ = std::move(entries);
  num_renumbered_ = 0;
}

void PlaceIndex::Renumber(size_t max_words) {
  if (!IsRenumbering()) return;
  const size_t end = std::min(num_renumbered_ + max_words, words_.size());
  for (; num_renumbered_ < end; ++num_renumbered_) {
    words_[num_renumbered_].slots.Renumber(new_slots_);
  }
  if (num_renumbered_ == words_.size()) new_slots_.clear();
}

void PlaceIndex::Update(const MapSnapshot& snapshot) {
  std::set<KeyframeId> present;
  const auto add_all = [&](const Map& map) {
    for (const auto& [id, keyframe] : map.keyframes()) {
      present.insert(present.end(), id);
      const auto known = slots_.find(id);
      if (known == slots_.end()) {
        Add(id, keyframe.frame);
      } else {
        entries_[known->second].frame = keyframe.frame;  // with the same descriptors
      }
    }
  };
  for (const auto& map : snapshot.inactive_maps) add_all(*map);
  add_all(snapshot.map);
  std::vector<KeyframeId> gone;
  for (const auto& [id, slot] : slots_) {
    if (present.count(id) == 0) gone.push_back(id);
  }
  for (const KeyframeId id : gone) Remove(id);
}

std::vector<Place> PlaceIndex::Query(const Frame& frame, int max_places) const {
  if (slots_.empty()) return {};
  const double num_keyframes = size();
  const std::vector<BinaryWord> words = WordsOf(frame);
  // The last one collects what removed keyframes would have.
  std::vector<float> scores(entries_.size() + 1, 0.0f);
  for (size_t i = 0; i < words.size(); ++i) {
    if (i + kAhead < words.size()) words_[words[i + kAhead]].slots.Prefetch();
    const Word& word = words_[words[i]];
    if (word.num_keyframes == 0) continue;
    // 0 for a word that all keyframes have
    const float weight = static_cast<float>(std::log(num_keyframes / word.num_keyframes));
    if (HasOldSlots(words[i])) {
      word.slots.ForEach([&](Slot slot) {
        scores[std::min<size_t>(new_slots_[slot], entries_.size())] += weight;
      });
    } else {
      word.slots.ForEach([weight, score = scores.data()](Slot slot) { score[slot] += weight; });
    }
  }
  std::vector<Place> places;
  for (size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].keyframe == kNoId || scores[i] <= 0.0f) continue;
    const double norm = std::sqrt(static_cast<double>(words.size()) * entries_[i].num_words);
    places.push_back({entries_[i].keyframe, scores[i] / norm});
  }
  const auto is_better = [](const Place& a, const Place& b) {
    return a.score != b.score ? a.score > b.score : a.keyframe > b.keyframe;
  };
  if (static_cast<size_t>(max_places) < places.size()) {
    std::nth_element(places.begin(), places.begin() + max_places, places.end(), is_better);
    places.resize(max_places);
  }
  std::sort(places.begin(), places.end(), is_better);
  return places;
}

}  // namespace msc_vo
