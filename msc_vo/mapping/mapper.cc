// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/mapper.h"

#include <cassert>
#include <stdexcept>
#include <string>

#include "msc_vo/map/map_validation.h"
#include "msc_vo/self_calibration/keyframe_rolling_shutter.h"
#include "msc_vo/structure/keyframe_structure.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

const MapperOptions& Validated(const MapperOptions& options) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
  return options;
}

void DescribeAxes(const AxesEstimator& axes, MappingSummary* summary) {
  summary->axes_state = axes.state();
  summary->num_axes_refinements = axes.num_refinements();
}

}  // namespace

Mapper::Mapper(const MapperOptions& options)
    : options_(Validated(options)),
      atlas_(options.axes, options.noise),
      calibration_(options.readout_time),
      care_(options.culling, options.fusion),
      optimizer_(options) {}

InsertedKeyframe Mapper::Insert(const KeyframePacket& packet) {
  InsertedKeyframe inserted(packet);
  MappingSummary& summary = inserted.summary_;
  SubMap& submap = atlas_.current();
  std::shared_ptr<const Frame> frame = Timed(&summary.times.creation, [&] {
    if (packet.last_velocity) {
      SetKeyframeVelocity(inserter_.newest(), *packet.last_velocity, &submap.map);
    }
    if (packet.begins_map) BeginMap(packet);
    calibration_.CompensateMap(&submap.map);
    return calibration_.BringUpToDate(packet);
  });
  if (options_.frame_structure) {
    frame = Timed(&summary.times.structure, [&] {
      return RefineStructure(options_.structure, submap.noise.scale(), options_.MapHasStructure(),
                             frame);
    });
  }
  Timed(&summary.times.creation, [&] {
    inserter_.Insert(packet, frame, &atlas_, &summary);
    care_.Renew(summary.keyframe, &submap.map);
  });
  Timed(&summary.times.fusion, [&] { care_.Fuse(summary.keyframe, &submap.map); });
  DescribeAxes(submap.axes.estimator(), &summary);
  assert(FirstViolation(map()).empty());
  return inserted;
}

MappingSummary Mapper::Refine(InsertedKeyframe inserted) {
  const KeyframePacket& packet = *inserted.packet_;
  MappingSummary& summary = inserted.summary_;
  SubMap& submap = atlas_.current();
  Timed(&summary.times.axes,
        [&] { submap.axes.Update(submap.map, summary.keyframe, packet.normals); });
  DescribeAxes(submap.axes.estimator(), &summary);
  double window_ms = 0.0;
  summary.window =
      Timed(&window_ms, [&] { return optimizer_.OptimizeWindow(summary.keyframe, &submap); });
  if (summary.window) summary.times.window = window_ms;
  Timed(&summary.times.readout,
        [&] { calibration_.UpdateReadoutTime(packet, submap.map, summary.keyframe); });
  Timed(&summary.times.calibration, [&] {
    if (!calibration_.UpdateIntrinsics(packet, submap.map, summary.keyframe)) return;
    summary.calibration = std::make_shared<CalibrationChange>(
        CalibrationChange{calibration_.intrinsics()->estimate(), atlas_.ShareAll()});
    ApplyCalibration(summary.keyframe);
  });
  summary.num_culled_keyframes = Timed(
      &summary.times.culling, [&] { return care_.CullKeyframes(summary.keyframe, &submap.map); });
  assert(FirstViolation(map()).empty());
  return std::move(summary);
}

void Mapper::BeginMap(const KeyframePacket& packet) {
  inserter_.BeginMap(packet, &atlas_);
  care_.BeginMap();
  optimizer_.BeginMap();
}

MapSnapshotPtr Mapper::Snapshot() {
  SubMap& submap = atlas_.current();
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->map = submap.map.Share();
  snapshot->world = submap.id;
  snapshot->inactive_maps = atlas_.inactive_maps();
  snapshot->newest_keyframe = inserter_.newest();
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
    submap->axes = SceneAxes(options_.axes);
    submap->noise = NoiseEstimator(options_.noise);
  });
  SubMap& submap = atlas_.current();
  optimizer_.OptimizeMap(newest, &submap);
  // A wrong calibration hides the observations that contradict it.
  care_.FuseAll(&submap.map);
  optimizer_.OptimizeMap(newest, &submap);
}

}  // namespace msc_vo
