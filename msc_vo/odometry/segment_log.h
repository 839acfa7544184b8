// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <vector>

#include "msc_vo/mapping/map_joiner.h"
#include "msc_vo/odometry/frame_result.h"

namespace msc_vo {

/// How the map of a segment came into the world of an older one: by its first join with a map of
/// earlier sessions, without one by its last join.
struct SegmentJoin {
  int frame = 0;                ///< index of the keyframe that completed the join
  int num_keyframes = 0;        ///< that agree on the alignment of the two maps
  double rotation_sigma = 0.0;  ///< radians, of the alignment; the largest of three
  /// Metres, of the alignment at the segment's first frame; at the origin of a map of earlier
  /// sessions.
  double translation_sigma = 0.0;
};

/// A part of a run that was tracked in a map of its own. A new segment begins when the map of the
/// one before cannot be found again.
struct Segment {
  int first_frame = 0;    ///< index of the frame that began its map
  int last_frame = 0;     ///< index of the last frame before the next segment
  int num_estimated = 0;  ///< frames with an estimated pose
  /// Number of the segment whose world its poses are in: its own, unless it was joined with an
  /// older one. Poses of different worlds have an unknown transform between them.
  int world = 0;
  std::optional<SegmentJoin> join;  ///< if `world` is another segment
  /// It stands for a map of earlier sessions (Odometry::SetMap()) and has no frames.
  bool is_earlier_session = false;
};

/// The world with most estimated poses, the oldest one on ties; 0 without segments.
int LargestWorld(const std::vector<Segment>& segments);

/// Sets the worlds of frames with final poses, and where they change: loops have moved all of them.
void SetWorlds(const std::vector<Segment>& segments, std::vector<FrameResult>* frames);

/// Keeps the segments of a run while frames are tracked and keyframes are mapped.
class SegmentLog {
 public:
  /// Begins with the submaps 0, ..., num_submaps - 1 of earlier sessions, as segments without
  /// frames. Call it before the first segment.
  void BeginWith(int num_submaps);
  /// Frame `frame` begins a segment. The last segment is discarded if `replaces_last`.
  void Begin(int frame, bool replaces_last);
  /// Reports that frame `frame` became a keyframe of a submap.
  void RecordKeyframe(int frame, SubMapId submap);
  /// Reports that frame `frame` completed a join of two maps.
  void RecordJoin(int frame, const MapJoin& join);

  /// Number of the current segment; kNoSegment before the first one.
  int current() const { return has_begun() ? static_cast<int>(entries_.size()) - 1 : kNoSegment; }
  /// First frame of the current segment.
  int first_frame() const { return entries_.back().first_frame; }

  /// Transform from the world that segment `old_world` began to `new_world`, into which joins have
  /// moved it; std::nullopt if they have not.
  std::optional<Rigid3> NewFromOldWorld(int old_world, int new_world) const;

  /// The submap that began with a segment; kNoSubMap if it was not mapped or does not exist.
  SubMapId SubMapOf(int segment) const;

  /// The segments, given the frames of the run with their segments.
  std::vector<Segment> Segments(const std::vector<FrameResult>& frames) const;

  /// Moves the covariances of the poses from those at tracking, `tracked`, to the final ones, which
  /// `frames` have: what is uncertain is the camera, in its own frame. Adds the covariance of the
  /// joins to the poses that were estimated before them in maps that were moved. The pose of a
  /// frame that began a world has the covariance of the join alone.
  void PropagateCovariances(const std::vector<FrameResult>& tracked,
                            std::vector<FrameResult>* frames) const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [entries, num_earlier] = *this;  // all members, or it does not compile
    archive(entries, num_earlier);
  }

 private:
  // A join that moved the map of a segment.
  struct Move {
    int frame = 0;
    MapJoin join;
  };
  struct Entry {
    int first_frame = 0;
    SubMapId first_submap = kNoSubMap;  // that began with the segment; kNoSubMap: not mapped yet
    SubMapId submap = kNoSubMap;        // that the segment belongs to since the last join
    std::vector<Move> moves;            // in order of time
  };

  // The pose of the origin of a moved world, in the one that it was moved into.
  static Rigid3 OriginOf(const std::vector<Move>& moves);
  // Of a segment that was moved, and whose first frame has this pose now.
  SegmentJoin JoinOf(const std::vector<Move>& moves, Rigid3 cam_from_world) const;
  bool has_begun() const { return entries_.size() > num_earlier_; }
  int WorldOf(int segment) const;

  std::vector<Entry> entries_;
  size_t num_earlier_ = 0;  // the first ones stand for submaps of earlier sessions
};

}  // namespace msc_vo
