// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/segment_log.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/geometry/pose_covariance.h"

namespace msc_vo {

namespace {

// The join as seen from the first frame of the segment, where its alignment has no lever arm.
SegmentJoin Describe(int frame, const MapJoin& join, const Rigid3& cam_from_kept) {
  const Rigid3 cam_from_moved = cam_from_kept * join.moved_from_kept.Inverse();
  const PoseCovariance covariance =
      CameraCovariance(cam_from_kept, ComposeCovariances(cam_from_moved, PoseCovariance::Zero(),
                                                         join.moved_from_kept, join.covariance));
  const Eigen::Matrix<double, 6, 1> variance = covariance.diagonal();
  return {frame, join.num_keyframes, std::sqrt(variance.head<3>().maxCoeff()),
          std::sqrt(variance.tail<3>().maxCoeff())};
}

}  // namespace

int LargestWorld(const std::vector<Segment>& segments) {
  std::vector<int> num_estimated(segments.size(), 0);
  for (const Segment& segment : segments) num_estimated[segment.world] += segment.num_estimated;
  return static_cast<int>(std::max_element(num_estimated.begin(), num_estimated.end()) -
                          num_estimated.begin());
}

void SetWorlds(const std::vector<Segment>& segments, std::vector<FrameResult>* frames) {
  int last_world = kNoSegment;
  for (FrameResult& frame : *frames) {
    frame.world = frame.segment != kNoSegment ? segments[frame.segment].world : kNoSegment;
    frame.world_changed.reset();
    if (last_world != kNoSegment && frame.world != last_world) {
      frame.world_changed = WorldChange{last_world, std::nullopt};
    }
    last_world = frame.world;
  }
}

void SegmentLog::BeginWith(int num_submaps) {
  num_earlier_ = static_cast<size_t>(num_submaps);
  for (SubMapId id = 0; id < num_submaps; ++id) {
    entries_.emplace_back();
    entries_.back().first_submap = entries_.back().submap = id;
  }
}

void SegmentLog::Begin(int frame, bool replaces_last) {
  if (replaces_last && has_begun()) entries_.pop_back();
  entries_.emplace_back();
  entries_.back().first_frame = frame;
}

void SegmentLog::RecordKeyframe(int frame, SubMapId submap) {
  for (Entry& entry : entries_) {
    if (entry.first_frame != frame || entry.first_submap != kNoSubMap) continue;
    entry.first_submap = submap;
    entry.submap = submap;
  }
}

void SegmentLog::RecordJoin(int frame, const MapJoin& join) {
  for (Entry& entry : entries_) {
    if (entry.submap != join.moved) continue;
    entry.submap = join.kept;
    entry.moves.push_back({frame, join});
  }
}

std::optional<Rigid3> SegmentLog::NewFromOldWorld(int old_world, int new_world) const {
  if (old_world == kNoSegment) return std::nullopt;
  Rigid3 new_from_old;
  for (const Move& move : entries_[old_world].moves) {
    new_from_old = move.join.moved_from_kept.Inverse() * new_from_old;
    if (move.join.kept == new_world) return new_from_old;
  }
  return std::nullopt;
}

SubMapId SegmentLog::SubMapOf(int segment) const {
  return segment < static_cast<int>(entries_.size()) ? entries_[segment].first_submap : kNoSubMap;
}

int SegmentLog::WorldOf(int segment) const {
  for (size_t i = 0; i < entries_.size(); ++i) {
    const SubMapId first = entries_[i].first_submap;
    if (first != kNoSubMap && first == entries_[segment].submap) return static_cast<int>(i);
  }
  return segment;
}

Rigid3 SegmentLog::OriginOf(const std::vector<Move>& moves) {
  Rigid3 origin_from_world;
  for (const Move& move : moves) origin_from_world = origin_from_world * move.join.moved_from_kept;
  return origin_from_world;
}

SegmentJoin SegmentLog::JoinOf(const std::vector<Move>& moves, Rigid3 cam_from_world) const {
  auto first = std::find_if(moves.begin(), moves.end(), [this](const Move& move) {
    return move.join.kept < static_cast<SubMapId>(num_earlier_);
  });
  if (first == moves.end()) --first;
  for (auto move = moves.end(); --move != first;) {
    cam_from_world = cam_from_world * move->join.moved_from_kept.Inverse();
  }
  return Describe(first->frame, first->join, cam_from_world);
}

std::vector<Segment> SegmentLog::Segments(const std::vector<FrameResult>& frames) const {
  std::vector<Segment> segments;
  for (size_t i = 0; i < entries_.size(); ++i) {
    const Entry& entry = entries_[i];
    Segment segment;
    segment.is_earlier_session = i < num_earlier_;
    segment.first_frame = entry.first_frame;
    segment.last_frame = segment.is_earlier_session ? -1
                         : i + 1 < entries_.size()  ? entries_[i + 1].first_frame - 1
                                                    : static_cast<int>(frames.size()) - 1;
    for (int frame = segment.first_frame; frame <= segment.last_frame; ++frame) {
      segment.num_estimated += IsEstimated(frames[frame].status) ? 1 : 0;
    }
    segment.world = WorldOf(static_cast<int>(i));
    if (!entry.moves.empty()) {
      segment.join = JoinOf(entry.moves, segment.is_earlier_session
                                             ? OriginOf(entry.moves)
                                             : frames[entry.first_frame].cam_from_world);
    }
    segments.push_back(segment);
  }
  return segments;
}

void SegmentLog::PropagateCovariances(const std::vector<FrameResult>& tracked,
                                      std::vector<FrameResult>* frames) const {
  for (size_t i = 0; i < frames->size(); ++i) {
    FrameResult& frame = (*frames)[i];
    if (frame.segment == kNoSegment || !IsEstimated(frame.status)) continue;
    const std::vector<Move>& moves = entries_[frame.segment].moves;
    const auto first = std::find_if(moves.begin(), moves.end(), [i](const Move& move) {
      return static_cast<int>(i) < move.frame;
    });
    // From the final pose back to the world in which it was estimated.
    std::vector<Rigid3> poses{frame.cam_from_world};
    for (auto move = moves.end(); move != first;) {
      poses.push_back(poses.back() * (--move)->join.moved_from_kept.Inverse());
    }
    if (frame.covariance) {
      frame.covariance = CovarianceOfCamera(
          poses.back(), CameraCovariance(tracked[i].cam_from_world, *frame.covariance));
    }
    for (auto move = first; move != moves.end(); ++move) {
      frame.covariance =
          ComposeCovariances(poses.back(), frame.covariance.value_or(PoseCovariance::Zero()),
                             move->join.moved_from_kept, move->join.covariance);
      poses.pop_back();
    }
  }
}

}  // namespace msc_vo
