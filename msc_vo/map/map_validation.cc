// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map/map_validation.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace msc_vo {

namespace {

constexpr double kUnitTolerance = 1e-9;

bool IsPositive(double x) { return std::isfinite(x) && x > 0.0; }
bool IsUnit(double norm) { return std::abs(norm - 1.0) <= kUnitTolerance; }

const std::vector<LandmarkId>& EntriesOf(const Keyframe& keyframe, const PointLandmark&) {
  return keyframe.points;
}
const std::vector<LandmarkId>& EntriesOf(const Keyframe& keyframe, const LineLandmark&) {
  return keyframe.lines;
}

std::string GeometryViolation(const PointLandmark& point) {
  if (!point.position.allFinite()) return "its position is not finite";
  if (!IsPositive(point.reference_distance)) return "its reference distance is not positive";
  return "";
}
std::string GeometryViolation(const LineLandmark& line) {
  if (!line.segment.start.allFinite() || !line.segment.end.allFinite()) {
    return "its end points are not finite";
  }
  if (!(line.segment.Length() > 0.0)) return "it has no length";
  if (!std::isfinite(line.depth_offset)) return "its depth offset is not finite";
  if (!IsPositive(line.direction_sigma)) return "the sigma of its direction is not positive";
  return "";
}

template <typename L>
std::string ObservationViolation(const Map& map, const L& landmark) {
  if (landmark.observations.empty()) return "it has no observation";
  KeyframeId previous = kNoId;
  for (const Observation& observation : landmark.observations) {
    const std::string name = "its observation by keyframe " + std::to_string(observation.keyframe);
    if (observation.keyframe <= previous) return name + " is out of order";
    previous = observation.keyframe;
    const Keyframe* keyframe = map.FindKeyframe(observation.keyframe);
    if (keyframe == nullptr) return name + " has no keyframe";
    const std::vector<LandmarkId>& entries = EntriesOf(*keyframe, landmark);
    const auto feature = static_cast<size_t>(observation.feature);
    if (feature >= entries.size() || entries[feature] != landmark.id) {
      return name + " is unknown to the keyframe";
    }
  }
  return "";
}

template <typename L>
std::string LandmarkViolation(const Map& map, LandmarkId id, const L& landmark) {
  if (landmark.id != id) return "its id is " + std::to_string(landmark.id);
  if (!IsPositive(landmark.noise)) return "its noise is not positive";
  if (!IsUnit(landmark.viewing_direction.norm())) return "its viewing direction is not a unit";
  std::string geometry = GeometryViolation(landmark);
  return geometry.empty() ? ObservationViolation(map, landmark) : geometry;
}

// `entries` of a keyframe; `find` returns the landmark of an id.
template <typename Find>
std::string EntryViolation(KeyframeId id, const std::vector<LandmarkId>& entries,
                           const Find& find) {
  for (size_t feature = 0; feature < entries.size(); ++feature) {
    if (entries[feature] == kNoId) continue;
    const Landmark* landmark = find(entries[feature]);
    const Observation* observation = landmark == nullptr ? nullptr : FindObservation(*landmark, id);
    if (observation == nullptr || static_cast<size_t>(observation->feature) != feature) {
      return "landmark " + std::to_string(entries[feature]) + " does not know its feature " +
             std::to_string(feature);
    }
  }
  return "";
}

std::string KeyframeViolation(const Map& map, KeyframeId id, const Keyframe& keyframe) {
  if (keyframe.id != id) return "its id is " + std::to_string(keyframe.id);
  if (keyframe.frame == nullptr) return "it has no frame";
  if (!keyframe.cam_from_world.params.allFinite()) return "its pose is not finite";
  if (!IsUnit(keyframe.cam_from_world.rotation().norm())) return "its rotation is not a unit";
  if (keyframe.points.size() != keyframe.frame->points.size() ||
      keyframe.lines.size() != keyframe.frame->lines.size()) {
    return "it does not have one entry per feature";
  }
  std::string points = EntryViolation(id, keyframe.points,
                                      [&map](LandmarkId i) { return map.Find<PointLandmark>(i); });
  if (!points.empty()) return points;
  return EntryViolation(id, keyframe.lines,
                        [&map](LandmarkId i) { return map.Find<LineLandmark>(i); });
}

}  // namespace

std::string FirstViolation(const Map& map) {
  for (const auto& [id, keyframe] : map.keyframes()) {
    const std::string violation = KeyframeViolation(map, id, keyframe);
    if (!violation.empty()) return "keyframe " + std::to_string(id) + ": " + violation;
  }
  for (const auto& [id, point] : map.points()) {
    const std::string violation = LandmarkViolation(map, id, point);
    if (!violation.empty()) return "point " + std::to_string(id) + ": " + violation;
  }
  for (const auto& [id, line] : map.lines()) {
    const std::string violation = LandmarkViolation(map, id, line);
    if (!violation.empty()) return "line " + std::to_string(id) + ": " + violation;
  }
  return "";
}

}  // namespace msc_vo
