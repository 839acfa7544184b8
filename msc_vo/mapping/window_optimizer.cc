// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/window_optimizer.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "msc_vo/map/window_selection.h"
#include "msc_vo/mapping/false_depths.h"

namespace msc_vo {

namespace {

// Iterations of both rounds of bundle adjustment after a change of the calibration.
constexpr int kCalibrationIterations = 10;

}  // namespace

void WindowOptimizer::BeginMap() {
  last_time_ = -std::numeric_limits<double>::infinity();
  last_lines_.clear();
}

// The absolute value lets an interval of 0 mean every keyframe even if time stamps do not ascend.
bool WindowOptimizer::IsDue(double timestamp) const {
  return std::abs(timestamp - last_time_) >= options_.min_window_interval;
}

std::unique_ptr<WindowTask> WindowOptimizer::BeginWindow(KeyframeId keyframe, bool use_planes,
                                                         SubMap* submap) {
  if (!IsDue(submap->map.FindKeyframe(keyframe)->frame->timestamp)) return nullptr;
  const bool has_other_links = factor_callback_ || (use_planes && !submap->planes.empty());
  const WindowLinks links =
      has_other_links ? WindowLinks::kLandmarksAndTime : WindowLinks::kLandmarks;
  return Begin(options_.window, keyframe,
               SelectWindow(options_.selection, submap->map, keyframe, links), use_planes, submap);
}

BundleAdjustmentSummary WindowOptimizer::EndWindow(KeyframeId keyframe, const WindowTask& task,
                                                   SubMap* submap) {
  WriteResult(task, submap);
  if (task.solve_.summary().usable) {
    FindFalseDepths(task.window_, keyframe, submap->noise.scale(), &submap->map);
  }
  last_time_ = submap->map.FindKeyframe(keyframe)->frame->timestamp;
  return task.solve_.summary();
}

void WindowOptimizer::OptimizeMap(KeyframeId keyframe, SubMap* submap) {
  BundleAdjustmentOptions options = options_.window;
  options.first_iterations = kCalibrationIterations;
  options.second_iterations = kCalibrationIterations;
  const std::unique_ptr<WindowTask> task =
      Begin(options, keyframe, SelectSession(options_.selection, submap->map), false, submap);
  if (task == nullptr) return;
  while (task->Advance()) continue;
  WriteResult(*task, submap);
}

std::unique_ptr<WindowTask> WindowOptimizer::Begin(const BundleAdjustmentOptions& options,
                                                   KeyframeId keyframe, WindowData window,
                                                   bool use_planes, SubMap* submap) {
  last_lines_.clear();
  for (const WindowData::Line& line : window.lines) last_lines_.insert(line.id);
  if (window.keyframes.size() < 2) return nullptr;
  submap->noise.Apply(&window);
  submap->axes.AddAlignments(&window);
  const PairCandidates pairs = pairs_.Find(window);
  pairs_.Learn(pairs);
  pairs_.Add(pairs, &window);
  if (factor_callback_) AddCustomFactors(*submap, &window);
  const bool has_planes = use_planes && !submap->planes.empty();
  if (factor_callback_ || has_planes) FixGaugeOfUnlinkedKeyframes(submap->map, &window);
  if (has_planes) submap->planes.AddTo(submap->map, &window);  // links no keyframes
  if (observer_) observer_(keyframe, options, window);
  return std::unique_ptr<WindowTask>(new WindowTask(options, std::move(window)));
}

void WindowOptimizer::WriteResult(const WindowTask& task, SubMap* submap) {
  if (!task.solve_.summary().usable) return;
  const WindowData& window = task.window_;
  submap->noise.Update(WindowResiduals(window));
  WriteBack(window, &submap->map);
  submap->axes.Learn(submap->map, window);
  submap->planes.Learn(submap->map, window);
  for (const ExtraBlock& block : window.extra_blocks) {
    if (block.id >= PlaneMap::kFirstBlock) extra_blocks_[block.id] = block;
  }
}

std::vector<ExtraBlock> WindowOptimizer::extra_blocks() const {
  std::vector<ExtraBlock> blocks;
  for (const auto& [id, block] : extra_blocks_) blocks.push_back(block);
  return blocks;
}

void WindowOptimizer::AddCustomFactors(const SubMap& submap, WindowData* window) const {
  const AxesEstimator& axes = submap.axes.estimator();
  if (axes.state() != AxesState::kNone) window->axes = {axes.world_from_axes(), true};
  WindowContext context = MakeWindowContext(submap.map, *window, extra_blocks());
  context.world = submap.id;
  WindowFactors custom = factor_callback_(context);
  for (ExtraBlock& block : custom.extra_blocks) {
    if (block.id < PlaneMap::kFirstBlock) {
      throw std::invalid_argument("extra block " + std::to_string(block.id) +
                                  ": ids below -2^62 are those of planes");
    }
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
}

}  // namespace msc_vo
