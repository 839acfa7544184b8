// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/pose_estimation/descriptor_matches.h"

#include <algorithm>
#include <cstddef>

#include "msc_vo/geometry/angles.h"

namespace msc_vo {

namespace {

constexpr int kNoDistance = 257;  // more than the 256 bits of a descriptor
// Bits between descriptors; stricter than for matching by projection, where the predicted position
// excludes most wrong candidates.
constexpr int kMaxDistance = 64;
constexpr double kMaxRatio = 0.8;  // best over second best descriptor distance, of points

// Lines with a less certain direction do not determine a rotation.
constexpr double kMaxDirectionSigma = DegreesToRadians(5.0);
// Bounds of the search, which is quadratic in their product. Forty lines cover a view.
constexpr size_t kMaxLines = 40;
constexpr size_t kMaxPairsPerLine = 3;

// The longest lines of the frame whose direction is known in 3-D, longest first.
std::vector<int> LongestLines(const Frame& frame) {
  std::vector<int> longest;
  for (size_t i = 0; i < frame.lines.size(); ++i) {
    const LineFeature& line = frame.lines[i];
    if (line.dynamic || !line.depth) continue;
    if (DirectionSigma(frame.camera, line.segment, *line.depth) > kMaxDirectionSigma) continue;
    longest.push_back(static_cast<int>(i));
  }
  std::stable_sort(longest.begin(), longest.end(), [&frame](int a, int b) {
    return frame.lines[a].segment.Length() > frame.lines[b].segment.Length();
  });
  if (longest.size() > kMaxLines) longest.resize(kMaxLines);
  return longest;
}

}  // namespace

std::vector<PointMatch> MatchPointDescriptors(const Frame& frame,
                                              const std::vector<PointCandidate>& candidates) {
  std::vector<PointMatch> matches;
  for (size_t feature = 0; feature < frame.points.size(); ++feature) {
    if (frame.points[feature].dynamic || !frame.points[feature].HasDepth()) continue;
    const PointCandidate* best = nullptr;
    int best_distance = kNoDistance;
    int second_distance = kNoDistance;
    for (const PointCandidate& candidate : candidates) {
      const int distance = HammingDistance(candidate.descriptor, frame.points[feature].descriptor);
      if (distance < best_distance) {
        second_distance = best_distance;
        best_distance = distance;
        best = &candidate;
      } else if (distance < second_distance) {
        second_distance = distance;
      }
    }
    if (best == nullptr || best_distance > kMaxDistance) continue;
    if (best_distance > kMaxRatio * second_distance) continue;
    matches.push_back({static_cast<int>(feature), best->id, best->position, true});
  }
  return matches;
}

std::vector<LinePair> MatchLineDescriptors(const Frame& frame,
                                           const std::vector<LineCandidate>& candidates) {
  std::vector<LinePair> pairs;
  for (const int feature : LongestLines(frame)) {
    std::vector<LinePair> nearest;
    for (size_t i = 0; i < candidates.size(); ++i) {
      const int distance =
          HammingDistance(candidates[i].descriptor, frame.lines[feature].descriptor);
      if (distance > kMaxDistance) continue;
      nearest.push_back({feature, static_cast<int>(i), frame.LineInCamera(feature),
                         candidates[i].segment, distance});
    }
    std::stable_sort(nearest.begin(), nearest.end(),
                     [](const LinePair& a, const LinePair& b) { return a.distance < b.distance; });
    if (nearest.size() > kMaxPairsPerLine) nearest.resize(kMaxPairsPerLine);
    pairs.insert(pairs.end(), nearest.begin(), nearest.end());
  }
  return pairs;
}

}  // namespace msc_vo
