// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <tuple>

#include "tests/map_file/random_map.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <sqlite3.h>

#include "msc_vo/map_file/internal/row.h"
#include "msc_vo/map_file/internal/sqlite_database.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"

namespace msc_vo {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class MapFileDamageTest : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    path_ = Path("home.map");
    SaveMap(path_, AsContents(random_.Make(4)), [](KeyframeId id) {
      return id < 3 ? "\xff\xd8\xff" + std::string(500, static_cast<char>(id)) : "";
    });
  }

  // Changes the file by SQL, as another program would.
  void Change(const std::string& sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
    char* error = nullptr;
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &error), SQLITE_OK) << error;
    sqlite3_close(database);
  }
  std::string Problem() const {
    return MessageOf([this] { LoadMap(path_); });
  }
  std::string Read() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void Write(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  }

  RandomMap random_;
  std::string path_;
};

TEST_F(MapFileDamageTest, RefusesFilesOfOthers) {
  EXPECT_THAT(MessageOf([&] { LoadMap(Path("none.map")); }),
              Names(Path("none.map"), "does not exist"));
  EXPECT_FALSE(std::filesystem::exists(Path("none.map")));
  WriteText("text.map", std::string(5000, 'x'));
  for (const auto& open : {+[](const std::string& path) { LoadMap(path); },
                           +[](const std::string& path) { MapWriter writer(path); },
                           +[](const std::string& path) { SummarizeMap(path); }}) {
    EXPECT_THAT(MessageOf([&] { open(Path("text.map")); }), Names(Path("text.map"), "no map"));
    EXPECT_THAT(MessageOf([&] { open(Folder()); }), Names(Folder(), "folder"));
  }
  EXPECT_EQ(std::filesystem::file_size(Path("text.map")), 5000u);
  WriteText("note.map", "a note");
  EXPECT_THAT(MessageOf([&] { MapWriter writer(Path("note.map")); }),
              Names(Path("note.map"), "no map"));
  EXPECT_EQ(std::filesystem::file_size(Path("note.map")), 6u);
  Change("PRAGMA application_id = 7");
  EXPECT_THAT(Problem(), Names(path_, "no map"));
  EXPECT_THAT(MessageOf([&] { MapWriter writer(path_); }), Names(path_, "no map"));
}

// A run that was killed before its first write leaves an empty file.
TEST_F(MapFileDamageTest, WritesIntoEmptyFileAndSaysThatItIsEmpty) {
  Write("");
  EXPECT_THAT(Problem(), Names(path_, "empty"));
  SaveMap(path_, AsContents(random_.Make(2)));
  EXPECT_EQ(LoadMap(path_).submaps[0].map.keyframes().size(), 2u);
}

TEST_F(MapFileDamageTest, RefusesNewerVersion) {
  Change("PRAGMA user_version = 6");
  EXPECT_THAT(Problem(), Names(path_, "version 6", "newer msc_vo"));
  EXPECT_THAT(MessageOf([&] { MapWriter writer(path_); }), Names(path_, "version 6"));
}

TEST_F(MapFileDamageTest, RefusesOtherTables) {
  for (const char* sql : {"DROP TABLE loop", "CREATE TABLE other (id)",
                          "CREATE TRIGGER t AFTER INSERT ON point BEGIN DELETE FROM line; END",
                          "DROP TABLE point; CREATE VIEW point AS SELECT * FROM line"}) {
    SaveMap(Path("fresh.map"), AsContents(random_.Make(2)));
    path_ = Path("fresh.map");
    Change(sql);
    EXPECT_THAT(Problem(), Names(path_, "damaged")) << sql;
    std::filesystem::remove(path_);
  }
}

TEST_F(MapFileDamageTest, RefusesRowsThatDoNotFit) {
  const std::string valid = Read();
  for (const char* sql : {"UPDATE point SET x = x + 1 WHERE id = 3",
                          "UPDATE point SET id = 100000 WHERE id = 3",
                          "UPDATE point SET noise = 'much' WHERE id = 3",
                          "DELETE FROM point WHERE id = 3",
                          "DELETE FROM line WHERE id = (SELECT min(id) FROM line)",
                          "DELETE FROM keyframe WHERE id = 1",
                          "DELETE FROM features WHERE keyframe = 1",
                          "DELETE FROM features WHERE keyframe = 3",
                          "DELETE FROM submap",
                          "DELETE FROM map",
                          "DELETE FROM calibration",
                          "UPDATE keyframe SET submap = 4",
                          "UPDATE keyframe SET qx = 1e400 WHERE id = 1",
                          "UPDATE features SET points = substr(points, 1, 30) WHERE keyframe = 1",
                          "UPDATE features SET points = x'' WHERE keyframe = 2",
                          "UPDATE features SET lines = zeroblob(length(lines)) WHERE keyframe = 1",
                          "UPDATE features SET timestamp = timestamp + 1 WHERE keyframe = 1",
                          "UPDATE session SET first_keyframe = 2",
                          "UPDATE map SET next_keyframe = 1",
                          "UPDATE submap SET point_depth_noise = 2.0",
                          "UPDATE calibration SET fx = fx + 1",
                          "UPDATE calibration SET lens = 'glass'",
                          "UPDATE false_depth SET landmark = 100000 WHERE landmark = (SELECT "
                          "min(landmark) FROM false_depth)",
                          "UPDATE false_depth SET checksum = checksum + 1",
                          "INSERT INTO false_depth VALUES (-1, 0)",
                          "UPDATE image SET checksum = checksum + 1",
                          "UPDATE image SET keyframe = 3 WHERE keyframe = 2",
                          "UPDATE image SET jpeg = substr(jpeg, 1, 100) WHERE keyframe = 1",
                          "UPDATE image SET jpeg = 'text' WHERE keyframe = 1"}) {
    Write(valid);
    Change(sql);
    EXPECT_THAT(Problem(), Names(path_, "damaged")) << sql;
    EXPECT_THAT(MessageOf([this] { CheckMap(path_); }), Names(path_, "damaged")) << sql;
  }
  Write(valid);
  EXPECT_THAT(Problem(), IsEmpty());
}

// A row with a checksum that fits, of a keyframe that does not exist or that is no JPEG file.
TEST_F(MapFileDamageTest, RefusesImagesThatDoNotFit) {
  const std::string valid = Read();
  for (const auto& [keyframe, jpeg, reason] :
       {std::tuple(9, "\xff\xd8\xff", "keyframe"), std::tuple(3, "\xff\xd8", "JPEG")}) {
    Write(valid);
    {
      const SqliteDatabase database(path_, SqliteDatabase::Access::kWrite);
      SqliteStatement insert = PrepareUpsert(database, "image", 3);
      RowWriter(&insert).Integer(keyframe).Blob(jpeg).Execute();
    }
    EXPECT_THAT(Problem(), Names(path_, "damaged", "table image", reason));
  }
}

// The map that replaces a damaged one has no damage.
TEST_F(MapFileDamageTest, DropsDamagedImagesOfAMapThatIsReplaced) {
  MapContents contents = LoadMap(path_);
  Change("UPDATE image SET jpeg = substr(jpeg, 1, 100) WHERE keyframe = 1");
  SaveMap(path_, std::move(contents));
  EXPECT_THAT(Problem(), IsEmpty());
  EXPECT_THAT(MapImages(path_).Keyframes(), testing::ElementsAre(0, 2));
}

// Changes and the reasons why they are refused.
struct Damage {
  std::string sql, reason;
};

// Replaces bytes of the first plane of a keyframe: 3 numbers of 4 bytes are the plane, 6 its
// covariance, 6 the mean of squared rays.
std::string ReplacePlaneBytes(int offset, const std::string& hex) {
  const auto size = static_cast<int>(hex.size() / 2);
  return "UPDATE plane_features SET planes = CAST(substr(planes, 1, " + std::to_string(offset) +
         ") || x'" + hex + "' || substr(planes, " + std::to_string(offset + size + 1) +
         ") AS BLOB) WHERE keyframe = 1";
}

class PlaneDamageTest : public MapFileDamageTest {
 protected:
  void SetUp() override {
    MapFileDamageTest::SetUp();
    std::filesystem::remove(path_);
    MapContents contents;
    contents.sessions.push_back({0, "first"});
    contents.submaps.push_back(WithPlanes(random_.Make(4)));
    SaveMap(path_, std::move(contents));
    valid_ = Read();
    ASSERT_THAT(Problem(), IsEmpty());
  }
  void ExpectRefused(const std::vector<Damage>& damages) const {
    for (const Damage& damage : damages) {
      Write(valid_);
      Change(damage.sql);
      EXPECT_THAT(Problem(), Names(path_, "damaged", damage.reason)) << damage.sql;
    }
  }

  std::string valid_;
};

TEST_F(PlaneDamageTest, RefusesPlanesThatDoNotFit) {
  ExpectRefused(
      {{"UPDATE plane SET d = d + 1 WHERE id = 1", "its extent is elsewhere"},
       {"UPDATE plane SET nx = 2 WHERE id = 1", "its parameters are not valid"},
       {"UPDATE plane SET id = -1 WHERE id = 1", "its id is not possible"},
       {"UPDATE plane SET id = 1 << 34 WHERE id = 4", "its id is not possible"},
       {"UPDATE plane SET submap = 4", "its submap does not exist"},
       {"UPDATE plane SET host = 9 WHERE id = 1", "its host does not exist"},
       {"UPDATE plane SET extent = substr(extent, 1, 8) WHERE id = 1", "too few bytes"},
       {"UPDATE plane SET extent = x'01000000000000000000000000' WHERE id = 1",
        "a polygon of one or two vertices"},
       {"UPDATE plane SET extent = CAST(extent || x'00' AS BLOB) WHERE id = 1", "too many bytes"},
       {"UPDATE submap SET plane_noise = 0", "noise"}});
}

TEST_F(PlaneDamageTest, RefusesObservationsThatDoNotFit) {
  ExpectRefused(
      {{"UPDATE plane SET observations = x'' WHERE id = 1", "no keyframe observes it"},
       {"UPDATE plane SET observations = x'1000' WHERE id = 1",
        "a keyframe that observes it is not in its submap"},
       {"UPDATE plane SET observations = x'0008' WHERE id = 1",
        "a feature that observes it does not exist"},
       {"UPDATE plane SET observations = x'0000' WHERE id = 2", "a feature observes two planes"},
       {"UPDATE plane SET observations = x'0000' WHERE id = 0", "its checksum does not fit"},
       // Feature 1 of keyframe 2, then of the one before it.
       {"UPDATE plane SET observations = x'04020102' WHERE id = 1",
        "its keyframes are not in order"},
       // Feature 1 of keyframe 1, then of the one that is as much later as 64 bits can say.
       {"UPDATE plane SET observations = x'0202feffffffffffffffff0102' WHERE id = 1",
        "its keyframes are not in order"}});
}

TEST_F(PlaneDamageTest, RefusesFeaturesThatDoNotFit) {
  ExpectRefused(
      {{"UPDATE plane_features SET planes = substr(planes, 1, 30)", "too few bytes"},
       {"UPDATE plane_features SET planes = zeroblob(length(planes))", "a plane at infinity"},
       {"UPDATE plane_features SET planes = x'' WHERE keyframe = 1", "checksum"},
       {"UPDATE plane_features SET keyframe = 9 WHERE keyframe = 1", "checksum"},
       {"DELETE FROM plane_features WHERE keyframe = 1", "does not exist"},
       {ReplacePlaneBytes(0, "0000c07f"), "a number that is not finite"},
       {ReplacePlaneBytes(12, "000080bf"), "a covariance that is not positive"},
       {ReplacePlaneBytes(12, "00000000"), "a covariance that is not positive"},
       // Means of the squared rays: -1 in x, 1.5 in x and y together, 2 and 1.00001 in z.
       {ReplacePlaneBytes(36, "000080bf"), "a mean of squared rays that is not possible"},
       {ReplacePlaneBytes(40, "0000c03f"), "a mean of squared rays that is not possible"},
       {ReplacePlaneBytes(56, "00000040"), "a mean of squared rays that is not possible"},
       {ReplacePlaneBytes(56, "5400803f"), "a mean of squared rays that is not possible"},
       {ReplacePlaneBytes(60, "000000"), "a plane without pixels"},
       {ReplacePlaneBytes(63, "0d"), "a hull of too many vertices"},
       {ReplacePlaneBytes(63, "02"), "a polygon of one or two vertices"}});
}

// Other programs may order vertices in another way.
TEST_F(PlaneDamageTest, TurnsPolygonsCounterclockwise) {
  MapContents contents = LoadMap(path_);
  SavedSubMap& submap = contents.submaps[0];
  const Keyframe& keyframe = *submap.map.FindKeyframe(1);
  const ConvexPolygon hull = keyframe.frame->planes[2].hull;
  const auto frame = std::make_shared<Frame>(*keyframe.frame);
  std::reverse(frame->planes[2].hull.begin(), frame->planes[2].hull.end());
  submap.map.SetFrame(1, frame);
  const PlaneExtent extent = submap.planes.planes.at(1).extent;
  std::reverse(submap.planes.planes.at(1).extent.begin(), submap.planes.planes.at(1).extent.end());
  SaveMap(Path("turned.map"), std::move(contents));
  const MapContents loaded = LoadMap(Path("turned.map"));
  EXPECT_EQ(loaded.submaps[0].map.FindKeyframe(1)->frame->planes[2].hull, hull);
  const PlaneExtent& turned = loaded.submaps[0].planes.planes.at(1).extent;
  ASSERT_EQ(turned.size(), extent.size());
  for (size_t i = 0; i < extent.size(); ++i) EXPECT_LT((turned[i] - extent[i]).norm(), 1e-6);
}

// Every changed byte is noticed, or belongs to no row.
TEST_F(MapFileDamageTest, NoticesChangedBytes) {
  const std::string valid = Read();
  std::mt19937 random(3);
  int num_noticed = 0;
  for (int i = 0; i < 150; ++i) {
    std::string bytes = valid;
    bytes[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
    Write(bytes);
    const std::string problem = Problem();
    if (!problem.empty()) {
      ++num_noticed;
      EXPECT_THAT(problem, Names(path_));
      continue;
    }
    const MapContents loaded = LoadMap(path_);
    ASSERT_EQ(loaded.submaps.size(), 1u);
    EXPECT_EQ(loaded.submaps[0].map.keyframes().size(), 4u);
  }
  EXPECT_GT(num_noticed, 15);
}

TEST_F(MapFileDamageTest, RefusesFileTruncatedAnywhere) {
  const std::string valid = Read();
  for (size_t size = 1; size < valid.size(); size = size * 9 / 8 + 97) {
    Write(valid.substr(0, size));
    EXPECT_THAT(Problem(), Names(path_)) << size;
    EXPECT_THAT(MessageOf([&] { MapWriter(path_).Load(); }), Names(path_)) << size;
    EXPECT_TRUE(Read() == valid.substr(0, size)) << size;
  }
  Write(valid.substr(0, valid.size() - 1));
  EXPECT_THAT(MessageOf([&] { SummarizeMap(path_); }), Names(path_, "truncated"));
}

}  // namespace
}  // namespace msc_vo
