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
    const std::vector<LandmarkId>& entries = SlotsOf<L>(*keyframe);
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
  const char* geometry = landmark.GeometryViolation();
  return geometry != nullptr ? geometry : ObservationViolation(map, landmark);
}

// Every landmark that the keyframe names must have the observation.
template <typename L>
std::string EntryViolation(const Map& map, const Keyframe& keyframe) {
  const std::vector<LandmarkId>& entries = SlotsOf<L>(keyframe);
  if (entries.size() != FeaturesOf<L>(*keyframe.frame).size()) {
    return "it does not have one entry per feature";
  }
  for (size_t feature = 0; feature < entries.size(); ++feature) {
    if (entries[feature] == kNoId) continue;
    const L* landmark = map.Find<L>(entries[feature]);
    const Observation* observation =
        landmark == nullptr ? nullptr : FindObservation(*landmark, keyframe.id);
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
  std::string violation;
  ForEachLandmarkKind([&](auto kind) {
    if (violation.empty()) {
      violation = EntryViolation<typename decltype(kind)::Landmark>(map, keyframe);
    }
  });
  return violation;
}

template <typename L>
std::string KindViolation(const Map& map) {
  for (const auto& [id, landmark] : map.landmarks<L>()) {
    const std::string violation = LandmarkViolation(map, id, landmark);
    if (!violation.empty()) return L::kName + (" " + std::to_string(id)) + ": " + violation;
  }
  return "";
}

}  // namespace

std::string FirstViolation(const Map& map) {
  for (const auto& [id, keyframe] : map.keyframes()) {
    const std::string violation = KeyframeViolation(map, id, keyframe);
    if (!violation.empty()) return "keyframe " + std::to_string(id) + ": " + violation;
  }
  std::string violation;
  ForEachLandmarkKind([&](auto kind) {
    if (violation.empty()) violation = KindViolation<typename decltype(kind)::Landmark>(map);
  });
  return violation;
}

}  // namespace msc_vo
