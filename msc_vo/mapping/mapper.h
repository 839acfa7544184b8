// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/mapping/atlas.h"
#include "msc_vo/mapping/keyframe_inserter.h"
#include "msc_vo/mapping/keyframe_packet.h"
#include "msc_vo/mapping/landmark_care.h"
#include "msc_vo/mapping/map_calibration.h"
#include "msc_vo/mapping/mapper_options.h"
#include "msc_vo/mapping/mapping_summary.h"
#include "msc_vo/mapping/window_optimizer.h"

namespace msc_vo {

/// A keyframe that is in the map and waits for its optimisation. Only Mapper::Insert() makes one.
class InsertedKeyframe {
 public:
  InsertedKeyframe(InsertedKeyframe&&) = default;
  const MappingSummary& summary() const { return summary_; }

 private:
  friend class Mapper;
  explicit InsertedKeyframe(const KeyframePacket& packet) : packet_(&packet) {}

  const KeyframePacket* packet_;
  MappingSummary summary_;
};

/// Local mapping (paper): owns the submaps of all segments and is the only one to change them.
/// Works on the current one.
class Mapper {
 public:
  /// Throws std::invalid_argument on options that are not valid.
  explicit Mapper(const MapperOptions& options);

  void SetWindowObserver(WindowObserver observer) { optimizer_.SetObserver(std::move(observer)); }
  /// Sets the source of custom factors. Windows then also contain the keyframe before each of their
  /// keyframes, if landmarks hardly link the two: a factor may be the only link between them.
  /// A factor that LocalBundleAdjustment rejects, and an extra block whose size differs from that
  /// of its estimate, throw std::invalid_argument that names it.
  void SetWindowFactors(WindowFactorCallback callback) {
    optimizer_.SetFactors(std::move(callback));
  }

  /// Estimates the calibration from now on, beginning with the one of the frames. Call it before
  /// the first keyframe.
  void BeginSelfCalibration(const std::shared_ptr<const CameraIntrinsics>& given,
                            DepthMeasurement measure_depth) {
    calibration_.Begin(given, std::move(measure_depth));
  }

  /// A keyframe is processed in two steps. Insert() adds it to the map with its observations and
  /// new landmarks and fuses duplicates; frames can be tracked against them from then on. Refine()
  /// updates the Manhattan axes, runs local bundle adjustment if it is due, and culls keyframes; it
  /// takes several times as long. The packet must outlive both.
  InsertedKeyframe Insert(const KeyframePacket& packet);
  MappingSummary Refine(InsertedKeyframe inserted);
  /// Insert() and Refine().
  MappingSummary Process(const KeyframePacket& packet) { return Refine(Insert(packet)); }

  /// The map after the last step.
  MapSnapshotPtr Snapshot();

  const Atlas& atlas() const { return atlas_; }
  const Map& map() const { return atlas_.current().map; }
  const SceneAxes& axes() const { return atlas_.current().axes; }
  const NoiseEstimator& noise() const { return atlas_.current().noise; }
  const MapCalibration& calibration() const { return calibration_; }
  /// The lines of a submap, refined at the end of a run (RefineMapLines).
  std::map<LandmarkId, RefinedLine> RefinedLines(const SubMap& submap) const {
    return optimizer_.RefinedLines(submap);
  }
  /// Values of all extra blocks that usable windows have estimated, in order of their ids.
  std::vector<ExtraBlock> extra_blocks() const { return optimizer_.extra_blocks(); }
  /// Lines of the last local bundle adjustment.
  const std::set<LandmarkId>& last_window_lines() const { return optimizer_.last_lines(); }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, submaps, calibration, inserter, care, optimizer] = *this;  // all members
    archive(submaps, calibration, inserter, care, optimizer);
  }

 private:
  void BeginMap(const KeyframePacket& packet);
  // Brings all submaps up to date with changed intrinsics; `newest` is the newest keyframe.
  void ApplyCalibration(KeyframeId newest);

  MapperOptions options_;
  Atlas atlas_;
  MapCalibration calibration_;
  KeyframeInserter inserter_;
  LandmarkCare care_;
  WindowOptimizer optimizer_;
};

}  // namespace msc_vo
