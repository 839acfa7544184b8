// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/mapper.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "msc_vo/mapping/landmark_creation.h"
#include "msc_vo/self_calibration/keyframe_rolling_shutter.h"
#include "msc_vo/structure/keyframe_structure.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

void DescribeAxes(const AxesEstimator& axes, MappingSummary* summary) {
  summary->axes_state = axes.state();
  summary->num_axes_refinements = axes.num_refinements();
}

}  // namespace

Mapper::Mapper(const MapperOptions& options)
    : options_(options),
      axes_(options.axes),
      noise_(options.noise),
      readout_(options.readout_time) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
}

MappingSummary Mapper::Insert(const KeyframePacket& packet) {
  MappingSummary summary;
  Stopwatch stopwatch;
  if (packet.last_velocity) {
    SetKeyframeVelocity(newest_keyframe_, *packet.last_velocity, &map_);
  }
  readout_time_ = readout_.readout_time();
  CompensateKeyframes(readout_time_, &map_);
  std::shared_ptr<const Frame> frame = UpdateCompensation(packet.frame, readout_time_);
  summary.times.creation = stopwatch.Restart();
  if (options_.RefinesFrames()) frame = RefineStructure(options_.structure, noise_.scale(), frame);
  summary.times.structure = stopwatch.Restart();
  summary.keyframe = InsertKeyframe(packet, std::move(frame));
  CullLandmarks(options_.culling, summary.keyframe, &probation_, &map_);
  CreatePoints(summary.keyframe, &probation_, &map_);
  CreateLines(summary.keyframe, &probation_, &map_);
  summary.times.creation += stopwatch.Restart();
  FusePoints(options_.fusion, summary.keyframe, &map_);
  FuseLines(options_.fusion, summary.keyframe, &map_);
  summary.times.fusion = stopwatch.Restart();
  DescribeAxes(axes_.estimator(), &summary);
  return summary;
}

void Mapper::Refine(const KeyframePacket& packet, MappingSummary* summary) {
  Stopwatch stopwatch;
  axes_.Update(map_, summary->keyframe, packet.normals);
  DescribeAxes(axes_.estimator(), summary);
  summary->times.axes = stopwatch.Restart();
  // The absolute value lets an interval of 0 mean every keyframe even if time stamps do not ascend.
  const double since_window = std::abs(packet.frame->timestamp - last_window_time_);
  if (since_window >= options_.min_window_interval) {
    summary->window = OptimizeWindow(summary->keyframe);
  }
  if (summary->window) {
    last_window_time_ = packet.frame->timestamp;
    summary->times.window = stopwatch.Restart();
  }
  readout_.Update(map_, summary->keyframe);
  summary->times.readout = stopwatch.Restart();
  summary->num_culled_keyframes = CullKeyframes(options_.culling, summary->keyframe, &map_);
  summary->times.culling = stopwatch.Restart();
}

MappingSummary Mapper::Process(const KeyframePacket& packet) {
  MappingSummary summary = Insert(packet);
  Refine(packet, &summary);
  return summary;
}

MapSnapshotPtr Mapper::Snapshot() {
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->map = map_.Share();
  snapshot->newest_keyframe = newest_keyframe_;
  snapshot->noise_scale = noise_.scale();
  snapshot->readout_time = readout_time_;
  const AxesEstimator& axes = axes_.estimator();
  if (axes.state() != AxesState::kNone) snapshot->axes = {axes.world_from_axes(), axes.sigma()};
  snapshot->needs_axes = options_.axes.enabled && axes.state() == AxesState::kNone;
  return snapshot;
}

KeyframeId Mapper::InsertKeyframe(const KeyframePacket& packet,
                                  std::shared_ptr<const Frame> frame) {
  Rigid3 cam_from_world = packet.cam_from_reference;
  if (packet.reference != kNoId) {
    cam_from_world = cam_from_world * map_.CamFromWorld(packet.reference);
  }
  newest_keyframe_ = map_.AddKeyframe(std::move(frame), cam_from_world);
  for (const PointMatch& match : packet.matches.points) {
    map_.ObservePoint(match.id, newest_keyframe_, match.feature);
  }
  for (const LineMatch& match : packet.matches.lines) {
    map_.ObserveLine(match.id, newest_keyframe_, match.feature);
  }
  for (const auto& [id, count] : packet.point_counts) {
    map_.CountPointTracking(id, count.num_visible, count.num_found);
  }
  for (const auto& [id, count] : packet.line_counts) {
    map_.CountLineTracking(id, count.num_visible, count.num_found);
  }
  return newest_keyframe_;
}

std::vector<ExtraBlock> Mapper::extra_blocks() const {
  std::vector<ExtraBlock> blocks;
  for (const auto& [id, block] : extra_blocks_) blocks.push_back(block);
  return blocks;
}

void Mapper::AddCustomFactors(WindowData* window) const {
  if (!window_factor_callback_) return;
  const AxesEstimator& axes = axes_.estimator();
  if (axes.state() != AxesState::kNone) window->axes = {axes.world_from_axes(), true};
  WindowFactors custom = window_factor_callback_(MakeWindowContext(map_, *window, extra_blocks()));
  for (ExtraBlock& block : custom.extra_blocks) {
    const auto known = extra_blocks_.find(block.id);
    if (known == extra_blocks_.end()) continue;
    if (block.value.size() != known->second.value.size()) {
      throw std::invalid_argument("extra block " + std::to_string(block.id) + ": its size is " +
                                  std::to_string(block.value.size()) + ", that of its estimate " +
                                  std::to_string(known->second.value.size()) +
                                  "; give a block of another size another id");
    }
    block.value = known->second.value;
  }
  window->extra_blocks = std::move(custom.extra_blocks);
  window->custom_factors = std::move(custom.factors);
  FixUnlinkedKeyframes(window);
}

std::optional<BundleAdjustmentSummary> Mapper::OptimizeWindow(KeyframeId keyframe) {
  const WindowLinks links =
      window_factor_callback_ ? WindowLinks::kLandmarksAndTime : WindowLinks::kLandmarks;
  WindowData window = SelectWindow(options_.selection, map_, keyframe, links);
  last_window_lines_.clear();
  for (const WindowData::Line& line : window.lines) last_window_lines_.insert(line.id);
  if (window.keyframes.size() < 2) return std::nullopt;
  noise_.Apply(&window);
  axes_.AddAlignments(map_, &window);
  AddStructuralPairs(options_.pairs, map_, &window);
  AddCustomFactors(&window);
  if (window_observer_) window_observer_(keyframe, options_.window, window);
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options_.window, &window);
  if (summary.usable) {
    noise_.Update(WindowResiduals(window));
    WriteBack(window, &map_);
    for (const ExtraBlock& block : window.extra_blocks) extra_blocks_[block.id] = block;
  }
  return summary;
}

}  // namespace msc_vo
