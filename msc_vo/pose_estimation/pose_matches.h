// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include "msc_vo/bundle_adjustment/observation.h"
#include "msc_vo/pose_estimation/pose_factors.h"
#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {

// Which factors of every match take part in a round of the pose problem.
struct PoseInlierMask {
  std::vector<InlierMask> points;
  std::vector<InlierMask> lines;
  bool operator==(const PoseInlierMask& other) const {
    return points == other.points && lines == other.lines;
  }
};

// Before anything is known of a match, it takes part if it is in front of the camera.
PoseInlierMask AllInFront(const PoseOptions& options, const PoseData& data, const Rigid3& pose);

// Chi-square test of every match over the terms that are enabled, outliers of earlier rounds
// included, in the noise of the frame. What moves by itself takes no part.
PoseInlierMask ClassifyMatches(PoseOptions options, const PoseData& data, const Rigid3& pose);

// Adds the active factors of one match, linearised (as far as sigmas go) at `pose`.
void AddFactors(const PoseOptions& options, const PinholeCamera& camera,
                const PoseData::Point& point, const InlierMask& active, PoseFactors* factors);
void AddFactors(const PoseOptions& options, const PinholeCamera& camera, const PoseData::Line& line,
                const InlierMask& active, const Rigid3& pose, PoseFactors* factors);
void SetLosses(const PoseOptions& options, PoseFactors* factors);

// The factors of all active matches, with the losses or without.
PoseFactors BuildFactors(const PoseOptions& options, const PoseData& data,
                         const PoseInlierMask& active, const Rigid3& pose, bool robust);

}  // namespace msc_vo
