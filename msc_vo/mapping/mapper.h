// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "msc_vo/map/snapshot.h"
#include "msc_vo/mapping/keyframe_packet.h"
#include "msc_vo/mapping/mapper_options.h"
#include "msc_vo/mapping/window_observer.h"
#include "msc_vo/self_calibration/readout_time_estimator.h"

namespace msc_vo {

// Milliseconds per stage of one keyframe step.
struct MappingTimes {
  double structure = 0.0;  // of the keyframe's lines
  double creation = 0.0;   // the keyframe with its matches, and new landmarks; bad ones removed
  double fusion = 0.0;
  double axes = 0.0;
  std::optional<double> window;  // selected, solved and written back; none if it was not due
  double readout = 0.0;          // its time learnt
  double culling = 0.0;          // of keyframes
};

// What was done with one keyframe.
struct MappingSummary {
  KeyframeId keyframe = kNoId;
  int num_culled_keyframes = 0;
  std::optional<BundleAdjustmentSummary> window;  // none if it was not optimised
  MappingTimes times;
};

// Owns the map and alone changes it (paper: Local Mapping).
class Mapper {
 public:
  // Throws std::invalid_argument on options that are not valid.
  explicit Mapper(const MapperOptions& options);

  void SetWindowObserver(WindowObserver observer) { window_observer_ = std::move(observer); }

  // A keyframe is worked on in two steps. Insert() takes it into the map: observations, new
  // landmarks, fusion. Frames can be tracked against them from then on. Refine(), with the same
  // packet and what Insert() returned, makes all agree: axes, window optimisation if one is due,
  // culling of keyframes. It takes several times as long.
  MappingSummary Insert(const KeyframePacket& packet);
  void Refine(const KeyframePacket& packet, MappingSummary* summary);
  // Both.
  MappingSummary Process(const KeyframePacket& packet);

  // The map as the last step left it.
  MapSnapshotPtr Snapshot();

  const Map& map() const { return map_; }
  const SceneAxes& axes() const { return axes_; }
  const NoiseEstimator& noise() const { return noise_; }
  const ReadoutTimeEstimator& readout() const { return readout_; }
  // Lines that took part in the last window.
  const std::set<LandmarkId>& last_window_lines() const { return last_window_lines_; }

 private:
  KeyframeId InsertKeyframe(const KeyframePacket& packet, std::shared_ptr<const Frame> frame);
  // None if there is nothing to optimise.
  std::optional<BundleAdjustmentSummary> OptimizeWindow(KeyframeId keyframe);

  MapperOptions options_;
  WindowObserver window_observer_;  // may be empty
  Map map_;
  Probation probation_;
  SceneAxes axes_;
  NoiseEstimator noise_;
  ReadoutTimeEstimator readout_;
  double readout_time_ = 0.0;  // that the keyframes of the map are unrolled with, seconds
  KeyframeId newest_keyframe_ = kNoId;
  double last_window_time_ = -std::numeric_limits<double>::infinity();  // seconds, of its keyframe
  std::set<LandmarkId> last_window_lines_;
};

}  // namespace msc_vo
