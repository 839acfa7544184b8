// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/live/live_run.h"

#include <algorithm>
#include <random>
#include <thread>
#include <utility>

#include "msc_vo/report/run_json.h"
#include "msc_vo/results/report_frame.h"
#include "msc_vo/results/thumbnail.h"
#include "msc_vo/results/tracked_features.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr int kMaxFramesPerUpdate = 500;
// Viewers get at most this many images and maps per second, however fast the run is.
constexpr std::chrono::milliseconds kViewInterval(80);
constexpr std::chrono::milliseconds kMapInterval(300);
// Somebody watches if the last request is not older.
constexpr std::chrono::milliseconds kWatchedWithin(2500);

std::string RandomId() {
  std::random_device random;
  return FormatText("%08x%08x", random(), random());
}

}  // namespace

LiveRun::LiveRun(const LiveRunOptions& options) : options_(options), id_(RandomId()) {}

bool LiveRun::IsWatched(Clock::duration within) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_request_ && Clock::now() - *last_request_ <= within;
}

bool LiveRun::WantsView() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return view_is_wanted_;
}

void LiveRun::Continue(const std::vector<FrameResult>& frames) {
  for (const FrameResult& frame : frames) Append(frame);
}

void LiveRun::Show(const TrackedImage& tracked) {
  Remember(tracked.tracked);
  if (!IsWatched(kWatchedWithin)) return;
  const bool is_paused = pacing_.is_paused();  // then every step is shown
  if (is_paused || (WantsView() && Clock::now() - view_time_ >= kViewInterval)) ShowView(tracked);
  const bool is_new = &tracked.map != shown_map_ || tracked.map.newest_keyframe != shown_keyframe_;
  if (is_new && (is_paused || Clock::now() - map_time_ >= kMapInterval)) ShowMap(tracked);
}

// A frame that begins a map is the keyframe that it is relative to.
void LiveRun::Remember(const TrackedFrame& tracked) {
  pose_ = {tracked.reference, tracked.cam_from_reference};
  if (pose_.reference == kNoId && tracked.keyframe.is_due()) {
    pose_ = {tracked.keyframe.id, Rigid3()};
  }
}

void LiveRun::ShowView(const TrackedImage& tracked) {
  auto view = std::make_shared<FrameView>();
  view->frame = static_cast<int>(tracked.result.id);
  view->jpeg = EncodeThumbnail(tracked.image.gray);
  view->features = TrackedFeatures(tracked, options_.distortion);
  view_time_ = Clock::now();
  const std::lock_guard<std::mutex> lock(mutex_);
  view_ = std::move(view);
  view_is_wanted_ = false;
}

void LiveRun::ShowMap(const TrackedImage& tracked) {
  auto map = std::make_shared<ReportMap>(ViewedMap(tracked.map));
  const bool has_moved =
      tracked.map.num_loops != num_shown_loops_ || tracked.map.world != shown_world_;
  std::vector<ReportFrame> moved;
  if (has_moved) moved = MovedFrames(tracked.map);
  map_time_ = Clock::now();
  shown_map_ = &tracked.map;
  shown_keyframe_ = tracked.map.newest_keyframe;
  num_shown_loops_ = tracked.map.num_loops;
  shown_world_ = tracked.map.world;
  const std::lock_guard<std::mutex> lock(mutex_);
  map_ = std::move(map);
  ++map_version_;
  loops_.clear();
  for (const Loop& loop : tracked.loops) loops_.push_back({loop.frame, loop.reference});
  if (!has_moved) return;
  frames_ = std::move(moved);
  moved_version_ = map_version_;
}

std::vector<ReportFrame> LiveRun::MovedFrames(const MapSnapshot& snapshot) const {
  std::vector<ReportFrame> frames = frames_;  // which this thread alone changes
  for (size_t i = 0; i < frames.size(); ++i) {
    const ReferencedPose& pose = poses_[i];
    const Map* map = pose.reference != kNoId ? snapshot.FindMapOf(pose.reference) : nullptr;
    if (map == nullptr) continue;
    const Rigid3 cam_from_world = pose.cam_from_reference * map->CamFromWorld(pose.reference);
    frames[i].world_from_cam = cam_from_world.Inverse();
    if (map == &snapshot.map) frames[i].submap = snapshot.world;
  }
  return frames;
}

void LiveRun::ShowPlace(const PlaceView& place) {
  const std::lock_guard<std::mutex> lock(mutex_);
  place_ = place;
}

void LiveRun::Append(const FrameResult& frame) {
  if (frame.segment != kNoSegment && first_segment_ == kNoSegment) first_segment_ = frame.segment;
  const bool is_found = frame.world != kNoSegment && frame.world < first_segment_;
  poses_.push_back(pose_);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_found && !found_frame_) found_frame_ = static_cast<int>(frames_.size());
  frames_.push_back(MakeReportFrame(frame));
}

void LiveRun::Add(const FrameResult& frame, const std::function<bool()>& is_interrupted) {
  Append(frame);
  if (!options_.can_pause) return;
  pacing_.Wait(frame.timestamp, [&] {
    if (pacing_.is_paused() && !IsWatched(options_.vanished)) pacing_.Resume();
    return is_interrupted();
  });
}

void LiveRun::Finish(std::string report) {
  const std::lock_guard<std::mutex> lock(mutex_);
  report_ = std::make_shared<const std::string>(std::move(report));
}

void LiveRun::WaitForViewers(std::chrono::milliseconds longest) const {
  constexpr std::chrono::milliseconds kStep(20);
  constexpr std::chrono::milliseconds kForOthers(300);
  if (!IsWatched(kWatchedWithin)) return;
  const Clock::time_point end = Clock::now() + longest;
  while (Clock::now() < end) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (report_was_sent_ && Clock::now() - *last_request_ >= kForOthers) return;
    }
    std::this_thread::sleep_for(kStep);
  }
}

std::string LiveRun::Update(int num_frames, int map_version, int view) {
  RunUpdate update;
  std::shared_ptr<const ReportMap> map;
  std::shared_ptr<const FrameView> frame_view;
  update.run = id_;
  update.speed = pacing_.speed();
  update.can_pause = options_.can_pause;
  update.num_total = options_.num_frames;
  update.state = pacing_.is_paused() ? "paused" : "running";
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_request_ = Clock::now();
    const int count = static_cast<int>(frames_.size());
    update.num_processed = count;
    update.first_frame = std::clamp(num_frames, 0, count);
    const int end = std::min(count, update.first_frame + kMaxFramesPerUpdate);
    update.frames.assign(frames_.begin() + update.first_frame, frames_.begin() + end);
    update.has_more = end < count;
    if (count > 0) update.start = frames_.front().timestamp;
    update.map_version = map_version_;
    if (map_version != map_version_) map = map_;
    if (map_version < moved_version_) {
      update.moved_frames.assign(frames_.begin(), frames_.begin() + update.first_frame);
    }
    update.loops = loops_;
    update.found_frame = found_frame_;
    update.place = place_;
    // A viewer does not get the image of a frame before the frame itself.
    if (view_ && view_->frame != view && view_->frame < end) {
      frame_view = view_;
      view_is_wanted_ = true;
    }
    if (report_) update.state = "finished";
  }
  update.map = map.get();
  update.view = frame_view.get();
  return FormatRunUpdate(update);
}

std::shared_ptr<const std::string> LiveRun::Report() {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_request_ = Clock::now();
  report_was_sent_ = report_was_sent_ || report_;
  return report_;
}

bool LiveRun::Control(const std::string& action, const std::string& value) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_request_ = Clock::now();
  }
  if (!options_.can_pause) return false;
  if (action == "pause") {
    pacing_.Pause();
  } else if (action == "resume") {
    pacing_.Resume();
  } else if (action == "step") {
    pacing_.Step();
  } else if (action == "speed") {
    const std::optional<double> speed = ParseNumber(value);
    return speed && pacing_.SetSpeed(*speed);
  } else {
    return false;
  }
  return true;
}

}  // namespace msc_vo
