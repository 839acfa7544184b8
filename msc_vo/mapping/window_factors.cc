// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/window_factors.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "msc_vo/bundle_adjustment/validation.h"

namespace msc_vo {

namespace {

// Groups of keyframes that observations or custom factors link, directly or through landmarks and
// other keyframes (union-find). Extra blocks and axes link nothing.
class KeyframeGroups {
 public:
  explicit KeyframeGroups(const WindowData& window) {
    for (const auto& keyframe : window.keyframes) NodeOf(BlockId::Pose(keyframe.id));
    for (const auto& o : window.point_observations) {
      Link(BlockId::Pose(o.keyframe), BlockId::Point(o.point));
    }
    for (const auto& o : window.line_observations) {
      Link(BlockId::Pose(o.keyframe), BlockId::Line(o.line));
    }
    for (const CustomFactor& factor : window.custom_factors) LinkAll(factor.blocks);
    for (const CustomFactor& factor : window.custom_factors) MarkGroup(factor.blocks);
  }

  // The keyframe or landmark that stands for the group of a keyframe, by its index in the window.
  size_t RootOf(size_t node) {
    while (parent_[node] != node) {
      parent_[node] = parent_[parent_[node]];
      node = parent_[node];
    }
    return node;
  }
  bool HasFactor(size_t node) { return with_factor_.count(RootOf(node)) > 0; }

 private:
  static bool IsLinking(const BlockId& block) {
    return block.kind == BlockId::Kind::kPose || block.kind == BlockId::Kind::kPoint ||
           block.kind == BlockId::Kind::kLine;
  }
  size_t NodeOf(const BlockId& block) {
    const auto [node, is_new] = nodes_.try_emplace({block.kind, block.id}, parent_.size());
    if (is_new) parent_.push_back(node->second);
    return node->second;
  }
  void Link(const BlockId& a, const BlockId& b) { parent_[RootOf(NodeOf(b))] = RootOf(NodeOf(a)); }
  void LinkAll(const std::vector<BlockId>& blocks) {
    std::optional<BlockId> first;
    for (const BlockId& block : blocks) {
      if (!IsLinking(block)) continue;
      if (first) Link(*first, block);
      first = block;
    }
  }
  // Notes that a factor belongs to the group of its blocks.
  void MarkGroup(const std::vector<BlockId>& blocks) {
    const auto block = std::find_if(blocks.begin(), blocks.end(), IsLinking);
    if (block != blocks.end()) with_factor_.insert(RootOf(NodeOf(*block)));
  }

  std::map<std::pair<BlockKind, int64_t>, size_t> nodes_;
  std::vector<size_t> parent_;
  std::set<size_t> with_factor_;  // roots
};

template <typename Landmark>
const Landmark* Find(const std::vector<Landmark>& landmarks, int64_t id) {
  const auto found =
      std::lower_bound(landmarks.begin(), landmarks.end(), id,
                       [](const Landmark& landmark, int64_t x) { return landmark.id < x; });
  return found == landmarks.end() || found->id != id ? nullptr : &*found;
}

}  // namespace

const WindowData::Point* WindowContext::FindPoint(int64_t id) const {
  return data == nullptr ? nullptr : Find(data->points, id);
}

const WindowData::Line* WindowContext::FindLine(int64_t id) const {
  return data == nullptr ? nullptr : Find(data->lines, id);
}

WindowContext MakeWindowContext(const Map& map, const WindowData& window,
                                const std::vector<ExtraBlock>& extra_blocks) {
  WindowContext context;
  for (const WindowData::Keyframe& keyframe : window.keyframes) {
    if (map.IsOfEarlierSession(keyframe.id)) continue;
    context.keyframes.push_back({keyframe.id, map.FindKeyframe(keyframe.id)->frame->timestamp,
                                 keyframe.cam_from_world, keyframe.fixed});
  }
  std::sort(context.keyframes.begin(), context.keyframes.end(),
            [](const auto& a, const auto& b) { return a.timestamp < b.timestamp; });
  context.extra_blocks = extra_blocks;
  if (window.axes) context.world_from_axes = window.axes->world_from_axes;
  context.data = &window;
  return context;
}

void FixGaugeOfUnlinkedKeyframes(const Map& map, WindowData* window) {
  KeyframeGroups groups(*window);  // its first nodes are the keyframes of the window
  std::set<size_t> held;
  for (size_t i = 0; i < window->keyframes.size(); ++i) {
    if (window->keyframes[i].fixed) held.insert(groups.RootOf(i));
  }
  // Free keyframes are in the order of their ids, which is that of time.
  for (size_t i = 0; i < window->keyframes.size(); ++i) {
    if (!held.insert(groups.RootOf(i)).second) continue;
    WindowData::Keyframe& keyframe = window->keyframes[i];
    const PoseCovariance& step = *map.StepCovariance(keyframe.id);
    if (!groups.HasFactor(i) || CovarianceError(step) != nullptr) {
      keyframe.fixed = true;
      continue;
    }
    window->pose_priors.push_back(
        {keyframe.id, keyframe.cam_from_world, CovarianceOfCamera(keyframe.cam_from_world, step)});
  }
}

}  // namespace msc_vo
