// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/run_summary.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/odometry/localization.h"
#include "msc_vo/results/report_frame.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Times of the stages of mapping, over the frames that caused a keyframe step with that stage.
std::vector<StageTimeStatistics> SummarizeMapping(const std::vector<FrameResult>& frames) {
  const auto summarize = [&frames](const std::string& name, const auto& milliseconds_of) {
    std::vector<double> values;
    for (const FrameResult& frame : frames) {
      if (frame.times.mapping <= 0.0) continue;
      const std::optional<double> milliseconds = milliseconds_of(frame.times);
      if (milliseconds) values.push_back(*milliseconds);
    }
    return SummarizeStage(name, std::move(values));
  };
  return {
      summarize("structure", [](const StageTimes& t) { return t.mapping_stages.structure; }),
      summarize("creation", [](const StageTimes& t) { return t.mapping_stages.creation; }),
      summarize("fusion", [](const StageTimes& t) { return t.mapping_stages.fusion; }),
      summarize("loop", [](const StageTimes& t) { return t.mapping_stages.loop; }),
      summarize("axes", [](const StageTimes& t) { return t.mapping_stages.axes; }),
      summarize("local_ba", [](const StageTimes& t) { return t.mapping_stages.window; }),
      summarize("readout", [](const StageTimes& t) { return t.mapping_stages.readout; }),
      summarize("calibration", [](const StageTimes& t) { return t.mapping_stages.calibration; }),
      summarize("culling", [](const StageTimes& t) { return t.mapping_stages.culling; }),
      summarize("snapshot", [](const StageTimes& t) { return t.snapshot; })};
}

int WorldOf(const OdometryResult& result, int segment) {
  return segment < static_cast<int>(result.segments.size()) ? result.segments[segment].world
                                                            : segment;
}

std::optional<Localization> FindLocalization(const OdometryResult& result) {
  const std::optional<int> found = FirstLocalizedFrame(result);
  if (!found) return std::nullopt;
  const std::vector<FrameResult>& frames = result.frames;
  Localization localization;
  localization.frame = *found;
  localization.seconds = frames[*found].timestamp - frames.front().timestamp;
  for (int i = 1; i <= *found; ++i) {
    localization.length += (frames[i].cam_from_odometry.OriginInSource() -
                            frames[i - 1].cam_from_odometry.OriginInSource())
                               .norm();
  }
  return localization;
}

int NumProcessed(const RunSummary& summary) {
  return summary.num_frames - summary.Count(TrackingStatus::kDropped) -
         summary.Count(TrackingStatus::kUnreadable);
}

}  // namespace

RunSummary Summarize(const OdometryResult& result) {
  RunSummary summary;
  summary.num_frames = static_cast<int>(result.frames.size());
  for (const FrameResult& frame : result.frames) {
    ++summary.status_counts.at(static_cast<size_t>(frame.status));
    summary.num_frames_with_dynamic_objects += frame.num_dynamic > 0 ? 1 : 0;
    summary.num_estimated += IsEstimated(frame.status) ? 1 : 0;
    if (frame.cause && !IsEstimated(frame.status)) {
      ++summary.loss_causes.at(static_cast<size_t>(*frame.cause));
    }
  }
  summary.tracked_ratio =
      static_cast<double>(summary.num_estimated) / std::max(summary.num_frames, 1);
  const std::vector<ReportFrame> frames = ReportFrames(result.frames);
  summary.not_tracked = FindNotTrackedSpans(frames);
  summary.stages = SummarizeStages(ReportStages(), frames);
  const std::vector<StageTimeStatistics> mapping = SummarizeMapping(result.frames);
  summary.stages.insert(std::prev(summary.stages.end()), mapping.begin(), mapping.end());
  summary.segments = result.segments;
  summary.loops = result.loops;
  summary.has_earlier_sessions = NumEarlierWorlds(result) > 0;
  summary.localization = FindLocalization(result);
  summary.map_world = result.map_world;
  summary.num_keyframes = static_cast<int>(result.keyframes.size());
  summary.num_points = static_cast<int>(result.points.size());
  summary.num_lines = static_cast<int>(result.lines.size());
  summary.num_planes = static_cast<int>(result.planes.size());
  for (const MapLine& line : result.lines) {
    if (line.axis) ++summary.num_axis_lines[*line.axis];
  }
  summary.axes = result.axes;
  summary.noise_scale = result.noise_scale;
  summary.readout_time = result.readout_time;
  summary.calibration = result.calibration;
  summary.intrinsics = result.intrinsics;
  summary.depth_camera = result.depth_camera;
  summary.depth_sensor = result.depth_sensor;
  summary.last_local_ba = result.last_window;
  return summary;
}

StageTimeStatistics FindStage(const RunSummary& summary, const std::string& name) {
  for (const StageTimeStatistics& stage : summary.stages) {
    if (stage.name == name) return stage;
  }
  return {};
}

bool TrackingFailed(const RunSummary& summary) {
  return summary.num_estimated == 0 ||
         summary.num_estimated < kMinTrackedRatio * NumProcessed(summary);
}

std::string DescribeLosses(const RunSummary& summary) {
  std::string text;
  for (size_t i = 0; i < summary.loss_causes.size(); ++i) {
    if (summary.loss_causes[i] == 0) continue;
    text += FormatText("%s%d %s", text.empty() ? "" : ", ", summary.loss_causes[i],
                       Describe(static_cast<LossCause>(i)));
  }
  return text;
}

std::string DescribeFailure(const RunSummary& summary) {
  std::string text = FormatText(
      "tracking failed: %d of %d images have an estimated pose, at least %.0f %% are needed",
      summary.num_estimated, NumProcessed(summary), 100.0 * kMinTrackedRatio);
  const std::string losses = DescribeLosses(summary);
  return losses.empty() ? text : text + "; the others: " + losses;
}

std::string DescribeLoops(const RunSummary& summary) {
  Loop largest;  // of all corrections
  for (const Loop& loop : summary.loops) {
    largest.translation = std::max(largest.translation, loop.translation);
    largest.rotation = std::max(largest.rotation, loop.rotation);
  }
  const bool is_one = summary.loops.size() == 1;
  return FormatText(
      "%zu closed: the camera was back at %s, and %s%.1f mm and %.2f degrees of drift were removed",
      summary.loops.size(), is_one ? "a known place" : "known places", is_one ? "" : "up to ",
      1000.0 * largest.translation, RadiansToDegrees(largest.rotation));
}

std::string DescribeLoopFrames(const RunSummary& summary) {
  constexpr size_t kMaxNamed = 3;
  const size_t num_named = std::min(kMaxNamed, summary.loops.size());
  std::string text;
  for (size_t i = 0; i < num_named; ++i) {
    const Loop& loop = summary.loops[i];
    text += FormatText("%sframe %d shows the place of ", i > 0 ? ", " : "", loop.frame);
    text += loop.reference < 0 ? "an earlier session" : FormatText("frame %d", loop.reference);
  }
  const size_t num_more = summary.loops.size() - num_named;
  return num_more > 0 ? text + FormatText(", and %zu more", num_more) : text;
}

std::string DescribeLocalization(const RunSummary& summary) {
  if (!summary.localization) return "not in the map of earlier sessions";
  const Localization& found = *summary.localization;
  return FormatText(
      "in the map of earlier sessions, at frame %d of %d, after %.2f s and %.2f m (%.0f %% of the "
      "images)",
      found.frame, summary.num_frames, found.seconds, found.length,
      100.0 * found.frame / std::max(summary.num_frames, 1));
}

std::string DescribeSegments(const RunSummary& summary) {
  int num_segments = 0;
  int num_joined = 0;
  int num_in_map = 0;
  int num_earlier_joined = 0;
  for (const Segment& segment : summary.segments) {
    if (segment.is_earlier_session) {
      num_earlier_joined += segment.join ? 1 : 0;
      continue;
    }
    ++num_segments;
    num_joined += segment.join ? 1 : 0;
    num_in_map += segment.world == summary.map_world ? 1 : 0;
  }
  std::string text =
      FormatText("%d, %d of them joined with an older one", num_segments, num_joined);
  if (num_in_map < num_segments) {
    text += FormatText("; %d not in the map, the transform to them is unknown",
                       num_segments - num_in_map);
  }
  if (num_earlier_joined > 0) {
    text += FormatText("; %d of the maps of earlier sessions joined with another one",
                       num_earlier_joined);
  }
  return text;
}

std::vector<TimedPose> TrajectoryOf(const OdometryResult& result) {
  std::vector<TimedPose> poses;
  const auto first =
      std::find_if(result.frames.begin(), result.frames.end(),
                   [](const FrameResult& frame) { return frame.segment != kNoSegment; });
  for (const FrameResult& frame : result.frames) {
    const bool precedes_first = frame.segment == kNoSegment && first != result.frames.end();
    const FrameResult& shown = precedes_first ? *first : frame;
    const int segment =
        shown.segment == kNoSegment ? NumEarlierWorlds(result) : shown.segment;  // none has begun
    poses.push_back({frame.timestamp, shown.cam_from_world.Inverse(), IsEstimated(frame.status),
                     segment, WorldOf(result, segment)});
  }
  return poses;
}

}  // namespace msc_vo
