// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry.h"

#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "msc_vo/checkpoint/binary_reader.h"
#include "msc_vo/checkpoint/binary_writer.h"
#include "msc_vo/features/image_statistics.h"
#include "msc_vo/odometry/calibration_exchange.h"
#include "msc_vo/odometry/event_log.h"
#include "msc_vo/odometry/first_error.h"
#include "msc_vo/odometry/image_pipeline.h"
#include "msc_vo/odometry/input_checks.h"
#include "msc_vo/odometry/localization.h"
#include "msc_vo/odometry/loop_log.h"
#include "msc_vo/odometry/loss_cause.h"
#include "msc_vo/odometry/map_result.h"
#include "msc_vo/odometry/odometry_pose.h"
#include "msc_vo/odometry/packet_collector.h"
#include "msc_vo/odometry/pose_correction.h"
#include "msc_vo/odometry/pose_refiner.h"
#include "msc_vo/odometry/session_log.h"
#include "msc_vo/odometry/snapshot_schedule.h"
#include "msc_vo/odometry/world_covariance.h"
#include "msc_vo/timing/stopwatch.h"

namespace msc_vo {

struct Odometry::State {
  State(const OdometryOptions& options_in, const PinholeCamera& camera,
        const LensDistortion& distortion)
      : options(ValidatedOptions(options_in)),
        images(options, ValidatedCamera(camera, distortion), distortion),
        tracker(options.tracking),
        mapper(options.mapping),
        calibration(options.mapping.self_calibration, &images, &mapper),
        refiner(options.tracking.pose, options.pose_refinement_delay),
        schedule(options.snapshots, MakeRunner(options.threads, options.external_mapping, &mapper),
                 mapper.Snapshot(),
                 [this](int frame, const MappingStep& step) { Record(frame, step); }) {
    log.LogStart(options, camera);
  }

  int last() const { return static_cast<int>(results.size()) - 1; }  // number of the last frame
  void CheckTime(int64_t id, double timestamp) const;
  void CheckNotStarted(const char* function) const;

  // The steps of Process().
  void Check(const RgbdImage& image) const;
  void ProcessImage(const RgbdImage& given, FirstError* error);
  ExtractedFrame Extract(const AlignedImage& image, StageTimes* times);
  MapSnapshotPtr MapAt(double timestamp, FirstError* error);
  TrackedFrame Track(const std::shared_ptr<const Frame>& frame, const MapSnapshot& map,
                     FirstError* error);
  void BeginSegment(SegmentStart start);
  void AddResult(const TrackedFrame& tracked, int world, const RgbdImage& image,
                 const Stopwatch& arrival, StageTimes times);
  void RefineOlderPoses(const TrackedFrame& tracked, const MapSnapshot& map);
  MapSnapshotPtr SubmitKeyframe(const TrackedFrame& tracked, const AlignedImage& image,
                                const ExtractedFrame& extracted, const MapSnapshotPtr& map,
                                FirstError* error);
  void MarkWorldChange(int old_world, SegmentStart start, const MapSnapshot& map);

  void AddUntracked(int64_t id, double timestamp, TrackingStatus status);
  void Record(int frame, const MappingStep& step);

  // Everything that later results depend on, except what the options determine. Maps are last: they
  // change while other objects of a checkpoint are written in parts.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(images, last_window, odometry_pose, segments, loops, log, sessions, refiner);
    archive.Blocks(results), archive.Blocks(relative_poses);
    archive(packets, calibration, tracker, mapper, schedule);
  }

  bool has_started = false;  // an image has been given to this object
  OdometryOptions options;
  ImagePipeline images;
  Tracker tracker;
  TrackingObserver tracking_observer;  // may be empty
  Mapper mapper;
  CalibrationExchange calibration;
  BundleAdjustmentSummary last_window;
  PacketCollector packets;
  std::vector<FrameResult> results;
  std::vector<ReferencedPose> relative_poses;  // one per result
  OdometryPose odometry_pose;
  WorldCovariance world_covariance;
  PoseRefiner refiner;
  SegmentLog segments;
  LoopLog loops;
  EventLog log;
  SessionLog sessions;
  SnapshotSchedule schedule;  // last: it uses the members above
};

void Odometry::State::CheckTime(int64_t id, double timestamp) const {
  CheckTimestamp(id, timestamp,
                 results.empty() ? std::nullopt : std::optional(results.back().timestamp));
}

// The mapper may use what the function sets, on its thread, from the first image on.
void Odometry::State::CheckNotStarted(const char* function) const {
  if (!has_started) return;
  throw std::invalid_argument(std::string("odometry: ") + function +
                              "() must be called before the first image");
}

void Odometry::State::Check(const RgbdImage& image) const {
  CheckTime(image.id, image.timestamp);
  images.Check(image);
}

ExtractedFrame Odometry::State::Extract(const AlignedImage& image, StageTimes* times) {
  ExtractedFrame extracted = images.Extract(image, times);
  log.LogDepthSensor(images.depth_sensor());
  return extracted;
}

// The map that a frame sees. Keeps the exceptions of keyframe steps whose maps would be visible.
MapSnapshotPtr Odometry::State::MapAt(double timestamp, FirstError* error) {
  return schedule.SnapshotAt(timestamp,
                             [error](const std::exception_ptr& failed) { error->Add(failed); });
}

// Without the pose factors if they fail. Keeps their exception.
TrackedFrame Odometry::State::Track(const std::shared_ptr<const Frame>& frame,
                                    const MapSnapshot& map, FirstError* error) {
  try {
    return tracker.Track(frame, map);
  } catch (...) {
    error->Add(std::current_exception());
  }
  return tracker.TrackWithoutFactors(frame, map);
}

// Unless it is kNone, the next result is the first one of a segment.
void Odometry::State::BeginSegment(SegmentStart start) {
  if (start == SegmentStart::kNone) return;
  // Another first segment: the first keyframe could not be inserted.
  const bool replaces_last = start == SegmentStart::kReplacing ||
                             (start == SegmentStart::kFirst && segments.current() != kNoSegment);
  if (replaces_last) DiscardFrames(segments.first_frame(), &results, &relative_poses);
  segments.Begin(static_cast<int>(results.size()), replaces_last);
  log.LogSegment(segments.current(), start);
}

void Odometry::State::AddResult(const TrackedFrame& tracked, int world, const RgbdImage& image,
                                const Stopwatch& arrival, StageTimes times) {
  FrameResult result = MakeFrameResult(tracked, segments.current(), world);
  odometry_pose.Add(tracked);
  result.cam_from_odometry = odometry_pose.cam_from_odometry();
  result.odometry_covariance = odometry_pose.covariance();
  result.image = MeasureImage(image);
  result.cause =
      FindLossCause(result, options.tracking.min_initial_features, tracked.is_implausible);
  times.matching = result.times.matching;
  times.pose = result.times.pose;
  times.tracking = arrival.Milliseconds();
  result.times = times;
  results.push_back(result);
  relative_poses.push_back({tracked.reference, tracked.cam_from_reference});
  log.LogFrame(result, tracked.relocalized);
}

void Odometry::State::RefineOlderPoses(const TrackedFrame& tracked, const MapSnapshot& map) {
  refiner.Refine(tracked.frame->timestamp, map, &relative_poses);
  refiner.Add(last(), tracked, map);
}

// Returns the map that the pose of the frame is in.
MapSnapshotPtr Odometry::State::SubmitKeyframe(const TrackedFrame& tracked,
                                               const AlignedImage& image,
                                               const ExtractedFrame& extracted,
                                               const MapSnapshotPtr& map, FirstError* error) {
  const double timestamp = tracked.frame->timestamp;
  std::optional<double> frame_interval;
  if (last() > 0) frame_interval = timestamp - results[last() - 1].timestamp;
  KeyframePacket packet = packets.Take(tracked, frame_interval);
  calibration.AddImages(image, *map, &packet);
  if (map->needs_axes || packet.begins_map) packet.normals = images.Normals(extracted.image);
  const KeyframeId id = packet.id;
  schedule.Submit(last(), timestamp, std::move(packet));
  const MapSnapshotPtr visible = MapAt(timestamp, error);
  if (visible->map.FindKeyframe(id) == nullptr) return map;
  // The latency is 0: its pose is that in its own map.
  ReplacePose(visible->map.CamFromWorld(id), &results.back());
  results.back().world = visible->world;
  return visible;
}

// The last frame may be the first one in another world than `old_world`, of which nothing is known
// if a segment begins, or the first one after a loop was closed in `map`.
void Odometry::State::MarkWorldChange(int old_world, SegmentStart start, const MapSnapshot& map) {
  FrameResult& result = results.back();
  result.world_changed = loops.FindChange(results, relative_poses, map);
  if (old_world == kNoSegment) return;
  if (start != SegmentStart::kNone) {
    result.world_changed = WorldChange{old_world, std::nullopt};
  } else if (result.world != old_world) {
    result.world_changed =
        WorldChange{old_world, segments.NewFromOldWorld(old_world, result.world)};
  }
}

void Odometry::State::Record(int frame, const MappingStep& step) {
  StageTimes& times = results[frame].times;
  times.mapping = step.milliseconds;
  times.mapping_stages = step.summary.times;
  times.snapshot = step.snapshot_ms;
  relative_poses[frame] = {step.summary.keyframe, Rigid3()};
  segments.RecordKeyframe(frame, step.summary.submap);
  if (step.summary.calibration) {
    CorrectPoses(step.summary.calibration->maps_before, *step.snapshot, results, &relative_poses);
  }
  loops.RecordKeyframe(frame, step.summary.keyframe);
  if (step.summary.loop) loops.Record(frame, *step.summary.loop);
  if (step.summary.join) segments.RecordJoin(frame, *step.summary.join);
  log.LogMapping(step);
  if (step.summary.window) last_window = *step.summary.window;
}

Odometry::Odometry(const OdometryOptions& options, const PinholeCamera& camera,
                   const LensDistortion& distortion)
    : state_(std::make_unique<State>(options, camera, distortion)) {}

Odometry::~Odometry() = default;

void Odometry::SetWindowObserver(WindowObserver observer) {
  state_->CheckNotStarted("SetWindowObserver");
  state_->mapper.SetWindowObserver(std::move(observer));
}

void Odometry::SetWindowFactors(WindowFactorCallback callback) {
  state_->CheckNotStarted("SetWindowFactors");
  state_->mapper.SetWindowFactors(std::move(callback));
}

void Odometry::SetPoseFactors(PoseFactorCallback callback) {
  state_->CheckNotStarted("SetPoseFactors");
  state_->tracker.SetPoseFactors(std::move(callback));
}

void Odometry::SetTrackingObserver(TrackingObserver observer) {
  state_->CheckNotStarted("SetTrackingObserver");
  state_->tracking_observer = std::move(observer);
}

void Odometry::SetMap(MapContents earlier) {
  state_->CheckNotStarted("SetMap");
  if (state_->sessions.has_earlier() || !state_->results.empty()) {
    throw std::invalid_argument("odometry: SetMap() needs a new odometry without a map");
  }
  state_->sessions.BeginWith(std::move(earlier), state_->images.intrinsics()->camera,
                             &state_->tracker, &state_->segments, &state_->mapper);
}

void Odometry::SkipClippedDepthSearch() {
  state_->CheckNotStarted("SkipClippedDepthSearch");
  state_->images.SkipClippedDepthSearch();
}

// The path of one frame, see docs/architecture.md. Exceptions of callbacks and of keyframe steps
// are kept until the frame is complete.
void Odometry::State::ProcessImage(const RgbdImage& given, FirstError* error) {
  const int old_world = results.empty() ? kNoSegment : results.back().world;
  StageTimes times;
  const Stopwatch arrival;
  const AlignedImage image = images.Align(given, tracker.motion().VelocityAt(given.timestamp));
  ExtractedFrame extracted = Extract(image, &times);
  const MapSnapshotPtr map = Timed(&times.waiting, [&] { return MapAt(given.timestamp, error); });
  extracted = calibration.Adopt(*map, image, std::move(extracted), &times);
  const TrackedFrame tracked = Track(extracted.frame, *map, error);
  const SegmentStart start = tracked.keyframe.segment_start;
  BeginSegment(start);
  const bool has_map = start == SegmentStart::kNone && !map->map.keyframes().empty();
  AddResult(tracked, has_map ? map->world : segments.current(), extracted.image, arrival, times);
  RefineOlderPoses(tracked, *map);
  packets.Add(tracked);
  calibration.KeepImage(tracked, image, *map);
  const MapSnapshotPtr pose_map =
      tracked.keyframe.is_due() ? SubmitKeyframe(tracked, image, extracted, map, error) : map;
  world_covariance.Set(tracked, pose_map, &results.back());
  MarkWorldChange(old_world, start, *pose_map);
  if (!tracking_observer) return;
  const FrameResult result = results.back();
  error->Catch([&] {
    tracking_observer({image.recorded, *extracted.frame, tracked, *map, result, loops.loops()});
  });
}

FrameResult Odometry::Process(const RgbdImage& image) {
  State& run = *state_;
  run.Check(image);
  run.has_started = true;
  const int last = run.last();
  FirstError error;
  error.Catch([&] { run.ProcessImage(image, &error); });
  if (run.last() == last) run.AddUntracked(image.id, image.timestamp, TrackingStatus::kLost);
  error.Throw();
  return run.results.back();
}

void Odometry::State::AddUntracked(int64_t id, double timestamp, TrackingStatus status) {
  FrameResult result = RepeatPose(results.empty() ? nullptr : &results.back());
  result.id = id;
  result.timestamp = timestamp;
  result.status = status;
  result.segment = segments.current();
  relative_poses.push_back(results.empty() ? ReferencedPose() : relative_poses.back());
  results.push_back(result);
  log.LogFrame(result, false);
}

FrameResult Odometry::Drop(int64_t id, double timestamp, TrackingStatus status) {
  if (status != TrackingStatus::kDropped && status != TrackingStatus::kUnreadable) {
    throw std::invalid_argument(std::string("a frame without an image cannot be ") +
                                ToString(status));
  }
  state_->CheckTime(id, timestamp);
  state_->has_started = true;
  state_->AddUntracked(id, timestamp, status);
  return state_->results.back();
}

bool Odometry::MappingPending() const { return state_->schedule.HasWork(); }

bool Odometry::RunMapping(double budget) {
  if (!state_->options.external_mapping) {
    throw std::invalid_argument("odometry: RunMapping() needs the option external_mapping");
  }
  if (!(budget >= 0.0)) {
    throw std::invalid_argument("odometry: the budget of RunMapping() must not be negative");
  }
  state_->schedule.RunMapper(budget);
  return MappingPending();
}

const std::vector<FrameResult>& Odometry::frames() const { return state_->results; }

bool Odometry::IsMapping() { return !state_->schedule.IsMapperIdle(); }

bool Odometry::Save(BinaryWriter* archive) {
  if (!state_->schedule.WaitForMapper()) return false;
  state_->Serialize(*archive);
  return true;
}

void Odometry::Restore(BinaryReader* archive) {
  state_->CheckNotStarted("Restore");
  state_->Serialize(*archive);
}

MapSnapshotPtr Odometry::Map() {
  state_->schedule.Drain();
  return state_->mapper.Snapshot();
}

std::optional<MapContents> Odometry::ShareMaps(const std::string& session) {
  if (!state_->schedule.WaitForMapper()) return std::nullopt;
  return state_->sessions.Share(session, &state_->mapper);
}

OdometryResult Odometry::Finish(bool only_localized) {
  state_->schedule.Drain();
  OdometryResult result;
  result.frames = state_->results;
  std::vector<ReferencedPose> poses = state_->relative_poses;
  state_->refiner.RefineAll(*state_->mapper.Snapshot(), &poses);
  SetPoses(state_->mapper.atlas(), poses, &result.frames);
  result.segments = state_->segments.Segments(result.frames);
  if (only_localized) KeepLocalizedPoses(&result.segments, &result.frames);
  SetWorlds(result.segments, &result.frames);
  result.loops = state_->loops.loops();
  FillGaps(result.segments, &result.frames);
  state_->segments.PropagateCovariances(state_->results, &result.frames);
  SetWorldCovariances(state_->mapper, poses, &result.frames);
  result.map_world = LargestWorld(result.segments);
  const bool has_map = !only_localized || FirstLocalizedFrame(result);
  if (has_map) AddMap(state_->mapper, state_->segments.SubMapOf(result.map_world), &result);
  AddEarlierSessions(state_->mapper.atlas(), state_->sessions.earlier(), &result);
  result.noise_scale = state_->mapper.noise().scale();
  result.depth_sensor = state_->images.depth_sensor();
  state_->calibration.Describe(&result);
  result.num_late_maps = state_->schedule.num_late();
  result.extra_blocks = state_->mapper.extra_blocks();
  result.last_window = state_->last_window;
  state_->log.LogFinish(result.noise_scale, result.readout_time,
                        static_cast<int>(result.frames.size()));
  return result;
}

}  // namespace msc_vo
