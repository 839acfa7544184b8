// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "msc_vo/bundle_adjustment/stepwise_bundle_adjustment.h"
#include "msc_vo/mapping/map_lines.h"
#include "msc_vo/mapping/mapper_options.h"
#include "msc_vo/mapping/submap.h"
#include "msc_vo/mapping/window_factors.h"
#include "msc_vo/mapping/window_observer.h"

namespace msc_vo {

/// A window whose bundle adjustment has begun.
class WindowTask {
 public:
  /// Runs the next slice of the solver. Returns whether slices are left.
  bool Advance() { return solve_.Advance(); }

 private:
  friend class WindowOptimizer;
  WindowTask(const BundleAdjustmentOptions& options, WindowData window)
      : window_(std::move(window)), solve_(options, &window_) {}

  WindowData window_;
  StepwiseBundleAdjustment solve_;
};

/// Local bundle adjustment of a submap: selects a sliding window of keyframes, adds structural
/// pairs, axis alignments and the factors of the caller, solves it, and writes the result back.
class WindowOptimizer {
 public:
  explicit WindowOptimizer(const MapperOptions& options)
      : options_(options), pairs_(options.pairs) {}

  void SetObserver(WindowObserver observer) { observer_ = std::move(observer); }
  void SetFactors(WindowFactorCallback callback) { factor_callback_ = std::move(callback); }

  /// Another submap begins.
  void BeginMap();

  /// Begins to optimise the window around `keyframe`, the newest one, if it is due. nullptr if it
  /// is not, or has a single keyframe. The submap must not change until EndWindow().
  /// `use_planes`: with the factors of its planes.
  std::unique_ptr<WindowTask> BeginWindow(KeyframeId keyframe, bool use_planes, SubMap* submap);
  /// Writes the result of all slices back, and finds the landmarks with false depths.
  BundleAdjustmentSummary EndWindow(KeyframeId keyframe, const WindowTask& task, SubMap* submap);
  /// Bundle adjustment of all keyframes of a submap after a change of its calibration; the newest
  /// one is `keyframe`.
  void OptimizeMap(KeyframeId keyframe, SubMap* submap);

  /// The lines of a submap, refined at the end of a run (RefineMapLines).
  std::map<LandmarkId, RefinedLine> RefinedLines(const SubMap& submap) const {
    return RefineMapLines(options_, submap, pairs_);
  }
  /// Values of all extra blocks that usable windows have estimated, in order of their ids.
  std::vector<ExtraBlock> extra_blocks() const;
  /// Lines of the last window.
  const std::set<LandmarkId>& last_lines() const { return last_lines_; }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [options, observer, factors, structural_pairs, extra, last_time, lines] =
        *this;  // all members, or it does not compile
    archive(structural_pairs, extra, last_time, lines);
  }

 private:
  bool IsDue(double timestamp) const;
  // nullptr if the window has a single keyframe.
  std::unique_ptr<WindowTask> Begin(const BundleAdjustmentOptions& options, KeyframeId keyframe,
                                    WindowData window, bool use_planes, SubMap* submap);
  void WriteResult(const WindowTask& task, SubMap* submap);
  // Adds the factors of the callback, the extra blocks and the axes that they may use.
  void AddCustomFactors(const SubMap& submap, WindowData* window) const;

  MapperOptions options_;
  WindowObserver observer_;               // may be empty
  WindowFactorCallback factor_callback_;  // may be empty
  StructuralPairs pairs_;
  std::map<int64_t, ExtraBlock> extra_blocks_;  // by id; as estimated by the last window
  double last_time_ = -std::numeric_limits<double>::infinity();  // seconds, of the last window
  std::set<LandmarkId> last_lines_;
};

}  // namespace msc_vo
