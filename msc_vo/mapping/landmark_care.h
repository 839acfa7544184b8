// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include "msc_vo/map/map.h"
#include "msc_vo/mapping/culling.h"
#include "msc_vo/mapping/landmark_fusion.h"

namespace msc_vo {

/// Keeps the landmarks and keyframes of the current submap few and good: creates landmarks, fuses
/// duplicates, and culls what has not proved itself or is redundant.
class LandmarkCare {
 public:
  LandmarkCare(const CullingOptions& culling, const FusionOptions& fusion)
      : culling_(culling), fusion_(fusion) {}

  /// Forgets the landmarks on probation: another submap begins.
  void BeginMap() { probation_ = {}; }

  /// Removes the landmarks that fail their probation, and creates those of the newest keyframe.
  void Renew(KeyframeId newest, Map* map);
  /// Fuses the landmarks of the newest keyframe with those of its covisible keyframes.
  void Fuse(KeyframeId newest, Map* map) const { FuseLandmarks(fusion_, newest, map); }
  /// Fuses the landmarks of all keyframes.
  void FuseAll(Map* map) const { FuseAllLandmarks(fusion_, map); }
  /// Removes redundant keyframes and returns their number.
  int CullKeyframes(KeyframeId newest, Map* map) const {
    return msc_vo::CullKeyframes(culling_, newest, map);
  }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [culling, fusion, on_probation] = *this;  // all members
    archive(on_probation);
  }

 private:
  CullingOptions culling_;
  FusionOptions fusion_;
  Probation probation_;
};

}  // namespace msc_vo
