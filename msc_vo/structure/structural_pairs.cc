// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/structure/structural_pairs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/structure/internal/partner_selection.h"

namespace msc_vo {

namespace {

struct Direction {
  LandmarkId line = kNoId;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  double sigma = 0.0;                 // radians
  std::vector<KeyframeId> observers;  // ascending
  bool on_axis = false;
};

struct Candidate {
  double sigma = 0.0;  // radians, of the angle between the two
  int i = 0, j = 0;
  int count = 0;
};

std::vector<Direction> Directions(const Map& map, const WindowData& window) {
  std::map<LandmarkId, Direction> directions;
  for (const WindowData::Line& line : window.lines) {
    directions[line.id] = {
        line.id, line.segment.Direction(), map.FindLine(line.id)->direction_sigma, {}, false};
  }
  for (const WindowData::LineObservation& observation : window.line_observations) {
    directions[observation.line].observers.push_back(observation.keyframe);
  }
  for (const WindowData::AxisAlignment& alignment : window.axis_alignments) {
    directions[alignment.line].on_axis = true;
  }
  std::vector<Direction> list;
  for (auto& [id, direction] : directions) {
    std::sort(direction.observers.begin(), direction.observers.end());
    list.push_back(std::move(direction));
  }
  return list;
}

// Number of keyframes that observe both lines.
int NumShared(const std::vector<KeyframeId>& a, const std::vector<KeyframeId>& b) {
  int count = 0;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end();) {
    count += *i == *j ? 1 : 0;
    const bool step_i = *i <= *j, step_j = *j <= *i;
    i += step_i ? 1 : 0;
    j += step_j ? 1 : 0;
  }
  return count;
}

struct Candidates {
  std::vector<Candidate> parallel, perpendicular;
};

// Pairs whose angle is near to 0 or 90 degrees.
Candidates FindCandidates(const StructuralPairOptions& options,
                          const std::vector<Direction>& lines) {
  const double max_angle = DegreesToRadians(options.max_angle);
  const double pair_sigma = DegreesToRadians(options.pair_sigma);
  // A test of the cosine rejects most pairs cheaply.
  const double least_parallel = std::cos(max_angle), most_perpendicular = std::sin(max_angle);
  Candidates candidates;
  for (size_t i = 0; i < lines.size(); ++i) {
    for (size_t j = i + 1; j < lines.size(); ++j) {
      if (lines[i].on_axis && lines[j].on_axis) continue;
      const double cosine = std::abs(lines[i].direction.dot(lines[j].direction));
      const bool is_parallel = options.parallel && cosine >= least_parallel;
      const bool is_perpendicular = options.perpendicular && cosine <= most_perpendicular;
      if (!is_parallel && !is_perpendicular) continue;
      const double sigma =
          std::sqrt(lines[i].sigma * lines[i].sigma + lines[j].sigma * lines[j].sigma);
      const double gate = std::min(max_angle, options.gate_sigmas * std::hypot(sigma, pair_sigma));
      const double angle = UndirectedAngle(lines[i].direction, lines[j].direction);
      if (std::abs(angle - (is_parallel ? 0.0 : 0.5 * kPi)) > gate) continue;
      const int count = NumShared(lines[i].observers, lines[j].observers);
      if (count == 0) continue;
      (is_parallel ? candidates.parallel : candidates.perpendicular)
          .push_back({sigma, static_cast<int>(i), static_cast<int>(j), count});
    }
  }
  return candidates;
}

// Selects the most certain pairs of each line.
std::vector<WindowData::LinePair> SelectPairs(const StructuralPairOptions& options,
                                              const std::vector<Direction>& lines,
                                              std::vector<Candidate> candidates) {
  SelectMostCertain(options.max_partners, lines.size(), &candidates);
  std::vector<WindowData::LinePair> pairs;
  for (const Candidate& candidate : candidates) {
    pairs.push_back({lines[candidate.i].line, lines[candidate.j].line,
                     DegreesToRadians(options.pair_sigma), candidate.count, false});
  }
  return pairs;
}

}  // namespace

bool StructuralPairOptions::IsValid(std::string* error) const {
  if (!(max_angle > 0.0 && max_angle < 45.0)) {
    *error = "pairs.max_angle must be in (0, 45) degrees";
  } else if (!(gate_sigmas > 0.0 && pair_sigma > 0.0)) {
    *error = "pairs.gate_sigmas and pair_sigma must be positive";
  } else if (max_partners < 1) {
    *error = "pairs.max_partners must be at least 1";
  } else {
    return true;
  }
  return false;
}

void AddStructuralPairs(const StructuralPairOptions& options, const Map& map, WindowData* window) {
  if (!options.parallel && !options.perpendicular) return;
  const std::vector<Direction> lines = Directions(map, *window);
  Candidates candidates = FindCandidates(options, lines);
  window->parallel_pairs = SelectPairs(options, lines, std::move(candidates.parallel));
  window->perpendicular_pairs = SelectPairs(options, lines, std::move(candidates.perpendicular));
}

}  // namespace msc_vo
