// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/map_writer.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "msc_vo/map_file/internal/blob.h"
#include "msc_vo/map_file/internal/calibration_rows.h"
#include "msc_vo/map_file/internal/feature_blob.h"
#include "msc_vo/map_file/internal/image_rows.h"
#include "msc_vo/map_file/internal/map_schema.h"
#include "msc_vo/map_file/internal/plane_rows.h"
#include "msc_vo/map_file/internal/row.h"
#include "msc_vo/map_file/internal/sqlite_database.h"
#include "msc_vo/map_file/internal/table_reader.h"
#include "msc_vo/version.h"

namespace msc_vo {

namespace {

BlobWriter EncodeCovariance(const PoseCovariance& covariance) {
  BlobWriter blob;
  for (const double value : covariance.reshaped()) blob.F64(value);
  return blob;
}

template <typename L>
bool Contains(const MapContents& contents, LandmarkId id) {
  return std::any_of(contents.submaps.begin(), contents.submaps.end(),
                     [id](const SavedSubMap& submap) { return submap.map.Find<L>(id) != nullptr; });
}

void AddPose(const Rigid3& pose, RowWriter* row) {
  for (const double value : pose.params) row->Real(value);
}

void AddGeometry(const PointLandmark& point, RowWriter* row) {
  for (const double x : point.position) row->Metres(x);
}

void AddGeometry(const LineLandmark& line, RowWriter* row) {
  for (const double x : line.segment.start) row->Metres(x);
  for (const double x : line.segment.end) row->Metres(x);
  row->Metres(line.depth_offset);
}

// The difference of two maps, as changes of the tables.
class TableWriter {
 public:
  TableWriter(const SqliteDatabase& database, const MapContents& before, const MapContents& now,
              const KeyframeImageSource& images, CalibrationRows* calibrations)
      : database_(database),
        before_(before),
        now_(now),
        images_(images),
        calibrations_(calibrations) {}

  void Write() {
    Erase();
    for (const SavedSubMap& submap : now_.submaps) {
      const SavedSubMap* const same = FindSubMap(before_, submap.id);
      const Map empty;
      WriteMap(submap.id, same != nullptr ? same->map : empty, submap.map);
    }
    WriteSmallTables();
  }

 private:
  // Deletes what is in no map any more.
  void Erase() {
    const auto erase = [this](const std::string& table, const std::string& key, int64_t id) {
      SqliteStatement statement =
          database_.Prepare("DELETE FROM " + table + " WHERE " + key + " = ?");
      statement.Bind(0, id);
      statement.Step();
    };
    const Map empty;
    for (const SavedSubMap& submap : before_.submaps) {
      const SavedSubMap* const same = FindSubMap(now_, submap.id);
      const Map& now = same != nullptr ? same->map : empty;
      const auto keep = [](const auto& /*entry*/) {};
      now.keyframes().VisitChanges(submap.map.keyframes(), keep, [&](KeyframeId id) {
        if (FindKeyframe(now_, id) != nullptr) return;
        erase("keyframe", "id", id);
        erase("features", "keyframe", id);
        erase("plane_features", "keyframe", id);
        erase("image", "keyframe", id);
      });
      ForEachLandmarkKind([&](auto kind) {
        using L = typename decltype(kind)::Landmark;
        now.landmarks<L>().VisitChanges(submap.map.landmarks<L>(), keep, [&](LandmarkId id) {
          if (!Contains<L>(now_, id)) erase(L::kName, "id", id);
        });
      });
    }
  }

  void WriteMap(int submap, const Map& before, const Map& now) {
    const auto keep = [](int64_t /*id*/) {};
    now.keyframes().VisitChanges(
        before.keyframes(), [&](const auto& entry) { WriteKeyframe(submap, now, entry.second); },
        keep);
    ForEachLandmarkKind([&](auto kind) {
      using L = typename decltype(kind)::Landmark;
      SqliteStatement upsert =
          PrepareUpsert(database_, L::kName, std::is_same_v<L, PointLandmark> ? 10 : 14);
      now.landmarks<L>().VisitChanges(
          before.landmarks<L>(),
          [&](const auto& entry) { WriteLandmark(submap, entry.second, &upsert); }, keep);
    });
  }

  void WriteKeyframe(int submap, const Map& map, const Keyframe& keyframe) {
    RowWriter row(&keyframe_);
    row.Integer(keyframe.id).Integer(submap);
    AddPose(keyframe.cam_from_world, &row);
    row.Execute();
    const Keyframe* const was = FindKeyframe(before_, keyframe.id);
    const bool has_same_frame = was != nullptr && was->frame == keyframe.frame;
    if (!has_same_frame) WriteImageOf(keyframe.id);
    const bool has_same_features = has_same_frame && was->landmarks == keyframe.landmarks;
    if (!has_same_features) WriteFeatures(map, keyframe);
  }

  // Leaves the image that the file may have if no other is known.
  void WriteImageOf(KeyframeId id) {
    const std::string jpeg = images_ ? images_(id) : "";
    if (!jpeg.empty()) WriteImage(id, jpeg, &image_);
  }

  void WriteFeatures(const Map& map, const Keyframe& keyframe) {
    const Frame& frame = *keyframe.frame;
    const FeatureBlobs blobs = EncodeFeatures(keyframe);
    RowWriter row(&features_);
    row.Integer(keyframe.id).Integer(frame.id).Real(frame.timestamp);
    row.Integer(calibrations_->Write(database_, frame));
    ForEachLandmarkKind([&](auto kind) {
      using L = typename decltype(kind)::Landmark;
      row.Blob(blobs.features.Of<L>()).Blob(blobs.landmarks.Of<L>());
    });
    const BlobWriter step = EncodeCovariance(*map.StepCovariance(keyframe.id));
    row.Blob(blobs.depth_ranges).Blob(step.bytes()).Execute();
    if (frame.planes.empty()) return;
    const std::string planes = EncodePlanes(frame.planes);
    RowWriter(&plane_features_).Integer(keyframe.id).Blob(planes).Execute();
  }

  template <typename L>
  void WriteLandmark(int submap, const L& landmark, SqliteStatement* upsert) {
    RowWriter row(upsert);
    row.Integer(landmark.id).Integer(submap).Integer(landmark.first_keyframe);
    AddGeometry(landmark, &row);
    row.Integer(landmark.num_visible).Integer(landmark.num_found).Real(landmark.noise);
    row.Execute();
  }

  // Replaces the rows of tables with few rows.
  void WriteSmallTables() {
    for (const char* table : {"map", "session", "submap", "loop", "false_depth"}) {
      database_.Execute(std::string("DELETE FROM ") + table);
    }
    KeyframeId next_keyframe = 0;
    LandmarkId next_landmark = 0;
    for (const SavedSubMap& submap : now_.submaps) {
      next_keyframe = std::max(next_keyframe, submap.map.next_keyframe());
      next_landmark = std::max(next_landmark, submap.map.next_landmark());
      WriteSubMap(submap);
    }
    SqliteStatement map = PrepareUpsert(database_, "map", 5);
    RowWriter(&map)
        .Integer(1)
        .Integer(next_keyframe)
        .Integer(next_landmark)
        .Text(std::string("msc_vo ") + kVersion)
        .Execute();
    SqliteStatement insert = PrepareUpsert(database_, "session", 4);
    int64_t id = 0;
    for (const MapSession& session : now_.sessions) {
      RowWriter(&insert).Integer(++id).Integer(session.first_keyframe).Text(session.name).Execute();
    }
    id = 0;
    for (const PoseGraphEdge& loop : now_.loops) WriteLoop(++id, loop);
    WriteFalseDepths();
    WritePlanes(database_, now_);
  }

  void WriteFalseDepths() {
    SqliteStatement insert = PrepareUpsert(database_, "false_depth", 2);
    for (const SavedSubMap& submap : now_.submaps) {
      ForEachLandmarkKind([&](auto kind) {
        for (const auto& [id, landmark] :
             submap.map.template landmarks<typename decltype(kind)::Landmark>()) {
          if (landmark.has_false_depth) RowWriter(&insert).Integer(id).Execute();
        }
      });
    }
  }

  void WriteSubMap(const SavedSubMap& submap) {
    SqliteStatement insert = PrepareUpsert(database_, "submap", 12);
    RowWriter row(&insert);
    row.Integer(submap.id);
    if (submap.axes) {
      for (const double value : submap.axes->world_from_axes.coeffs()) row.Real(value);
      row.Real(submap.axes->sigma).Real(submap.axes->deviation);
    } else {
      for (int i = 0; i < 6; ++i) row.Null();
    }
    const NoiseScale& noise = submap.noise_scale;
    row.Real(noise.point_depth).Real(noise.line_pixel).Real(noise.line_depth);
    row.Real(submap.planes.noise).Execute();
  }

  void WriteLoop(int64_t id, const PoseGraphEdge& loop) {
    SqliteStatement insert = PrepareUpsert(database_, "loop", 12);
    RowWriter row(&insert);
    row.Integer(id).Integer(loop.from).Integer(loop.to);
    AddPose(loop.to_from_from, &row);
    const BlobWriter covariance = EncodeCovariance(loop.covariance);
    row.Blob(covariance.bytes()).Execute();
  }

  const SqliteDatabase& database_;
  const MapContents& before_;
  const MapContents& now_;
  const KeyframeImageSource& images_;
  CalibrationRows* calibrations_;
  SqliteStatement keyframe_ = PrepareUpsert(database_, "keyframe", 10);
  SqliteStatement features_ = PrepareUpsert(database_, "features", 11);
  SqliteStatement plane_features_ = PrepareUpsert(database_, "plane_features", 3);
  SqliteStatement image_ = PrepareUpsert(database_, "image", 3);
};

// Deletes the rows of keyframes and landmarks before another map replaces them.
void EraseAll(const SqliteDatabase& database, const MapContents& contents) {
  EraseOtherImages(database, contents);
  for (const char* table :
       {"calibration", "keyframe", "features", "plane_features", "point", "line"}) {
    database.Execute(std::string("DELETE FROM ") + table);
  }
}

MapContents Share(MapContents* contents) {
  MapContents shared;
  shared.sessions = contents->sessions;
  shared.loops = contents->loops;
  for (SavedSubMap& submap : contents->submaps) {
    shared.submaps.push_back(
        {submap.id, submap.map.Share(), submap.axes, submap.noise_scale, submap.planes});
  }
  return shared;
}

}  // namespace

struct MapWriter::State {
  explicit State(const std::string& path) : database(path, SqliteDatabase::Access::kWrite) {}

  SqliteDatabase database;
  bool is_empty = false;  // has no tables yet
  bool is_known = false;  // `written` is what the file contains
  MapContents written;
  CalibrationRows calibrations;
};

MapWriter::MapWriter(const std::string& path) : state_(std::make_unique<State>(path)) {
  state_->is_empty = IsEmptyDatabase(state_->database);
  if (!state_->is_empty) CheckSchema(state_->database);
}

MapWriter::~MapWriter() = default;

MapContents MapWriter::Load() {
  MapContents contents;
  if (!state_->is_empty) contents = ReadTables(state_->database, &state_->calibrations);
  state_->written = Share(&contents);
  state_->is_known = true;
  return contents;
}

std::string MapWriter::ReadImage(KeyframeId id) const {
  return state_->is_empty ? "" : msc_vo::ReadImage(state_->database, id);
}

void MapWriter::Write(MapContents contents, const KeyframeImageSource& images) {
  State& state = *state_;
  CalibrationRows calibrations = state.is_known ? state.calibrations : CalibrationRows();
  const MapContents none;
  state.database.Transaction([&] {
    if (state.is_empty) CreateSchema(state.database);
    UpgradeSchema(state.database);
    if (!state.is_known) EraseAll(state.database, contents);
    TableWriter(state.database, state.is_known ? state.written : none, contents, images,
                &calibrations)
        .Write();
  });
  state.is_empty = false;
  state.is_known = true;
  state.calibrations = std::move(calibrations);
  state.written = std::move(contents);
}

void SaveMap(const std::string& path, MapContents contents, const KeyframeImageSource& images) {
  MapWriter(path).Write(std::move(contents), images);
}

}  // namespace msc_vo
