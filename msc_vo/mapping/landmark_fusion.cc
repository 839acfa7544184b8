// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/mapping/landmark_fusion.h"

#include <memory>
#include <utility>
#include <vector>

namespace msc_vo {

namespace {

// Search radius around a projected landmark, pixels at level 0. Both poses are estimated, so that
// the landmark's own error remains: about three sigmas of a feature.
constexpr double kFusionRadius = 3.0;

std::vector<KeyframeId> Neighbours(const FusionOptions& options, const Map& map, KeyframeId id) {
  std::vector<KeyframeId> neighbours;
  for (const Map::Covisible& covisible : map.FindCovisible(id)) {
    if (static_cast<int>(neighbours.size()) == options.max_neighbours) break;
    neighbours.push_back(covisible.keyframe);
  }
  return neighbours;
}

// Returns the landmark that survives a merge, and the one that is merged into it.
template <typename L>
std::pair<LandmarkId, LandmarkId> SelectSurvivor(const L& a, const L& b) {
  const bool a_stays = a.observations.size() != b.observations.size()
                           ? a.observations.size() > b.observations.size()
                           : a.id < b.id;
  return a_stays ? std::make_pair(a.id, b.id) : std::make_pair(b.id, a.id);
}

// The landmarks of keyframe `source` that project into `target`, which does not observe them.
template <typename L>
Candidates<L> CandidatesFor(const Map& map, const Keyframe& source, const Keyframe& target) {
  const Viewpoint view(*target.frame, target.cam_from_world);
  Candidates<L> candidates;
  for (const LandmarkId id : SlotsOf<L>(source)) {
    const L* landmark = map.Find<L>(id);
    if (landmark == nullptr || FindObservation(*landmark, target.id) != nullptr) continue;
    auto candidate = CandidateOf(*landmark);
    SetLevel(view, *landmark, &candidate);
    if (ProjectCandidate(target.frame->camera, target.cam_from_world, &candidate)) {
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

template <typename L>
void FuseInto(const FusionOptions& options, KeyframeId source, KeyframeId target, Map* map) {
  const Keyframe& shown = *map->FindKeyframe(target);
  const Matches<L> matches =
      MatchFeatures(options.matchers, *shown.frame,
                    CandidatesFor<L>(*map, *map->FindKeyframe(source), shown), kFusionRadius, {});
  for (const auto& match : matches) {
    const L* landmark = map->Find<L>(match.id);
    if (landmark == nullptr) continue;                      // merged by an earlier match
    const Keyframe& keyframe = *map->FindKeyframe(target);  // earlier matches changed it
    const typename L::Feature& feature = FeaturesOf<L>(*keyframe.frame)[match.feature];
    if (!landmark->AgreesWithDepth(keyframe.cam_from_world, feature)) continue;
    const L* holder = map->Find<L>(SlotsOf<L>(keyframe)[match.feature]);
    if (holder == nullptr) {
      map->Observe<L>(match.id, target, match.feature);
    } else if (holder->id != match.id &&
               L::AreDuplicates(keyframe.cam_from_world.OriginInSource(), *landmark, *holder)) {
      const auto [survivor, duplicate] = SelectSurvivor(*landmark, *holder);
      map->MergeLandmarks<L>(duplicate, survivor);
    }
  }
}

}  // namespace

void FuseLandmarks(const FusionOptions& options, KeyframeId id, Map* map) {
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    for (const KeyframeId neighbour : Neighbours(options, *map, id)) {
      FuseInto<L>(options, id, neighbour, map);
      FuseInto<L>(options, neighbour, id, map);
    }
  });
}

void FuseAllLandmarks(const FusionOptions& options, Map* map) {
  std::vector<KeyframeId> keyframes;
  for (const auto& [id, keyframe] : map->keyframes()) keyframes.push_back(id);
  for (const KeyframeId id : keyframes) FuseLandmarks(options, id, map);
}

}  // namespace msc_vo
