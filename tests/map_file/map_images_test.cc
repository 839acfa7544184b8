// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/map_images.h"

#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include "tests/map_file/random_map.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>

#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"

namespace msc_vo {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Bytes that begin as a JPEG file does, different for each keyframe and `series`.
std::string ImageOf(KeyframeId id, char series) {
  return "\xff\xd8\xff" + std::string(1000, series) + std::to_string(id);
}

// Images of the keyframes with even ids.
KeyframeImageSource EvenImages(char series) {
  return [series](KeyframeId id) { return id % 2 == 0 ? ImageOf(id, series) : ""; };
}

class MapImagesTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    path_ = Path("home.map");
  }
  // The images of a file, as one text for each keyframe that has one.
  std::map<KeyframeId, std::string> Images(const std::string& path) const {
    const MapImages images(path);
    std::map<KeyframeId, std::string> all;
    for (const KeyframeId id : images.Keyframes()) all[id] = images.Read(id);
    return all;
  }
  // Of a file that a writer has open.
  std::map<KeyframeId, std::string> ImagesOfCopy() const {
    std::filesystem::copy_file(path_, Path("copy.map"),
                               std::filesystem::copy_options::overwrite_existing);
    EXPECT_NO_THROW(CheckMap(Path("copy.map")));
    return Images(Path("copy.map"));
  }

  RandomMap random_;
  std::string path_;
};

std::vector<KeyframeId> KeysOf(const std::map<KeyframeId, std::string>& images) {
  std::vector<KeyframeId> keys;
  for (const auto& [id, jpeg] : images) keys.push_back(id);
  return keys;
}

TEST_F(MapImagesTest, ReadsTheImagesThatWereWritten) {
  SaveMap(path_, AsContents(random_.Make(5)), EvenImages('a'));
  EXPECT_NO_THROW(CheckMap(path_));
  EXPECT_EQ(SummarizeMap(path_).num_images, 3);
  const auto images = Images(path_);
  EXPECT_THAT(KeysOf(images), ElementsAre(0, 2, 4));
  for (const auto& [id, jpeg] : images) EXPECT_EQ(jpeg, ImageOf(id, 'a'));
  EXPECT_THAT(MapImages(path_).Read(1), IsEmpty());
}

// A run gives an image once, changes the map, and culls a keyframe.
TEST_F(MapImagesTest, KeepsTheImagesOfKeyframesThatAreLeft) {
  Map map = random_.Make(5);
  MapWriter writer(path_);
  EXPECT_THAT(writer.ReadImage(0), IsEmpty());
  writer.Write(AsContents(map.Share()), EvenImages('a'));
  EXPECT_EQ(writer.ReadImage(2), ImageOf(2, 'a'));
  map.SetPose(2, random_.Pose());
  random_.AddKeyframe(&map);
  random_.AddKeyframe(&map);
  map.RemoveKeyframe(4, 3);
  writer.Write(AsContents(map.Share()), EvenImages('b'));
  const auto images = ImagesOfCopy();
  EXPECT_THAT(KeysOf(images), ElementsAre(0, 2, 6));
  EXPECT_EQ(images.at(2), ImageOf(2, 'a'));
  EXPECT_EQ(images.at(6), ImageOf(6, 'b'));
  EXPECT_THAT(writer.ReadImage(4), IsEmpty());
}

// A frame of another calibration shows the same image.
TEST_F(MapImagesTest, KeepsAnImageWhereNoneIsKnownForTheNewFrame) {
  Map map = random_.Make(3);
  MapWriter writer(path_);
  writer.Write(AsContents(map.Share()), EvenImages('a'));
  for (const KeyframeId id : {0, 2}) {
    map.SetFrame(id, std::make_shared<Frame>(*map.FindKeyframe(id)->frame));
  }
  writer.Write(AsContents(map.Share()),
               [](KeyframeId id) { return id == 0 ? ImageOf(0, 'b') : ""; });
  const auto images = ImagesOfCopy();
  EXPECT_THAT(KeysOf(images), ElementsAre(0, 2));
  EXPECT_EQ(images.at(0), ImageOf(0, 'b'));
  EXPECT_EQ(images.at(2), ImageOf(2, 'a'));
}

// Adds a session of two keyframes, in a submap of its own.
void AddSession(RandomMap* random, MapContents* contents) {
  const Map& last = contents->submaps.back().map;
  contents->sessions.push_back({last.next_keyframe(), "later"});
  Map own = random->Make(2, last);
  contents->submaps.push_back({contents->submaps.back().id + 1, std::move(own), {}, {}});
}

TEST_F(MapImagesTest, KeepsTheImagesOfEarlierSessions) {
  SaveMap(path_, AsContents(random_.Make(3)), EvenImages('a'));
  const auto own = [](KeyframeId id) { return id == 4 ? ImageOf(4, 'b') : ""; };
  const auto expect_both = [](const std::map<KeyframeId, std::string>& images) {
    EXPECT_THAT(KeysOf(images), ElementsAre(0, 2, 4));
    EXPECT_EQ(images.at(0), ImageOf(0, 'a'));
    EXPECT_EQ(images.at(4), ImageOf(4, 'b'));
  };
  std::filesystem::copy_file(path_, Path("saved.map"));
  {
    MapWriter writer(path_);
    MapContents contents = writer.Load();
    AddSession(&random_, &contents);
    writer.Write(std::move(contents), own);
    expect_both(ImagesOfCopy());
  }
  MapContents contents = LoadMap(Path("saved.map"));
  AddSession(&random_, &contents);
  SaveMap(Path("saved.map"), std::move(contents), own);
  expect_both(Images(Path("saved.map")));
}

// Other maps have keyframes with the same ids.
TEST_F(MapImagesTest, ReplacesTheImagesOfAnotherMap) {
  const KeyframeImageSource images = EvenImages('a');
  SaveMap(path_, AsContents(random_.Make(3)), images);
  SaveMap(path_, AsContents(random_.Make(3)));
  EXPECT_THAT(Images(path_), IsEmpty());

  Map map = random_.Make(3);
  SaveMap(path_, AsContents(map.Share()), images);
  MapContents renamed = AsContents(map.Share());
  renamed.sessions[0].name = "second";
  SaveMap(path_, std::move(renamed));
  EXPECT_THAT(Images(path_), IsEmpty());

  MapContents two = AsContents(map.Share());
  two.sessions.push_back({2, "second"});
  SaveMap(path_, std::move(two), images);
  two = AsContents(map.Share());
  two.sessions.push_back({1, "second"});
  SaveMap(path_, std::move(two));
  EXPECT_THAT(KeysOf(Images(path_)), ElementsAre(0));
}

// Replaces the frames of the keyframes by copies that `change` has changed.
template <typename Change>
void ChangeFrames(const Change& change, Map* map) {
  for (KeyframeId id = 0; id < map->next_keyframe(); ++id) {
    const auto frame = std::make_shared<Frame>(*map->FindKeyframe(id)->frame);
    for (PointFeature& point : frame->points) change(&point);
    for (LineFeature& line : frame->lines) change(&line);
    map->SetFrame(id, frame);
  }
}

// Sequences may agree in their names, and in numbers and time stamps of their images.
TEST_F(MapImagesTest, KeepsOnlyImagesOfKeyframesWithTheSameFeatures) {
  Map map = random_.Make(3);
  SaveMap(path_, AsContents(map.Share()), EvenImages('a'));
  map.Remove<PointLandmark>(map.points().front().first);
  ChangeFrames([](auto* feature) { feature->sigma *= 1.5; }, &map);
  SaveMap(path_, AsContents(map.Share()));
  EXPECT_THAT(KeysOf(Images(path_)), ElementsAre(0, 2));
  ChangeFrames([](auto* feature) { feature->descriptor[7] ^= 1; }, &map);
  SaveMap(path_, AsContents(map.Share()));
  EXPECT_THAT(Images(path_), IsEmpty());
}

// Numbers and time stamps of images may be the same in any two sequences.
TEST_F(MapImagesTest, KeepsNoImagesOfASessionWithoutAName) {
  Map map = random_.Make(3);
  for (const char* name : {"", "room"}) {
    MapContents contents = AsContents(map.Share());
    contents.sessions[0].name = name;
    SaveMap(path_, std::move(contents), EvenImages('a'));
    contents = AsContents(map.Share());
    contents.sessions[0].name = name;
    SaveMap(path_, std::move(contents));
    EXPECT_EQ(Images(path_).empty(), std::string(name).empty());
  }
}

TEST_F(MapImagesTest, KeepsTheImagesOfASessionWithANameAfterOneWithout) {
  MapContents contents = AsContents(random_.Make(3));
  contents.sessions[0].name = "";
  AddSession(&random_, &contents);  // of keyframes 3 and 4
  SaveMap(path_, std::move(contents), EvenImages('a'));
  contents = LoadMap(path_);
  AddSession(&random_, &contents);
  SaveMap(path_, std::move(contents));
  EXPECT_THAT(KeysOf(Images(path_)), ElementsAre(4));
}

TEST_F(MapImagesTest, RefusesWhatIsNoSmallJpeg) {
  Map map = random_.Make(2);
  SaveMap(path_, AsContents(map.Share()), EvenImages('a'));
  for (const std::string& bytes : {std::string("GIF89a"), std::string("\xff\xd8"),
                                   "\xff\xd8\xff" + std::string(kMaxMapImageBytes - 2, 'a')}) {
    EXPECT_THROW(SaveMap(path_, AsContents(map.Share()), [&](KeyframeId /*id*/) { return bytes; }),
                 std::invalid_argument);
  }
  EXPECT_EQ(Images(path_).at(0), ImageOf(0, 'a'));
  const std::string largest = "\xff\xd8\xff" + std::string(kMaxMapImageBytes - 3, 'a');
  SaveMap(path_, AsContents(map.Share()), [&](KeyframeId /*id*/) { return largest; });
  EXPECT_EQ(Images(path_).at(1), largest);
}

}  // namespace
}  // namespace msc_vo
