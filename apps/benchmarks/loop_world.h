// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "msc_vo/odometry/odometry.h"
#include "msc_vo/synthetic/scene/surface_view.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {

struct LoopWorldOptions {
  SceneKind scene = SceneKind::kRooms;
  uint64_t seed = 1;
  uint64_t path = 1;  ///< number of the walk through the scene
  bool returns = false;
};

/// The scenes of places that look alike, in turn.
SceneKind LookAlikeKind(int index);

/// A walk of at most 400 images of 320 x 240 pixels at ten per second, with the noise of a Kinect.
class LoopWorld {
 public:
  explicit LoopWorld(const LoopWorldOptions& options);

  const SyntheticSequence& sequence() const { return sequence_; }
  int num_images() const { return num_images_; }
  const std::string& name() const;  ///< of the scene
  RgbdImage Render(int index) const;
  std::vector<TimedPose> TruePoses() const;

 private:
  SceneKind scene_;
  SyntheticSequence sequence_;
  int num_images_;
};

/// Two frames that the odometry claims to show the same place.
struct ClaimedPlace {
  int64_t older = 0, newer = 0;            ///< ids of the frames
  std::optional<Rigid3> older_from_newer;  ///< the claimed relative pose, if there is one
};

/// The loops of a run.
std::vector<ClaimedPlace> ClaimsOf(const OdometryResult& result);

/// For every frame, the frames in which the map points that it was tracked with were seen first.
using PointOrigins = std::vector<std::vector<int64_t>>;

/// The entry of a frame.
std::vector<int64_t> OriginsOf(const TrackedImage& tracked);

struct LoopScore {
  int num_claims = 0;
  /// Claims of frames that share no surface, or of a relative pose that is wrong by more than half
  /// a metre or 15 degrees.
  int num_false = 0;
  int num_returns = 0;  ///< of the truth (FindReturns)
  /// Returns in which a claim that is not false has its newer frame, or in which a frame is tracked
  /// with at least ten points of the earlier visit.
  int num_found = 0;
};

LoopScore ScoreClaims(const LoopWorld& world, const std::vector<ClaimedPlace>& claims,
                      const PointOrigins& origins = {});

}  // namespace msc_vo
