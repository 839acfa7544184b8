// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/features/image_statistics.h"
#include "msc_vo/mapping/mapper.h"
#include "msc_vo/odometry/depth_preparation.h"
#include "msc_vo/odometry/event_log.h"
#include "msc_vo/odometry/gap_filling.h"
#include "msc_vo/odometry/input_checks.h"
#include "msc_vo/odometry/map_result.h"
#include "msc_vo/odometry/mapping_runner.h"
#include "msc_vo/odometry/pose_correction.h"
#include "msc_vo/odometry/pose_refiner.h"
#include "msc_vo/odometry/segment_log.h"
#include "msc_vo/odometry/side_worker.h"
#include "msc_vo/odometry/snapshot_schedule.h"
#include "msc_vo/sensor/depth_camera_correction.h"
#include "msc_vo/sensor/standalone_image.h"
#include "msc_vo/timing/stopwatch.h"
#include "msc_vo/tracking/tracker.h"

namespace msc_vo {

namespace {

// Images between keyframes for self-calibration: least time after another or a keyframe, number.
constexpr double kCalibrationImageInterval = 0.115;
constexpr size_t kMaxCalibrationImages = 3;

// The ids are sorted, so that each insertion point is close to the previous one.
void CountVisible(const std::vector<LandmarkId>& ids, std::map<LandmarkId, TrackingCount>* counts) {
  auto place = counts->begin();
  for (const LandmarkId id : ids) {
    place = counts->try_emplace(place, id);
    ++place->second.num_visible;
  }
}

}  // namespace

struct Odometry::State {
  State(const OdometryOptions& options_in, const PinholeCamera& camera_in,
        const LensDistortion& distortion)
      : options(ValidatedOptions(options_in)),
        camera(ValidatedCamera(camera_in, distortion)),
        builder(options.features, camera, distortion),
        preparation(builder.intrinsics()),
        normal_estimator(std::in_place, NormalOptions(options), camera, distortion),
        tracker(options.tracking),
        mapper(options.mapping),
        refiner(options.tracking.pose, options.pose_refinement_delay),
        schedule(options.snapshots,
                 options.threads > 1 ? MakeThreadedRunner(&mapper) : MakeInlineRunner(&mapper),
                 mapper.Snapshot(),
                 [this](int frame, const MappingStep& step) { Record(frame, step); }) {
    if (options.mapping.self_calibration) {
      mapper.BeginSelfCalibration(builder.intrinsics(),
                                  preparation.MeasurementFor(options.features));
    }
    if (options.threads > 1) side_worker = std::make_unique<SideWorker>();
    log.LogStart(options, camera);
  }

  void CheckTime(int64_t id, double timestamp) const;
  RgbdImage Align(const RgbdImage& image) const;
  std::shared_ptr<const Frame> Build(const RgbdImage& image);
  void Count(const TrackedFrame& tracked);
  void BeginSegment(SegmentStart start);
  void DiscardSegment();
  // Whether self-calibration needs the images of this frame.
  bool NeedsImages() const {
    return options.mapping.self_calibration && !snapshot->calibration_is_settled;
  }
  void KeepForCalibration(const TrackedFrame& tracked, const RgbdImage& recorded);
  void SubmitKeyframe(const TrackedFrame& tracked, const RgbdImage& recorded, const cv::Mat& depth);
  void Record(int frame, const MappingStep& step);
  bool UseIntrinsics(const std::shared_ptr<const CameraIntrinsics>& intrinsics);

  // Everything that later results depend on, except what the options determine. The snapshot of the
  // last frame is not needed between two frames.
  template <typename Archive>
  void Serialize(Archive& archive) {
    std::shared_ptr<const CameraIntrinsics> intrinsics = builder.intrinsics();
    archive(intrinsics);
    UseIntrinsics(intrinsics);  // resets what is read next
    archive(preparation, builder, tracker, mapper, last_window, last_calibration_image_time, packet,
            results, relative_poses, refiner, segments, log, schedule);
  }

  OdometryOptions options;
  bool finds_clipped_depth = true;
  PinholeCamera camera;
  FrameBuilder builder;
  DepthPreparation preparation;
  std::optional<SurfaceNormalEstimator> normal_estimator;
  std::unique_ptr<SideWorker> side_worker;  // none with one thread
  Tracker tracker;
  TrackingObserver tracking_observer;  // may be empty
  Mapper mapper;
  MapSnapshotPtr snapshot;  // of the last frame
  BundleAdjustmentSummary last_window;
  double last_calibration_image_time = 0.0;
  KeyframePacket packet;  // accumulates counts until the next keyframe
  std::vector<FrameResult> results;
  std::vector<RelativePose> relative_poses;  // one per result
  PoseRefiner refiner;
  SegmentLog segments;
  EventLog log;
  SnapshotSchedule schedule;  // last: it uses the members above
};

void Odometry::State::CheckTime(int64_t id, double timestamp) const {
  CheckTimestamp(id, timestamp,
                 results.empty() ? std::nullopt : std::optional(results.back().timestamp));
}

// Returns the image with its depth warped to the time of its colour image.
RgbdImage Odometry::State::Align(const RgbdImage& image) const {
  if (!options.align_depth) return image;
  return preparation.Align(image, tracker.motion().VelocityAt(image.timestamp));
}

std::shared_ptr<const Frame> Odometry::State::Build(const RgbdImage& image) {
  const TaskRunner run = [this](const Tasks& tasks) {
    side_worker ? side_worker->RunAll(tasks) : RunSequentially(tasks);
  };
  const auto frame = std::make_shared<Frame>(builder.Build(image, run));
  if (!options.use_points) {
    frame->points.clear();
    frame->grid = FeatureGrid(frame->camera, frame->points);
  }
  if (!options.use_lines) frame->lines.clear();
  return frame;
}

void Odometry::State::Count(const TrackedFrame& tracked) {
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    std::map<LandmarkId, TrackingCount>& counts = packet.counts.Of<L>();
    CountVisible(tracked.visible.Of<L>(), &counts);
    for (const auto& match : MatchesOf<L>(tracked.matches)) ++counts[match.id].num_found;
  });
}

// The next result is the first one of a segment.
void Odometry::State::BeginSegment(SegmentStart start) {
  const bool replaces_last = start == SegmentStart::kReplacing;
  if (replaces_last) DiscardSegment();
  segments.Begin(static_cast<int>(results.size()), replaces_last);
  log.LogSegment(segments.current(), start);
}

// No frame but the first one of the segment was tracked: what its map shows is unknown. Its frames
// are lost since the segment before it, or have no pose if there is none.
void Odometry::State::DiscardSegment() {
  const size_t first = segments.first_frame();
  FrameResult before;
  before.segment = kNoSegment;
  if (first > 0) before = results[first - 1];
  const RelativePose pose_before = first > 0 ? relative_poses[first - 1] : RelativePose();
  for (size_t i = first; i < results.size(); ++i) {
    FrameResult& result = results[i];
    if (HasImage(result.status)) result.status = TrackingStatus::kLost;
    result.segment = before.segment;
    result.cam_from_world = before.cam_from_world;
    result.by_pose_factors = false;
    result.is_keyframe = false;
    result.covariance.setZero();
    relative_poses[i] = pose_before;
  }
}

void Odometry::State::KeepForCalibration(const TrackedFrame& tracked, const RgbdImage& recorded) {
  if (!NeedsImages() || tracked.keyframe.is_due() || tracked.status != TrackingStatus::kTracked ||
      packet.calibration_images.size() >= kMaxCalibrationImages ||
      tracked.frame->timestamp - last_calibration_image_time < kCalibrationImageInterval) {
    return;
  }
  last_calibration_image_time = tracked.frame->timestamp;
  packet.calibration_images.push_back({tracked.frame,
                                       std::make_shared<RecordedImage>(cv::Mat(), recorded.depth),
                                       tracked.reference, tracked.cam_from_reference});
}

void Odometry::State::SubmitKeyframe(const TrackedFrame& tracked, const RgbdImage& recorded,
                                     const cv::Mat& depth) {
  const SegmentStart start = tracked.keyframe.segment_start;
  packet.begins_map = start == SegmentStart::kAfterLoss || start == SegmentStart::kReplacing;
  packet.keeps_last_map = start != SegmentStart::kReplacing;
  packet.last_tracked = tracked.keyframe.last_tracked;
  packet.covariance = tracked.pose.covariance;
  packet.in_inactive_map = tracked.keyframe.in_inactive_map;
  packet.id = tracked.keyframe.id;
  packet.frame = tracked.frame;
  packet.reference = tracked.reference;
  packet.cam_from_reference = tracked.cam_from_reference;
  packet.matches = tracked.matches;
  if (NeedsImages()) {
    packet.image = std::make_shared<RecordedImage>(recorded.gray, recorded.depth);
  }
  if (snapshot->needs_axes || packet.begins_map) {
    for (const SurfaceNormal& normal : normal_estimator->Estimate(depth)) {
      packet.normals.push_back({normal.direction, normal.sigma});
    }
  }
  if (results.size() > 1) {
    packet.frame_interval = results.back().timestamp - results[results.size() - 2].timestamp;
  }
  last_calibration_image_time = tracked.frame->timestamp;
  schedule.Submit(static_cast<int>(results.size()) - 1, tracked.frame->timestamp,
                  std::move(packet));
  packet = {};
}

void Odometry::State::Record(int frame, const MappingStep& step) {
  StageTimes& times = results[frame].times;
  times.mapping = step.milliseconds;
  times.mapping_stages = step.summary.times;
  times.snapshot = step.snapshot_ms;
  results[frame].cam_from_world = step.snapshot->map.CamFromWorld(step.summary.keyframe);
  relative_poses[frame] = {step.summary.keyframe, Rigid3()};
  segments.RecordKeyframe(frame, step.summary.submap);
  if (step.summary.calibration) {
    CorrectPoses(step.summary.calibration->maps_before, *step.snapshot, results, &relative_poses);
  }
  if (step.summary.join) segments.RecordJoin(frame, *step.summary.join);
  log.LogMapping(step);
  if (step.summary.window) last_window = *step.summary.window;
}

// Returns whether the intrinsics have changed.
bool Odometry::State::UseIntrinsics(const std::shared_ptr<const CameraIntrinsics>& intrinsics) {
  if (!intrinsics || intrinsics == builder.intrinsics()) return false;
  builder.SetIntrinsics(intrinsics);
  camera = intrinsics->camera;
  preparation.SetIntrinsics(*intrinsics);
  normal_estimator.emplace(NormalOptions(options), camera, intrinsics->distortion);
  return true;
}

Odometry::Odometry(const OdometryOptions& options, const PinholeCamera& camera,
                   const LensDistortion& distortion)
    : state_(std::make_unique<State>(options, camera, distortion)) {}

Odometry::~Odometry() = default;

void Odometry::SetWindowObserver(WindowObserver observer) {
  state_->mapper.SetWindowObserver(std::move(observer));
}

void Odometry::SetWindowFactors(WindowFactorCallback callback) {
  state_->mapper.SetWindowFactors(std::move(callback));
}

void Odometry::SetPoseFactors(PoseFactorCallback callback) {
  state_->tracker.SetPoseFactors(std::move(callback));
}

void Odometry::SetTrackingObserver(TrackingObserver observer) {
  state_->tracking_observer = std::move(observer);
}

void Odometry::SkipClippedDepthSearch() { state_->finds_clipped_depth = false; }

FrameResult Odometry::Process(const RgbdImage& given) {
  state_->CheckTime(given.id, given.timestamp);
  CheckDepthDelay(given.id, given.depth_delay);
  state_->builder.Check(given);
  CheckDepthUnits(given.id, given.depth);
  Stopwatch stopwatch;
  RgbdImage recorded = StandaloneImages(given);
  if (state_->finds_clipped_depth) recorded = state_->preparation.RemoveClipped(recorded);
  const RgbdImage aligned = state_->Align(recorded);
  RgbdImage image = state_->preparation.Register(aligned);
  const double alignment_ms = stopwatch.Milliseconds();
  std::shared_ptr<const Frame> frame = state_->Build(image);
  const double features_ms = stopwatch.Milliseconds();
  state_->log.LogDepthSensor(state_->builder.depth_sensor());
  Stopwatch waiting;
  state_->snapshot = state_->schedule.SnapshotAt(image.timestamp);
  const double waiting_ms = waiting.Milliseconds();
  if (state_->UseIntrinsics(state_->snapshot->intrinsics)) {
    image = state_->preparation.Register(aligned);
    frame = state_->Build(image);
  }
  const TrackedFrame tracked = state_->tracker.Track(frame, *state_->snapshot);
  if (tracked.keyframe.segment_start != SegmentStart::kNone)
    state_->BeginSegment(tracked.keyframe.segment_start);
  FrameResult result = MakeFrameResult(tracked, state_->segments.current());
  result.image = MeasureImage(image);
  result.times.features = features_ms;
  result.times.points = state_->builder.times().points;
  result.times.lines = state_->builder.times().lines;
  result.times.depth = state_->builder.times().depth + alignment_ms;
  result.times.waiting = waiting_ms;
  result.times.tracking = stopwatch.Milliseconds();

  state_->Count(tracked);
  if (tracked.previous_velocity) state_->packet.last_velocity = tracked.previous_velocity;
  state_->results.push_back(result);
  state_->relative_poses.push_back({tracked.reference, tracked.cam_from_reference});
  state_->refiner.Refine(image.timestamp, *state_->snapshot, &state_->relative_poses);
  state_->refiner.Add(static_cast<int>(state_->results.size()) - 1, tracked);
  state_->log.LogFrame(result, tracked.relocalized);
  const MapSnapshotPtr snapshot = state_->snapshot;
  state_->KeepForCalibration(tracked, aligned);
  if (tracked.keyframe.is_due()) {
    state_->SubmitKeyframe(tracked, aligned, image.depth);
    state_->snapshot = state_->schedule.SnapshotAt(image.timestamp);  // with it if latency is 0
  }
  result = state_->results.back();
  if (state_->tracking_observer) {
    state_->tracking_observer({recorded, *frame, tracked, *snapshot, result});
  }
  return result;
}

FrameResult Odometry::Drop(int64_t id, double timestamp, TrackingStatus status) {
  if (status != TrackingStatus::kDropped && status != TrackingStatus::kUnreadable) {
    throw std::invalid_argument(std::string("a frame without an image cannot be ") +
                                ToString(status));
  }
  state_->CheckTime(id, timestamp);
  FrameResult result;
  RelativePose relative_pose;
  if (!state_->results.empty()) {
    result.cam_from_world = state_->results.back().cam_from_world;
    relative_pose = state_->relative_poses.back();
  }
  result.id = id;
  result.timestamp = timestamp;
  result.status = status;
  result.segment = state_->segments.current();
  state_->results.push_back(result);
  state_->relative_poses.push_back(relative_pose);
  state_->log.LogFrame(result, false);
  return result;
}

const std::vector<FrameResult>& Odometry::frames() const { return state_->results; }

bool Odometry::Save(BinaryWriter* archive) {
  if (!state_->schedule.WaitForMapper()) return false;
  state_->Serialize(*archive);
  return true;
}

void Odometry::Restore(BinaryReader* archive) { state_->Serialize(*archive); }

MapSnapshotPtr Odometry::Map() {
  state_->schedule.Drain();
  return state_->mapper.Snapshot();
}

OdometryResult Odometry::Finish() {
  state_->schedule.Drain();
  OdometryResult result;
  result.frames = state_->results;
  std::vector<RelativePose> poses = state_->relative_poses;
  state_->refiner.RefineAll(*state_->mapper.Snapshot(), &poses);
  SetPoses(state_->mapper.atlas(), poses, &result.frames);
  result.segments = state_->segments.Segments(result.frames);
  FillGaps(result.segments, &result.frames);
  state_->segments.PropagateCovariances(&result.frames);
  result.map_world = LargestWorld(result.segments);
  AddMap(state_->mapper, state_->segments.SubMapOf(result.map_world), &result);
  result.noise_scale = state_->mapper.noise().scale();
  result.depth_sensor = state_->builder.depth_sensor();
  const MapCalibration& calibration = state_->mapper.calibration();
  result.readout_time = calibration.readout().readout_time();
  result.readout_time_sigma = calibration.readout().sigma();
  result.intrinsics = {state_->camera, state_->builder.intrinsics()->distortion};
  if (calibration.intrinsics()) {
    result.calibration = calibration.intrinsics()->estimate();
    result.intrinsics = *calibration.intrinsics()->present();
  }
  result.depth_camera = DepthCameraOf(*state_->preparation.given(), result.intrinsics);
  result.num_late_maps = state_->schedule.num_late();
  result.extra_blocks = state_->mapper.extra_blocks();
  result.last_window = state_->last_window;
  state_->log.LogFinish(result.noise_scale, result.readout_time,
                        static_cast<int>(result.frames.size()));
  return result;
}

}  // namespace msc_vo
