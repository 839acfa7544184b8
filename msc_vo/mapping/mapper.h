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
#include "msc_vo/mapping/culling.h"
#include "msc_vo/mapping/keyframe_inserter.h"
#include "msc_vo/mapping/keyframe_packet.h"
#include "msc_vo/mapping/loop_closer.h"
#include "msc_vo/mapping/map_calibration.h"
#include "msc_vo/mapping/mapper_options.h"
#include "msc_vo/mapping/mapping_summary.h"
#include "msc_vo/mapping/window_optimizer.h"

namespace msc_vo {

/// Stages of the mapper's work on a keyframe, in their order. Those up to kFusion insert it: they
/// add it to the map with its observations and new landmarks, against which frames can be tracked
/// from then on. The others refine the map with it and take several times as long.
enum class MappingStage {
  kStructure,  ///< the frame is brought up to date, and its lines refine each other
  kCreation,   ///< insertion, landmark culling and creation
  kFusion,
  kLoop,  ///< the loop that it completes is closed
  kAxes,
  kWindow,  ///< selection of the window and callbacks of the caller
  kSolve,   ///< local bundle adjustment, in several slices
  kReadout,
  kCalibration,
  kCulling,
  kDone,
};
constexpr int kNumMappingStages = static_cast<int>(MappingStage::kDone);

/// The mapper's work on one keyframe. Mapper::Advance() runs its slices.
class KeyframeTask {
 public:
  explicit KeyframeTask(KeyframePacket packet) : packet_(std::move(packet)) {}

  MappingStage stage() const { return stage_; }  ///< of the next slice
  bool IsInserted() const { return stage_ >= MappingStage::kLoop; }
  bool IsDone() const { return stage_ == MappingStage::kDone; }
  const MappingSummary& summary() const { return summary_; }

 private:
  friend class Mapper;

  KeyframePacket packet_;
  MappingStage stage_ = MappingStage::kStructure;
  MappingSummary summary_;
  std::shared_ptr<const Frame> frame_;  // of the packet, up to date
  std::unique_ptr<WindowTask> window_;
};

/// Local mapping (paper): owns the submaps of all segments and is the only one to change them.
/// Works on the current one.
class Mapper {
 public:
  /// The options must be valid (OdometryOptions::IsValid).
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

  /// Begins with the submaps of earlier sessions (Atlas::BeginWith()), expressed in the camera of
  /// the frames to come. Call it before the first keyframe.
  void BeginWith(std::vector<SavedSubMap> submaps, const std::vector<PoseGraphEdge>& loops,
                 const PinholeCamera& camera);
  /// All submaps as they are.
  std::vector<SavedSubMap> ShareSubMaps() { return atlas_.ShareSubMaps(); }

  /// Runs the next slice of the work on a keyframe: a stage, apart from kSolve, which has a slice
  /// for each step of the solver. Work on the next keyframe begins when this one is done; a task
  /// whose slice has thrown is given up.
  void Advance(KeyframeTask* task);
  /// Runs all slices.
  MappingSummary Process(const KeyframePacket& packet);

  /// The map after the last step.
  MapSnapshotPtr Snapshot();

  const Atlas& atlas() const { return atlas_; }
  const Map& map() const { return atlas_.current().map; }
  const SceneAxes& axes() const { return atlas_.current().axes; }
  const NoiseEstimator& noise() const { return atlas_.current().noise; }
  const MapCalibration& calibration() const { return calibration_; }
  /// The measured poses of all closed loops, those of earlier sessions included.
  const std::vector<PoseGraphEdge>& loop_edges() const { return loops_.edges(); }
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
    auto& [options, submaps, calibration, inserter, loops, probation, optimizer] =
        *this;  // all members
    archive(calibration, inserter, loops, probation, optimizer, submaps);
  }

 private:
  // The stages. All but Solve() consist of one slice; that returns whether slices are left.
  void PrepareFrame(KeyframeTask* task);
  void Create(KeyframeTask* task);
  void Fuse(KeyframeTask* task);
  void CloseLoop(KeyframeTask* task);
  void UpdateAxes(KeyframeTask* task);
  void BeginWindow(KeyframeTask* task);
  bool Solve(KeyframeTask* task);
  void Calibrate(KeyframeTask* task);
  void Cull(KeyframeTask* task);

  void BeginMap(const KeyframePacket& packet);
  // Brings all submaps up to date with changed intrinsics; `newest` is the newest keyframe.
  void ApplyCalibration(KeyframeId newest);

  MapperOptions options_;
  Atlas atlas_;
  MapCalibration calibration_;
  KeyframeInserter inserter_;
  LoopCloser loops_;
  Probation probation_;  // of the current submap
  WindowOptimizer optimizer_;
};

}  // namespace msc_vo
