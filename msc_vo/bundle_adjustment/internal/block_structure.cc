// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/block_structure.h"

#include <algorithm>

#include "msc_vo/bundle_adjustment/internal/elimination_order.h"

namespace msc_vo {

namespace {

// Numbers the items that are neither fixed nor unconstrained. Returns their count.
template <typename Item>
int NumberUnknowns(const std::vector<Item>& items, const std::vector<bool>& constrained,
                   std::vector<int>* numbers) {
  int count = 0;
  for (size_t i = 0; i < items.size(); ++i) {
    numbers->push_back(constrained[i] && !items[i].fixed ? count++ : -1);
  }
  return count;
}

// Merges the two terms of the observations, both in the order of the data.
template <typename Reprojection, typename Depth>
std::vector<ObservationFactors<Reprojection, Depth>> MergeTerms(
    const WindowTerm<Reprojection>& reprojection, const WindowTerm<Depth>& depth) {
  std::vector<ObservationFactors<Reprojection, Depth>> observations;
  observations.reserve(std::max(reprojection.blocks.size(), depth.blocks.size()));
  auto d = depth.blocks.begin();
  const auto add_depths_before = [&](int source) {
    for (; d != depth.blocks.end() && d->source < source; ++d) {
      observations.push_back({d->parameters[0], d->parameters[1], -1, nullptr, &d->factor});
    }
  };
  for (const auto& r : reprojection.blocks) {
    add_depths_before(r.source);
    const bool has_depth = d != depth.blocks.end() && d->source == r.source;
    observations.push_back(
        {r.parameters[0], r.parameters[1], -1, &r.factor, has_depth ? &d->factor : nullptr});
    if (has_depth) ++d;
  }
  if (d != depth.blocks.end()) add_depths_before(depth.blocks.back().source + 1);
  return observations;
}

// Creates the pose-landmark blocks and sets them in the observations.
template <typename Observation>
PoseLandmarkBlocks CreateBlocks(const std::vector<int>& pose, const std::vector<int>& landmark,
                                int num_landmarks, std::vector<Observation>* observations) {
  PoseLandmarkBlocks blocks;
  blocks.of_landmark.resize(num_landmarks);
  for (const Observation& o : *observations) {
    if (landmark[o.landmark] >= 0) ++blocks.of_landmark[landmark[o.landmark]].size;
  }
  int end = 0;
  for (PoseLandmarkBlocks::Range& range : blocks.of_landmark) {
    range.begin = end;
    end += range.size;
    range.size = 0;
  }
  blocks.pose.resize(end);
  for (Observation& o : *observations) {
    if (landmark[o.landmark] < 0 || pose[o.keyframe] < 0) continue;
    PoseLandmarkBlocks::Range& range = blocks.of_landmark[landmark[o.landmark]];
    const auto begin = blocks.pose.begin() + range.begin, stop = begin + range.size;
    o.block = static_cast<int>(std::find(begin, stop, pose[o.keyframe]) - blocks.pose.begin());
    if (o.block == range.end()) blocks.pose[range.begin + range.size++] = pose[o.keyframe];
  }
  return blocks;
}

}  // namespace

template <typename Action>
void BlockStructure::ForEachCoupledUnknown(BlockKind kind, const Action& action) const {
  const auto is_unknown = [](const StateBlock& block) { return block.position >= 0; };
  for (const std::vector<StateBlock>& blocks : custom_factors) {
    if (std::count_if(blocks.begin(), blocks.end(), is_unknown) < 2) continue;
    for (const StateBlock& block : blocks) {
      if (block.kind == kind && is_unknown(block)) action(block.position);
    }
  }
}

BlockStructure::BlockStructure(const WindowData& data, const WindowTerms& terms,
                               const WindowState& state)
    : point_observations(MergeTerms(terms.Of<PointReprojection>(), terms.Of<DepthReprojection>())),
      line_observations(
          MergeTerms(terms.Of<LineReprojection>(), terms.Of<LineDepthReprojection>())) {
  num_poses = NumberUnknowns(data.keyframes, terms.keyframe_constrained, &pose);
  num_points = NumberUnknowns(data.points, terms.point_constrained, &point);
  num_lines = NumberUnknowns(data.lines, terms.line_constrained, &line);
  point_blocks = CreateBlocks(pose, point, num_points, &point_observations);
  line_blocks = CreateBlocks(pose, line, num_lines, &line_observations);

  ForEachPair(terms, [this](int a, int b) {
    if (line[a] >= 0 && line[b] >= 0) line_pairs.push_back({line[a], line[b]});
  });
  NumberExtraBlocks(data, terms, state);
  NumberCustomFactors(terms);
  std::vector<bool> in_reduced_system = LinesInReducedSystem(num_lines, line_pairs);
  ForEachCoupledUnknown(BlockKind::kLine, [&](int i) { in_reduced_system[i] = true; });
  for (const bool is_reduced : in_reduced_system) {
    reduced_line.push_back(is_reduced ? num_reduced_lines++ : -1);
  }
  AssignRows();
}

void BlockStructure::NumberExtraBlocks(const WindowData& data, const WindowTerms& terms,
                                       const WindowState& state) {
  for (size_t i = 0; i < state.NumExtra(); ++i) {
    const StateBlock block{BlockKind::kExtra, static_cast<int>(i)};
    const bool is_unknown = terms.extra_constrained[i] && !IsFixed(data, block);
    extra.push_back(is_unknown ? static_cast<int>(extra_size.size()) : -1);
    if (is_unknown) extra_size.push_back(state.TangentSize(block));
  }
}

int BlockStructure::Number(const StateBlock& block) const {
  switch (block.kind) {
    case BlockKind::kPose:
      return pose[block.position];
    case BlockKind::kPoint:
      return point[block.position];
    case BlockKind::kLine:
      return line[block.position];
    case BlockKind::kAxes:
    case BlockKind::kExtra:
      break;
  }
  return extra[block.position];
}

void BlockStructure::NumberCustomFactors(const WindowTerms& terms) {
  for (const auto& block : terms.Of<CustomFactor>().blocks) {
    custom_factors.emplace_back();
    for (const StateBlock& b : block.parameters) {
      custom_factors.back().push_back({b.kind, Number(b)});
    }
  }
}

void BlockStructure::AssignRows() {
  reduced_size = DirectionRow(num_reduced_lines);
  const auto assign = [this](int size, int* row) {
    if (*row >= 0) return;
    *row = reduced_size;
    reduced_size += size;
  };
  point_row.assign(num_points, -1);
  position_row.assign(num_reduced_lines, -1);
  extra_row.assign(extra_size.size(), -1);
  ForEachCoupledUnknown(BlockKind::kPoint, [&](int i) { assign(3, &point_row[i]); });
  ForEachCoupledUnknown(BlockKind::kLine,
                        [&](int i) { assign(4, &position_row[reduced_line[i]]); });
  for (size_t i = 0; i < extra_size.size(); ++i) assign(extra_size[i], &extra_row[i]);
}

}  // namespace msc_vo
