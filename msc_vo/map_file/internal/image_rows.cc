// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/image_rows.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include "msc_vo/map_file/internal/blob.h"
#include "msc_vo/map_file/internal/feature_blob.h"
#include "msc_vo/map_file/internal/map_schema.h"
#include "msc_vo/map_file/internal/row.h"
#include "msc_vo/map_file/map_images.h"

namespace msc_vo {

namespace {

constexpr char kTable[] = "image";

bool IsJpeg(std::string_view bytes) {
  constexpr std::string_view kBegin = "\xff\xd8\xff";
  return bytes.size() <= kMaxMapImageBytes && bytes.substr(0, kBegin.size()) == kBegin;
}

bool HasImages(const SqliteDatabase& database) {
  return SchemaVersion(database) >= kFirstVersionWithImages;
}

// A row of the table.
struct Image {
  KeyframeId keyframe = kNoId;
  std::string_view jpeg;  // valid until the next step
};

Image ReadRow(const SqliteStatement& rows, const std::string& path) {
  RowReader row(rows, path, kTable);
  Image image;
  image.keyframe = row.Integer();
  image.jpeg = row.Blob();
  row.Finish();
  if (!IsJpeg(image.jpeg)) row.Fail("it is no JPEG file of at most 64 KB");
  return image;
}

// Whether images of a session are kept, by its first keyframe.
using KeptSessions = std::map<KeyframeId, bool>;

// Keeps sessions that are the same in the file and in `sessions`, without those that have no name
// and may be of any sequence.
KeptSessions SelectSessions(const SqliteDatabase& database,
                            const std::vector<MapSession>& sessions) {
  SqliteStatement rows = database.Prepare("SELECT first_keyframe, name FROM session ORDER BY id");
  KeptSessions kept;
  for (const MapSession& session : sessions) {
    const bool is_in_file = rows.Step();
    const KeyframeId first = is_in_file ? rows.Integer(0) : session.first_keyframe;
    const bool is_same =
        is_in_file && first == session.first_keyframe && rows.Bytes(1) == session.name;
    kept[std::min(first, session.first_keyframe)] = is_same && !session.name.empty();
    if (!is_same) return kept;
  }
  if (rows.Step()) kept[rows.Integer(0)] = false;
  return kept;
}

bool AreKept(const KeptSessions& sessions, KeyframeId keyframe) {
  const auto next = sessions.upper_bound(keyframe);
  return next != sessions.begin() && std::prev(next)->second;
}

bool IsUndamaged(const SqliteDatabase& database, KeyframeId id) {
  try {
    return !ReadImage(database, id).empty();
  } catch (const std::runtime_error&) {
    return false;
  }
}

// Features of a keyframe in the file, compared with those of a keyframe in memory.
struct SharedFeatures {
  size_t num_possible = 0;  // no more than either keyframe has
  size_t num_shared = 0;    // with the same descriptor

  template <typename L>
  void Add(const Frame& frame, std::string_view blob) {
    using Feature = typename L::Feature;
    std::vector<Feature> stored;
    DecodeFeatures(blob, &stored);
    std::set<Descriptor> descriptors;
    for (const Feature& feature : FeaturesOf<L>(frame)) descriptors.insert(feature.descriptor);
    num_possible += std::min(stored.size(), FeaturesOf<L>(frame).size());
    for (const Feature& feature : stored) num_shared += descriptors.count(feature.descriptor);
  }
};

// Whether a frame can be that of a keyframe in the file, of which it shares half of the features or
// more. Pixels change with the calibration, and landmarks decide which features are stored.
bool ShowsFeatures(const Frame& frame, std::string_view points, std::string_view lines) {
  SharedFeatures features;
  try {
    features.Add<PointLandmark>(frame, points);
    features.Add<LineLandmark>(frame, lines);
  } catch (const BlobError&) {
    return false;
  }
  return features.num_shared > 0 && 2 * features.num_shared >= features.num_possible;
}

}  // namespace

void WriteImage(KeyframeId id, const std::string& jpeg, SqliteStatement* upsert) {
  if (!IsJpeg(jpeg)) {
    throw std::invalid_argument("map file: the image of keyframe " + std::to_string(id) +
                                " must be a JPEG file of at most 64 KB");
  }
  RowWriter(upsert).Integer(id).Blob(jpeg).Execute();
}

std::vector<KeyframeId> ListImages(const SqliteDatabase& database) {
  std::vector<KeyframeId> ids;
  if (!HasImages(database)) return ids;
  SqliteStatement rows = database.Prepare("SELECT keyframe FROM image ORDER BY keyframe");
  while (rows.Step()) ids.push_back(rows.Integer(0));
  return ids;
}

std::string ReadImage(const SqliteDatabase& database, KeyframeId id) {
  if (!HasImages(database)) return "";
  SqliteStatement rows = database.Prepare("SELECT * FROM image WHERE keyframe = ?");
  rows.Bind(0, id);
  return rows.Step() ? std::string(ReadRow(rows, database.path()).jpeg) : "";
}

void CheckImages(const SqliteDatabase& database, const MapContents& contents) {
  if (!HasImages(database)) return;
  SqliteStatement rows = database.Prepare("SELECT * FROM image");
  while (rows.Step()) {
    const Image image = ReadRow(rows, database.path());
    if (FindKeyframe(contents, image.keyframe) == nullptr) {
      RowReader(rows, database.path(), kTable).Fail("its keyframe does not exist");
    }
  }
}

void EraseOtherImages(const SqliteDatabase& database, const MapContents& contents) {
  const KeptSessions sessions = SelectSessions(database, contents.sessions);
  SqliteStatement rows = database.Prepare(
      "SELECT image.keyframe, features.keyframe IS NOT NULL, frame, timestamp, points, lines FROM "
      "image LEFT JOIN features ON features.keyframe = image.keyframe");
  std::vector<KeyframeId> others;
  while (rows.Step()) {
    const KeyframeId id = rows.Integer(0);
    const Keyframe* const keyframe = FindKeyframe(contents, id);
    const bool has_features = rows.Integer(1) != 0;
    const bool is_same =
        keyframe != nullptr && AreKept(sessions, id) && has_features &&
        keyframe->frame->id == rows.Integer(2) && keyframe->frame->timestamp == rows.Real(3) &&
        ShowsFeatures(*keyframe->frame, rows.Bytes(4), rows.Bytes(5)) && IsUndamaged(database, id);
    if (!is_same) others.push_back(id);
  }
  SqliteStatement erase = database.Prepare("DELETE FROM image WHERE keyframe = ?");
  for (const KeyframeId id : others) {
    erase.Bind(0, id);
    erase.Step();
  }
}

}  // namespace msc_vo
