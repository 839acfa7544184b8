// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/mapper.h"

#include <cassert>
#include <utility>

#include "msc_vo/map/map_validation.h"
#include "msc_vo/mapping/far_lines.h"
#include "msc_vo/mapping/landmark_fusion.h"
#include "msc_vo/self_calibration/keyframe_frames.h"
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
      atlas_(options.axes, options.noise),
      calibration_(options.readout_time),
      optimizer_(options) {}

void Mapper::BeginWith(std::vector<SavedSubMap> submaps, const std::vector<PoseGraphEdge>& loops,
                       const PinholeCamera& camera) {
  loops_.AddEdges(loops);
  for (SavedSubMap& submap : submaps) ChangeKeyframeCamera(camera, &submap.map);
  atlas_.BeginWith(std::move(submaps));
}

void Mapper::Advance(KeyframeTask* task) {
  const auto next = [task] {
    task->stage_ = static_cast<MappingStage>(static_cast<int>(task->stage_) + 1);
  };
  switch (task->stage_) {
    case MappingStage::kStructure:
      PrepareFrame(task);
      return next();
    case MappingStage::kCreation:
      Create(task);
      return next();
    case MappingStage::kFusion:
      Fuse(task);
      return next();
    case MappingStage::kLoop:
      CloseLoop(task);
      return next();
    case MappingStage::kAxes:
      UpdateAxes(task);
      return next();
    case MappingStage::kWindow:
      BeginWindow(task);
      return next();
    case MappingStage::kSolve:
      if (!Solve(task)) next();
      return;
    case MappingStage::kReadout:
      Timed(&task->summary_.times.readout,
            [&] { calibration_.UpdateReadoutTime(task->packet_, map(), task->summary_.keyframe); });
      return next();
    case MappingStage::kCalibration:
      Calibrate(task);
      return next();
    case MappingStage::kCulling:
      Cull(task);
      return next();
    case MappingStage::kDone:
      return;
  }
}

MappingSummary Mapper::Process(const KeyframePacket& packet) {
  KeyframeTask task(packet);
  while (!task.IsDone()) Advance(&task);
  return task.summary();
}

void Mapper::PrepareFrame(KeyframeTask* task) {
  const KeyframePacket& packet = task->packet_;
  MappingTimes& times = task->summary_.times;
  SubMap& submap = atlas_.current();
  Timed(&times.creation, [&] {
    if (packet.last_velocity) {
      SetKeyframeVelocity(packet.last_keyframe, *packet.last_velocity, &submap.map);
    }
    if (packet.begins_map) BeginMap(packet);
    calibration_.CompensateMap(&submap.map);
    submap.planes.FollowFrames(submap.map);
    task->frame_ = calibration_.BringUpToDate(packet);
    if (calibration_.IsDoubted()) return;
    task->frame_ = MeasureFarLines(packet.matches, std::move(task->frame_));
  });
  if (!options_.frame_structure) return;
  Timed(&times.structure, [&] {
    task->frame_ = RefineStructure(options_.structure, submap.noise.scale(),
                                   options_.MapHasStructure(), task->frame_);
  });
}

void Mapper::Create(KeyframeTask* task) {
  MappingSummary& summary = task->summary_;
  Timed(&summary.times.creation, [&] {
    inserter_.Insert(task->packet_, std::exchange(task->frame_, nullptr), &atlas_, &summary);
    SubMap& submap = atlas_.current();
    CullLandmarks(options_.culling, summary.keyframe, &probation_, &submap.map);
    CreateLandmarks(summary.keyframe, &probation_, &submap.map);
    loops_.AddKeyframe(submap.map, summary.keyframe, task->packet_.reference);
    submap.planes.AddKeyframe(submap.map, summary.keyframe, task->packet_.covariance);
  });
}

void Mapper::Fuse(KeyframeTask* task) {
  MappingSummary& summary = task->summary_;
  SubMap& submap = atlas_.current();
  Timed(&summary.times.fusion,
        [&] { FuseLandmarks(options_.fusion, summary.keyframe, &submap.map); });
  DescribeAxes(submap.axes.estimator(), &summary);
  assert(FirstViolation(map()).empty());
}

void Mapper::CloseLoop(KeyframeTask* task) {
  const KeyframePacket& packet = task->packet_;
  MappingSummary& summary = task->summary_;
  SubMap& submap = atlas_.current();
  Map* const map = &submap.map;
  if (summary.join) return loops_.Clear();  // the world of the visits may be another
  if (!packet.revisit || map->FindKeyframe(packet.revisit->reference) == nullptr) return;
  Timed(&summary.times.loop, [&] {
    loops_.AddRevisit({summary.keyframe, packet.covariance, *packet.revisit});
    summary.loop = loops_.TryClose(map);
    if (!summary.loop) return;
    submap.planes = submap.planes.Fitted(*map);
    FuseLandmarks(options_.fusion, summary.keyframe, map);
  });
  summary.num_refused_loops = loops_.num_refused();
}

void Mapper::UpdateAxes(KeyframeTask* task) {
  MappingSummary& summary = task->summary_;
  SubMap& submap = atlas_.current();
  Timed(&summary.times.axes,
        [&] { submap.axes.Update(submap.map, summary.keyframe, task->packet_.normals); });
  DescribeAxes(submap.axes.estimator(), &summary);
}

void Mapper::BeginWindow(KeyframeTask* task) {
  MappingSummary& summary = task->summary_;
  double milliseconds = 0.0;
  task->window_ = Timed(&milliseconds, [&] {
    return optimizer_.BeginWindow(summary.keyframe, !calibration_.IsDoubted(), &atlas_.current());
  });
  if (task->window_) summary.times.window = milliseconds;
}

bool Mapper::Solve(KeyframeTask* task) {
  if (task->window_ == nullptr) return false;
  MappingSummary& summary = task->summary_;
  return Timed(&*summary.times.window, [&] {
    if (task->window_->Advance()) return true;
    const std::unique_ptr<WindowTask> window = std::move(task->window_);
    summary.window = optimizer_.EndWindow(summary.keyframe, *window, &atlas_.current());
    return false;
  });
}

void Mapper::Calibrate(KeyframeTask* task) {
  MappingSummary& summary = task->summary_;
  Timed(&summary.times.calibration, [&] {
    SubMap& submap = atlas_.current();
    const bool was_doubted = calibration_.IsDoubted();
    const bool is_changed =
        calibration_.UpdateIntrinsics(task->packet_, submap.map, summary.keyframe);
    // Windows have left planes where they were.
    if (was_doubted && !calibration_.IsDoubted()) submap.planes = submap.planes.Fitted(submap.map);
    if (!is_changed) return;
    summary.calibration = std::make_shared<CalibrationChange>(
        CalibrationChange{calibration_.intrinsics()->estimate(), atlas_.ShareAll()});
    ApplyCalibration(summary.keyframe);
  });
}

void Mapper::Cull(KeyframeTask* task) {
  MappingSummary& summary = task->summary_;
  summary.num_culled_keyframes = Timed(&summary.times.culling, [&] {
    SubMap& submap = atlas_.current();
    const int num_culled = CullKeyframes(options_.culling, summary.keyframe, &submap.map);
    if (num_culled > 0) submap.planes.Renew(submap.map);
    return num_culled;
  });
  assert(FirstViolation(map()).empty());
}

void Mapper::BeginMap(const KeyframePacket& packet) {
  inserter_.BeginMap(packet, &atlas_);
  loops_.Clear();
  probation_ = {};
  optimizer_.BeginMap();
}

MapSnapshotPtr Mapper::Snapshot() {
  SubMap& submap = atlas_.current();
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->map = submap.map.Share();
  snapshot->planes = submap.planes.InWorld(submap.map);
  snapshot->world = submap.id;
  snapshot->inactive_maps = atlas_.inactive_maps();
  snapshot->newest_keyframe = inserter_.newest();
  snapshot->num_loops = loops_.num_closed();
  snapshot->loops = loops_.edges();
  snapshot->noise_scale = submap.noise.scale();
  calibration_.Describe(&*snapshot);
  snapshot->axes = submap.axes.Estimate();
  snapshot->needs_axes = options_.axes.enabled && !snapshot->axes;
  snapshot->extra_blocks = optimizer_.extra_blocks();
  return snapshot;
}

void Mapper::ApplyCalibration(KeyframeId newest) {
  atlas_.ChangeAll([this](SubMap* submap) {
    calibration_.ChangeMap(&submap->map);
    submap->axes.Reset();
    // The calibration of earlier sessions is kept.
    const bool is_of_earlier_session =
        !submap->map.keyframes().empty() &&
        submap->map.IsOfEarlierSession(submap->map.keyframes().back().first);
    if (is_of_earlier_session) return;
    submap->noise = NoiseEstimator(options_.noise);
    submap->planes.RemoveKeyframesOfThisRun(submap->map);
  });
  SubMap& submap = atlas_.current();
  optimizer_.OptimizeMap(newest, &submap);
  // A wrong calibration hides the observations that contradict it.
  FuseAllLandmarks(options_.fusion, &submap.map);
  optimizer_.OptimizeMap(newest, &submap);
}

}  // namespace msc_vo
