// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/window_factors.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

namespace msc_vo {

namespace {

// Groups of keyframes that are linked, directly or through others (union-find).
class KeyframeGroups {
 public:
  explicit KeyframeGroups(const WindowData& window) : parent_(window.keyframes.size()) {
    std::iota(parent_.begin(), parent_.end(), size_t{0});
    for (size_t i = 0; i < window.keyframes.size(); ++i) index_[window.keyframes[i].id] = i;
    std::map<int64_t, int64_t> first_of_point, first_of_line;  // observers of each landmark
    for (const auto& o : window.point_observations) {
      Link(first_of_point.try_emplace(o.point, o.keyframe).first->second, o.keyframe);
    }
    for (const auto& o : window.line_observations) {
      Link(first_of_line.try_emplace(o.line, o.keyframe).first->second, o.keyframe);
    }
    for (const CustomFactor& factor : window.custom_factors) LinkPoses(factor.blocks);
  }

  // The keyframe, by its index in the window, that stands for the group of another one.
  size_t RootOf(size_t keyframe) const {
    while (parent_[keyframe] != keyframe) keyframe = parent_[keyframe];
    return keyframe;
  }

 private:
  void Link(int64_t a, int64_t b) {
    const auto at_a = index_.find(a), at_b = index_.find(b);
    // LocalBundleAdjustment reports unknown ids.
    if (at_a == index_.end() || at_b == index_.end()) return;
    parent_[RootOf(at_a->second)] = RootOf(at_b->second);
  }
  void LinkPoses(const std::vector<BlockId>& blocks) {
    std::optional<int64_t> first;
    for (const BlockId& block : blocks) {
      if (block.kind != BlockId::Kind::kPose) continue;
      if (!first) first = block.id;
      Link(*first, block.id);
    }
  }

  std::map<int64_t, size_t> index_;
  std::vector<size_t> parent_;
};

}  // namespace

WindowContext MakeWindowContext(const Map& map, const WindowData& window,
                                const std::vector<ExtraBlock>& extra_blocks) {
  WindowContext context;
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    context.keyframes.push_back({keyframe.id, map.FindKeyframe(keyframe.id)->frame->timestamp,
                                 keyframe.cam_from_world, keyframe.fixed});
  }
  std::sort(context.keyframes.begin(), context.keyframes.end(),
            [](const auto& a, const auto& b) { return a.timestamp < b.timestamp; });
  context.extra_blocks = extra_blocks;
  if (window.axes) context.world_from_axes = window.axes->world_from_axes;
  return context;
}

void FixUnlinkedKeyframes(WindowData* window) {
  const KeyframeGroups groups(*window);
  std::set<size_t> with_fixed;
  for (size_t i = 0; i < window->keyframes.size(); ++i) {
    if (window->keyframes[i].fixed) with_fixed.insert(groups.RootOf(i));
  }
  // Free keyframes are in the order of their ids, which is that of time.
  for (size_t i = 0; i < window->keyframes.size(); ++i) {
    if (with_fixed.insert(groups.RootOf(i)).second) window->keyframes[i].fixed = true;
  }
}

}  // namespace msc_vo
