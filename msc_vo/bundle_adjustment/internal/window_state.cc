// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/bundle_adjustment/internal/window_state.h"

#include "msc_vo/factors/rigid3_manifold.h"

namespace msc_vo {

namespace {

// Local statics: initialisers of static objects in other files may solve windows.
const ceres::Manifold* PoseManifold() {
  static const Rigid3Manifold manifold;
  return &manifold;
}
const ceres::Manifold* RotationManifold() {
  static const Rotation3Manifold manifold;
  return &manifold;
}

}  // namespace

bool IsFixed(const WindowData& data, const StateBlock& block) {
  const size_t i = static_cast<size_t>(block.position);
  switch (block.kind) {
    case BlockKind::kPose:
      return data.keyframes[i].fixed;
    case BlockKind::kPoint:
      return data.points[i].fixed;
    case BlockKind::kLine:
      return data.lines[i].fixed;
    case BlockKind::kAxes:
    case BlockKind::kExtra:
      break;
  }
  return i < data.extra_blocks.size() ? data.extra_blocks[i].fixed : data.axes->fixed;
}

WindowState::WindowState(const WindowData& data)
    : lines_(3 * data.points.size()), poses_(lines_ + 6 * data.lines.size()) {
  parameters_.reserve(poses_ + 7 * data.keyframes.size());
  const auto append = [this](const double* block, int size) {
    parameters_.insert(parameters_.end(), block, block + size);
  };
  for (const WindowData::Point& p : data.points) append(p.position.data(), 3);
  for (const WindowData::Line& l : data.lines) append(l.segment.start.data(), 6);
  for (const WindowData::Keyframe& k : data.keyframes) append(k.cam_from_world.params.data(), 7);
  for (const msc_vo::ExtraBlock& e : data.extra_blocks) {
    AppendExtra(e.value.data(), static_cast<int>(e.value.size()), e.manifold.get());
  }
  if (data.axes) AppendExtra(data.axes->world_from_axes.coeffs().data(), 4, RotationManifold());
}

void WindowState::AppendExtra(const double* value, int size, const ceres::Manifold* manifold) {
  extra_.push_back({parameters_.size(), size, manifold});
  parameters_.insert(parameters_.end(), value, value + size);
}

const double* WindowState::Block(const StateBlock& block) const {
  switch (block.kind) {
    case BlockKind::kPose:
      return PoseBlock(block.position);
    case BlockKind::kPoint:
      return PointBlock(block.position);
    case BlockKind::kLine:
      return LineBlock(block.position);
    case BlockKind::kAxes:
    case BlockKind::kExtra:
      break;
  }
  return ExtraBlock(block.position);
}

int WindowState::Size(const StateBlock& block) const {
  const int size = BlockSize(block.kind);
  return size > 0 ? size : extra_[block.position].size;
}

int WindowState::TangentSize(const StateBlock& block) const {
  const ceres::Manifold* manifold = ManifoldOf(block);
  return manifold != nullptr ? manifold->TangentSize() : Size(block);
}

const ceres::Manifold* WindowState::ManifoldOf(const StateBlock& block) const {
  if (block.kind == BlockKind::kPose) return PoseManifold();
  return block.kind == BlockKind::kExtra ? extra_[block.position].manifold : nullptr;
}

void WriteState(const WindowState& state, const std::function<bool(const StateBlock&)>& is_written,
                WindowData* data) {
  const auto is = [&is_written](BlockKind kind, size_t i) {
    return is_written({kind, static_cast<int>(i)});
  };
  for (size_t i = 0; i < data->keyframes.size(); ++i) {
    if (is(BlockKind::kPose, i)) data->keyframes[i].cam_from_world = state.Pose(i);
  }
  for (size_t i = 0; i < data->points.size(); ++i) {
    if (is(BlockKind::kPoint, i)) data->points[i].position = state.Point(i);
  }
  for (size_t i = 0; i < data->lines.size(); ++i) {
    if (is(BlockKind::kLine, i)) data->lines[i].segment = state.Line(i);
  }
  const size_t axes = data->extra_blocks.size();
  for (size_t i = 0; i < axes; ++i) {
    if (is(BlockKind::kExtra, i)) data->extra_blocks[i].value = state.Extra(i);
  }
  if (data->axes && is(BlockKind::kExtra, axes)) {
    data->axes->world_from_axes = Eigen::Quaterniond(state.ExtraBlock(axes));
  }
}

}  // namespace msc_vo
