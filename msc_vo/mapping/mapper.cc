// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/mapper.h"

#include <cassert>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "msc_vo/frame/frame_intrinsics.h"
#include "msc_vo/map/map_validation.h"
#include "msc_vo/mapping/landmark_creation.h"
#include "msc_vo/mapping/map_lines.h"
#include "msc_vo/self_calibration/keyframe_intrinsics.h"
#include "msc_vo/self_calibration/keyframe_rolling_shutter.h"
#include "msc_vo/structure/keyframe_structure.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

namespace {

// Iterations of both rounds of bundle adjustment after a change of the calibration.
constexpr int kCalibrationIterations = 10;

void DescribeAxes(const AxesEstimator& axes, MappingSummary* summary) {
  summary->axes_state = axes.state();
  summary->num_axes_refinements = axes.num_refinements();
}

}  // namespace

Mapper::Mapper(const MapperOptions& options)
    : options_(options),
      joiner_(options.joining),
      axes_(options.axes),
      pairs_(options.pairs),
      noise_(options.noise),
      readout_(options.readout_time) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument(error);
}

MappingSummary Mapper::Insert(const KeyframePacket& packet) {
  MappingSummary summary;
  Stopwatch stopwatch;
  if (packet.last_velocity) {
    SetKeyframeVelocity(newest_keyframe_, *packet.last_velocity, &atlas_.current());
  }
  if (packet.begins_map) BeginMap(packet);
  readout_time_ = readout_.readout_time();
  CompensateKeyframes(readout_time_, &atlas_.current());
  std::shared_ptr<const Frame> frame = packet.frame;
  if (calibration_) frame = Recalibrated(frame, packet.image.get());
  frame = UpdateCompensation(frame, readout_time_);
  summary.times.creation = stopwatch.Restart();
  if (options_.frame_structure) {
    frame = RefineStructure(options_.structure, noise_.scale(), options_.MapHasStructure(), frame);
  }
  summary.times.structure = stopwatch.Restart();
  summary.keyframe = InsertKeyframe(packet, std::move(frame));
  if (packet.in_inactive_map) {
    joiner_.Add(summary.keyframe, packet.covariance, *packet.in_inactive_map);
    summary.join = JoinMaps();
  }
  summary.num_refused_joins = joiner_.num_refused();
  CullLandmarks(options_.culling, summary.keyframe, &probation_, &atlas_.current());
  CreatePoints(summary.keyframe, &probation_, &atlas_.current());
  CreateLines(summary.keyframe, &probation_, &atlas_.current());
  summary.times.creation += stopwatch.Restart();
  FusePoints(options_.fusion, summary.keyframe, &atlas_.current());
  FuseLines(options_.fusion, summary.keyframe, &atlas_.current());
  summary.times.fusion = stopwatch.Restart();
  DescribeAxes(axes_.estimator(), &summary);
  assert(FirstViolation(map()).empty());
  return summary;
}

void Mapper::Refine(const KeyframePacket& packet, MappingSummary* summary) {
  Stopwatch stopwatch;
  axes_.Update(map(), summary->keyframe, packet.normals);
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
  readout_.Update(map(), summary->keyframe, packet.frame_interval);
  summary->times.readout = stopwatch.Restart();
  Calibrate(packet, summary);
  summary->times.calibration = stopwatch.Restart();
  summary->num_culled_keyframes =
      CullKeyframes(options_.culling, summary->keyframe, &atlas_.current());
  summary->times.culling = stopwatch.Restart();
  assert(FirstViolation(map()).empty());
}

MappingSummary Mapper::Process(const KeyframePacket& packet) {
  MappingSummary summary = Insert(packet);
  Refine(packet, &summary);
  return summary;
}

void Mapper::BeginMap(const KeyframePacket& packet) {
  if (packet.keeps_last_map && !map().keyframes().empty()) {
    inactive_axes_.emplace(map().keyframes().front().first, axes_);
    if (packet.last_tracked) joiner_.AddLastPose(*packet.last_tracked);
  }
  atlas_.Begin(packet.keeps_last_map);
  joiner_.Clear();
  probation_ = {};
  axes_ = SceneAxes(options_.axes);
  newest_keyframe_ = kNoId;
  last_window_time_ = -std::numeric_limits<double>::infinity();
  last_window_lines_.clear();
}

std::optional<MapJoin> Mapper::JoinMaps() {
  const KeyframeId current = map().keyframes().front().first;
  std::optional<MapJoin> join = joiner_.TryJoin(&atlas_);
  if (!join) return std::nullopt;
  // Axes of the other world are searched again rather than turned: the joined map has more lines.
  const auto inactive = inactive_axes_.find(join->kept == current ? join->moved : join->kept);
  if (join->kept != current) axes_ = inactive->second;
  inactive_axes_.erase(inactive);
  return join;
}

const SceneAxes& Mapper::AxesOf(const Map& map) const {
  if (map.keyframes().empty()) return axes_;
  const auto inactive = inactive_axes_.find(map.keyframes().front().first);
  return inactive == inactive_axes_.end() ? axes_ : inactive->second;
}

MapSnapshotPtr Mapper::Snapshot() {
  auto snapshot = std::make_shared<MapSnapshot>();
  snapshot->map = atlas_.current().Share();
  snapshot->inactive_maps = atlas_.inactive();
  snapshot->newest_keyframe = newest_keyframe_;
  snapshot->noise_scale = noise_.scale();
  snapshot->readout_time = readout_time_;
  if (calibration_) {
    snapshot->intrinsics = calibration_->present();
    snapshot->calibration_is_settled = calibration_->IsSettled();
  }
  snapshot->axes = axes_.Estimate();
  snapshot->needs_axes = options_.axes.enabled && !snapshot->axes;
  return snapshot;
}

KeyframeId Mapper::InsertKeyframe(const KeyframePacket& packet,
                                  std::shared_ptr<const Frame> frame) {
  Rigid3 cam_from_world = packet.cam_from_reference;
  if (packet.reference != kNoId) {
    cam_from_world = cam_from_world * map().CamFromWorld(packet.reference);
  }
  newest_keyframe_ = atlas_.current().AddKeyframe(std::move(frame), cam_from_world);
  for (const PointMatch& match : packet.matches.points) {
    atlas_.current().ObservePoint(match.id, newest_keyframe_, match.feature);
  }
  for (const LineMatch& match : packet.matches.lines) {
    atlas_.current().ObserveLine(match.id, newest_keyframe_, match.feature);
  }
  for (const auto& [id, count] : packet.point_counts) {
    atlas_.current().CountPointTracking(id, count.num_visible, count.num_found);
  }
  for (const auto& [id, count] : packet.line_counts) {
    atlas_.current().CountLineTracking(id, count.num_visible, count.num_found);
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
  WindowFactors custom = window_factor_callback_(MakeWindowContext(map(), *window, extra_blocks()));
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

std::shared_ptr<const Frame> Mapper::Recalibrated(const std::shared_ptr<const Frame>& frame,
                                                  const RecordedImage* image) const {
  const std::shared_ptr<const CameraIntrinsics>& present = calibration_->present();
  const bool has_old_depths =
      frame->intrinsics && !HasSameRegistration(*frame->intrinsics, *present);
  return has_old_depths && image != nullptr ? measure_depth_(*frame, *image, present)
                                            : ChangeIntrinsics(frame, present);
}

void Mapper::Calibrate(const KeyframePacket& packet, MappingSummary* summary) {
  if (!calibration_ || (packet.image == nullptr && !calibration_->IsSettled())) return;
  calibration_->SetReadoutTime(readout_time_);
  if (!calibration_->Update(map(), summary->keyframe, packet.image, packet.calibration_images,
                            readout_.sigma())) {
    return;
  }
  summary->calibration = std::make_shared<CalibrationChange>(
      CalibrationChange{calibration_->estimate(), atlas_.ShareAll()});
  const KeyframeUpdate update = [&](KeyframeId id, const std::shared_ptr<const Frame>& frame) {
    return Recalibrated(frame, calibration_->FindImage(id).get());
  };
  atlas_.ChangeAll([&](Map* map) { ChangeKeyframeIntrinsics(update, map); });
  noise_ = NoiseEstimator(options_.noise);
  axes_ = SceneAxes(options_.axes);
  for (auto& [first, axes] : inactive_axes_) axes = axes_;
  OptimizeMap(summary->keyframe);
  // A wrong calibration hides the observations that contradict it.
  FuseLandmarks(options_.fusion, &atlas_.current());
  OptimizeMap(summary->keyframe);
}

void Mapper::OptimizeMap(KeyframeId keyframe) {
  BundleAdjustmentOptions options = options_.window;
  options.first_iterations = kCalibrationIterations;
  options.second_iterations = kCalibrationIterations;
  SolveWindow(options, keyframe, SelectWholeMap(options_.selection, map()));
}

std::map<LandmarkId, RefinedLine> Mapper::RefinedLines(const Map& map) const {
  return RefineMapLines(options_, map, AxesOf(map), pairs_, noise_);
}

std::optional<BundleAdjustmentSummary> Mapper::OptimizeWindow(KeyframeId keyframe) {
  const WindowLinks links =
      window_factor_callback_ ? WindowLinks::kLandmarksAndTime : WindowLinks::kLandmarks;
  return SolveWindow(options_.window, keyframe,
                     SelectWindow(options_.selection, map(), keyframe, links));
}

std::optional<BundleAdjustmentSummary> Mapper::SolveWindow(const BundleAdjustmentOptions& options,
                                                           KeyframeId keyframe, WindowData window) {
  last_window_lines_.clear();
  for (const WindowData::Line& line : window.lines) last_window_lines_.insert(line.id);
  if (window.keyframes.size() < 2) return std::nullopt;
  noise_.Apply(&window);
  axes_.AddAlignments(&window);
  pairs_.Add(&window);
  AddCustomFactors(&window);
  if (window_observer_) window_observer_(keyframe, options, window);
  const BundleAdjustmentSummary summary = LocalBundleAdjustment(options, &window);
  if (summary.usable) {
    noise_.Update(WindowResiduals(window));
    WriteBack(window, &atlas_.current());
    axes_.Learn(map(), window);
    for (const ExtraBlock& block : window.extra_blocks) extra_blocks_[block.id] = block;
  }
  return summary;
}

}  // namespace msc_vo
