// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "msc_vo/map/atlas.h"
#include "msc_vo/map/snapshot.h"
#include "msc_vo/mapping/keyframe_packet.h"
#include "msc_vo/mapping/map_joiner.h"
#include "msc_vo/mapping/map_lines.h"
#include "msc_vo/mapping/mapper_options.h"
#include "msc_vo/mapping/window_factors.h"
#include "msc_vo/mapping/window_observer.h"
#include "msc_vo/self_calibration/calibration_estimator.h"
#include "msc_vo/self_calibration/readout_time_estimator.h"

namespace msc_vo {

/// Time of each stage of one keyframe step, milliseconds.
struct MappingTimes {
  double structure = 0.0;  ///< refinement of the keyframe's lines
  double creation = 0.0;   ///< insertion of the keyframe, landmark culling and creation
  double fusion = 0.0;
  double axes = 0.0;
  std::optional<double> window;  ///< local bundle adjustment; none if it was not due
  double readout = 0.0;          ///< estimation of the readout time
  double calibration = 0.0;      ///< estimation of the calibration
  double culling = 0.0;          ///< keyframe culling

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, structure, creation, fusion, axes, window, readout, calibration, culling);
  }
};

/// A corrected calibration that the maps were brought up to date with.
struct CalibrationChange {
  CorrectionEstimate estimate;
  InactiveMaps maps_before;  ///< all maps, with the old poses

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, estimate, maps_before);
  }
};

/// Result of one keyframe step.
struct MappingSummary {
  KeyframeId keyframe = kNoId;
  int num_culled_keyframes = 0;
  std::optional<BundleAdjustmentSummary> window;  ///< none if no bundle adjustment was due
  AxesState axes_state = AxesState::kNone;        ///< after the step
  int num_axes_refinements = 0;                   ///< in the run so far
  std::optional<MapJoin> join;  ///< the map was joined with that of an older segment
  int num_refused_joins = 0;    ///< in the run so far (MapJoiner::num_refused)
  std::shared_ptr<const CalibrationChange> calibration;  ///< null: it was not changed
  MappingTimes times;

  template <typename Archive>
  void Serialize(Archive& archive) {
    archive.Fields(*this, keyframe, num_culled_keyframes, window, axes_state, num_axes_refinements,
                   join, num_refused_joins, calibration, times);
  }
};

/// Returns the frame with other intrinsics, and its depths measured again in its image, registered
/// as these say. Called on the thread of the mapper.
using DepthMeasurement = std::function<std::shared_ptr<const Frame>(
    const Frame& frame, const RecordedImage& image,
    const std::shared_ptr<const CameraIntrinsics>& intrinsics)>;

/// Local mapping (paper): owns the maps of all segments and is the only one to change them. Works
/// on the current one.
class Mapper {
 public:
  /// Throws std::invalid_argument on options that are not valid.
  explicit Mapper(const MapperOptions& options);

  void SetWindowObserver(WindowObserver observer) { window_observer_ = std::move(observer); }
  /// Sets the source of custom factors. Windows then also contain the keyframe before each of their
  /// keyframes, if landmarks hardly link the two: a factor may be the only link between them.
  /// A factor that LocalBundleAdjustment rejects, and an extra block whose size differs from that
  /// of its estimate, throw std::invalid_argument that names it.
  void SetWindowFactors(WindowFactorCallback callback) {
    window_factor_callback_ = std::move(callback);
  }

  /// Estimates the calibration from now on, beginning with the one of the frames. Call it before
  /// the first keyframe.
  void BeginSelfCalibration(const std::shared_ptr<const CameraIntrinsics>& given,
                            DepthMeasurement measure_depth) {
    calibration_.emplace(given);
    measure_depth_ = std::move(measure_depth);
  }

  /// A keyframe is processed in two steps. Insert() adds it to the map with its observations and
  /// new landmarks and fuses duplicates; frames can be tracked against them from then on. Refine(),
  /// called with the same packet and the summary that Insert() returned, updates the Manhattan
  /// axes, runs local bundle adjustment if it is due, and culls keyframes; it takes several times
  /// as long.
  MappingSummary Insert(const KeyframePacket& packet);
  void Refine(const KeyframePacket& packet, MappingSummary* summary);
  /// Insert() and Refine().
  MappingSummary Process(const KeyframePacket& packet);

  /// The map after the last step.
  MapSnapshotPtr Snapshot();

  const Atlas& atlas() const { return atlas_; }
  const Map& map() const { return atlas_.current(); }
  const SceneAxes& axes() const { return axes_; }
  /// The axes of a map of the atlas.
  const SceneAxes& AxesOf(const Map& map) const;
  /// The lines of a map of the atlas, refined at the end of a run (RefineMapLines).
  std::map<LandmarkId, RefinedLine> RefinedLines(const Map& map) const;
  const NoiseEstimator& noise() const { return noise_; }
  const ReadoutTimeEstimator& readout() const { return readout_; }
  /// None before BeginSelfCalibration().
  const std::optional<CalibrationEstimator>& calibration() const { return calibration_; }
  /// Values of all extra blocks that usable windows have estimated, in order of their ids.
  std::vector<ExtraBlock> extra_blocks() const;
  /// Lines of the last local bundle adjustment.
  const std::set<LandmarkId>& last_window_lines() const { return last_window_lines_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, window_observer, window_factors, extra, maps, joiner, probation, scene_axes,
           pairs, inactive_axes, noise_estimator, readout_estimator, calibration_estimator,
           depth_measurement, readout_time, newest_keyframe, last_window_time, last_lines] =
        *this;  // all members, or it does not compile
    archive.Entries(inactive_axes, SceneAxes(options.axes));
    archive(extra, maps, joiner, probation, scene_axes, pairs, noise_estimator, readout_estimator,
            readout_time, newest_keyframe, last_window_time, last_lines);
    if (calibration_estimator) archive(*calibration_estimator);  // as the options want it
  }

 private:
  // Begins a map for a new segment.
  void BeginMap(const KeyframePacket& packet);
  // Joins the current map with an inactive one if enough keyframes have been found in both.
  std::optional<MapJoin> JoinMaps();
  KeyframeId InsertKeyframe(const KeyframePacket& packet, std::shared_ptr<const Frame> frame);
  // The frame with the calibration in use. `image`: its image; may be null.
  std::shared_ptr<const Frame> Recalibrated(const std::shared_ptr<const Frame>& frame,
                                            const RecordedImage* image) const;
  // Updates the self-calibration, and brings the maps up to date with it.
  void Calibrate(const KeyframePacket& packet, MappingSummary* summary);
  // Bundle adjustment of all keyframes of the current map; the newest one is `keyframe`.
  void OptimizeMap(KeyframeId keyframe);
  // Adds the factors of the callback, the extra blocks and the axes that they may use.
  void AddCustomFactors(WindowData* window) const;
  // Returns std::nullopt if the window has a single keyframe.
  std::optional<BundleAdjustmentSummary> OptimizeWindow(KeyframeId keyframe);
  std::optional<BundleAdjustmentSummary> SolveWindow(const BundleAdjustmentOptions& options,
                                                     KeyframeId keyframe, WindowData window);

  MapperOptions options_;
  WindowObserver window_observer_;               // may be empty
  WindowFactorCallback window_factor_callback_;  // may be empty
  std::map<int64_t, ExtraBlock> extra_blocks_;   // by id; as estimated by the last window
  Atlas atlas_;
  MapJoiner joiner_;
  Probation probation_;
  SceneAxes axes_;  // of the current map
  StructuralPairs pairs_;
  std::map<KeyframeId, SceneAxes> inactive_axes_;  // of inactive maps, by first keyframe
  NoiseEstimator noise_;
  ReadoutTimeEstimator readout_;
  std::optional<CalibrationEstimator> calibration_;
  DepthMeasurement measure_depth_;  // with a calibration
  double readout_time_ = 0.0;       // seconds, of the compensation of the map's keyframes
  KeyframeId newest_keyframe_ = kNoId;
  double last_window_time_ = -std::numeric_limits<double>::infinity();  // seconds, of its keyframe
  std::set<LandmarkId> last_window_lines_;
};

}  // namespace msc_vo
