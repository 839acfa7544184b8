// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/place_recognition/place_index.h"

#include <memory>
#include <random>
#include <utility>

#include "tests/place_recognition/random_features.h"
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

constexpr int kNumPlaces = 60;

// Frames of places that have nothing in common.
class PlaceIndexTest : public testing::Test {
 protected:
  PlaceIndexTest() {
    for (int i = 0; i < kNumPlaces; ++i) frames_.push_back(RandomFeatures(400, 60, &random_));
  }

  // Another view of a place.
  Frame Seen(int place) { return WithFlippedBits(frames_[place], 0.1, &random_); }

  std::mt19937 random_{7};
  std::vector<Frame> frames_;
};

std::shared_ptr<const Frame> Shared(const Frame& frame) {
  return std::make_shared<const Frame>(frame);
}

std::vector<std::pair<KeyframeId, double>> Pairs(const std::vector<Place>& places) {
  std::vector<std::pair<KeyframeId, double>> pairs;
  for (const Place& place : places) pairs.emplace_back(place.keyframe, place.score);
  return pairs;
}

TEST_F(PlaceIndexTest, FindsEveryPlaceInAnotherView) {
  PlaceIndex index;
  for (int i = 0; i < kNumPlaces; ++i) index.Add(i, Shared(frames_[i]));
  for (int i = 0; i < kNumPlaces; ++i) {
    const std::vector<Place> places = index.Query(Seen(i), 2);
    ASSERT_EQ(places.size(), 2u);
    EXPECT_EQ(places[0].keyframe, i);
    EXPECT_GT(places[0].score, 2.0 * places[1].score);
  }
}

TEST_F(PlaceIndexTest, FindsPlacesByTheirLinesAlone) {
  PlaceIndex index;
  for (int i = 0; i < kNumPlaces; ++i) index.Add(i, Shared(frames_[i]));
  for (int i = 0; i < kNumPlaces; ++i) {
    Frame seen = Seen(i);
    seen.points.clear();
    EXPECT_EQ(index.Query(seen, 1).at(0).keyframe, i);
  }
}

TEST_F(PlaceIndexTest, DependsOnItsKeyframesAlone) {
  PlaceIndex straight, detour;
  for (int i = 0; i < 40; ++i) straight.Add(i, Shared(frames_[i]));
  for (int i = kNumPlaces - 1; i >= 20; --i) detour.Add(i, Shared(frames_[i]));
  for (int i = 40; i < kNumPlaces; ++i) detour.Remove(i);
  for (int i = 0; i < 20; ++i) detour.Add(i, Shared(frames_[i]));
  detour.Remove(1000);  // no effect
  EXPECT_EQ(detour.size(), straight.size());
  const Frame seen = Seen(30);
  EXPECT_EQ(Pairs(detour.Query(seen, kNumPlaces)), Pairs(straight.Query(seen, kNumPlaces)));
}

// Words are renumbered a share at a time, while keyframes come and go.
TEST_F(PlaceIndexTest, IsTheSameWhileItIsRenumbered) {
  PlaceIndex index;
  KeyframeId next = 0, oldest = 0;
  const auto frame_of = [this](KeyframeId id) { return Shared(frames_[id % kNumPlaces]); };
  const auto add = [&] { index.Add(next, frame_of(next)), ++next; };
  for (int i = 0; i < 400; ++i) add();
  const Frame seen = Seen(30);
  for (int i = 0; i < 1500; ++i) {
    index.Remove(oldest++);
    add();
    if (i % 100 != 50) continue;
    PlaceIndex straight;
    for (KeyframeId id = oldest; id < next; ++id) straight.Add(id, frame_of(id));
    ASSERT_EQ(Pairs(index.Query(seen, 400)), Pairs(straight.Query(seen, 400))) << i;
  }
}

TEST_F(PlaceIndexTest, RanksEqualScoresFromNewestToOldest) {
  PlaceIndex index;
  for (const int id : {5, 9, 2}) index.Add(id, Shared(frames_[0]));
  index.Add(1, Shared(frames_[1]));
  EXPECT_THAT(
      index.Query(frames_[0], 3),
      testing::ElementsAre(testing::Field(&Place::keyframe, 9), testing::Field(&Place::keyframe, 5),
                           testing::Field(&Place::keyframe, 2)));
}

TEST_F(PlaceIndexTest, FindsNothingWithoutCommonWords) {
  PlaceIndex index;
  EXPECT_THAT(index.Query(frames_[0], 5), testing::IsEmpty());
  index.Add(1, Shared({}));
  EXPECT_THAT(index.Query(frames_[0], 5), testing::IsEmpty());
  EXPECT_THAT(index.Query(Frame(), 5), testing::IsEmpty());
}

TEST_F(PlaceIndexTest, FollowsTheKeyframesOfAllMaps) {
  const auto add = [this](int id, Map* map) {
    map->AddKeyframe(std::make_shared<const Frame>(frames_[id]), Rigid3(), id);
  };
  MapSnapshot snapshot;
  for (const int id : {3, 4, 6}) add(id, &snapshot.map);
  Map inactive;
  for (const int id : {0, 2}) add(id, &inactive);
  snapshot.inactive_maps = {std::make_shared<const Map>(std::move(inactive))};
  PlaceIndex index;
  index.Add(1, Shared(frames_[1]));  // that has been culled
  index.Update(snapshot);
  EXPECT_EQ(index.size(), 5);
  for (const int id : {0, 2, 3, 4, 6}) {
    EXPECT_EQ(index.Query(Seen(id), 1).at(0).keyframe, id);
  }
  EXPECT_THAT(index.Query(Seen(1), 5),
              testing::Each(testing::Field(&Place::keyframe, testing::Ne(1))));
}

}  // namespace
}  // namespace msc_vo
