// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/table_reader.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "msc_vo/map/map_validation.h"
#include "msc_vo/map_file/internal/blob.h"
#include "msc_vo/map_file/internal/feature_blob.h"
#include "msc_vo/map_file/internal/image_rows.h"
#include "msc_vo/map_file/internal/map_schema.h"
#include "msc_vo/map_file/internal/plane_rows.h"
#include "msc_vo/map_file/internal/row.h"

namespace msc_vo {

namespace {

// An observation as the features of a keyframe name it.
struct NamedObservation {
  LandmarkId landmark = kNoId;
  KeyframeId keyframe = kNoId;
  int feature = 0;

  bool operator<(const NamedObservation& other) const {
    return std::tie(landmark, keyframe, feature) <
           std::tie(other.landmark, other.keyframe, other.feature);
  }
};

Rigid3 ReadPose(RowReader* row) {
  Rigid3 pose;
  for (int i = 0; i < 7; ++i) pose.params[i] = row->Real();
  return pose;
}

PoseCovariance ReadCovariance(RowReader* row) {
  PoseCovariance covariance;
  BlobReader blob(row->Blob());
  for (double& value : covariance.reshaped()) value = blob.F64();
  if (!blob.AtEnd() || !covariance.allFinite()) throw BlobError("a covariance is not valid");
  return covariance;
}

void ReadGeometry(RowReader* row, PointLandmark* point) {
  for (double& x : point->position) x = row->Metres();
}

void ReadGeometry(RowReader* row, LineLandmark* line) {
  for (double& x : line->segment.start) x = row->Metres();
  for (double& x : line->segment.end) x = row->Metres();
  line->depth_offset = row->Metres();
}

class TableReader {
 public:
  TableReader(const SqliteDatabase& database, CalibrationRows* calibrations)
      : database_(database), calibrations_(calibrations) {}

  MapContents Read() {
    ReadIds();
    ReadSessions();
    ReadSubMaps();
    calibrations_->Read(database_);
    if (version_ >= kFirstVersionWithPlanes) planes_ = ReadPlaneFeatures(database_);
    ReadKeyframes();
    if (version_ >= kFirstVersionWithPlanes) ReadPlanes(database_, &contents_);
    if (version_ >= kFirstVersionWithFalseDepths) ReadFalseDepths();
    ForEachLandmarkKind([&](auto kind) { ReadLandmarks<typename decltype(kind)::Landmark>(); });
    if (!false_depths_.empty()) Fail("a false depth is that of a landmark that does not exist");
    ReadLoops();
    CheckImages(database_, contents_);
    for (SavedSubMap& submap : contents_.submaps) {
      submap.map.ContinueIds(next_keyframe_, next_landmark_);
      const std::string violation = FirstViolation(submap.map);
      if (!violation.empty()) Fail("submap " + std::to_string(submap.id) + ": " + violation);
    }
    return std::move(contents_);
  }

 private:
  [[noreturn]] void Fail(const std::string& problem) const {
    RefuseDamaged(database_.path(), problem);
  }

  void ReadIds() {
    SqliteStatement rows = database_.Prepare("SELECT * FROM map");
    if (!rows.Step()) Fail("its table map is empty");
    RowReader row(rows, database_.path(), "map");
    row.Integer();
    next_keyframe_ = row.Integer();
    next_landmark_ = row.Integer();
    row.Text();
    row.Finish();
    if (next_keyframe_ < 0 || next_keyframe_ > kMaxKeyframes || next_landmark_ < 0 ||
        next_landmark_ > kMaxLandmarks) {
      row.Fail("the ids are not possible");
    }
  }

  void ReadSessions() {
    KeyframeId last = 0;
    ForEachRow(database_, "session", "id", [&](RowReader* row) {
      row->Integer();
      MapSession session;
      session.first_keyframe = row->Integer();
      session.name = row->Text();
      row->Finish();
      if (session.first_keyframe < last || session.first_keyframe > next_keyframe_) {
        row->Fail("it is out of order");
      }
      last = session.first_keyframe;
      contents_.sessions.push_back(session);
    });
  }

  void ReadSubMaps() {
    ForEachRow(database_, "submap", "id", [&](RowReader* row) {
      SavedSubMap submap;
      const int64_t id = row->Integer();
      if (id < 0 || id > kMaxKeyframes) row->Fail("its id is not possible");
      submap.id = static_cast<int>(id);
      if (!row->IsNull()) {
        AxesEstimate axes;
        for (double& value : axes.world_from_axes.coeffs()) value = row->Real();
        axes.sigma = row->Real();
        axes.deviation = row->Real();
        const bool is_valid = std::abs(axes.world_from_axes.norm() - 1.0) < 1e-9 &&
                              axes.sigma > 0.0 && axes.deviation >= 0.0;
        if (!is_valid) row->Fail("its axes are not valid");
        submap.axes = axes;
      } else {
        for (int i = 0; i < 5; ++i) {
          if (!row->IsNull()) row->Fail("its axes are not complete");
        }
      }
      submap.noise_scale = {row->Real(), row->Real(), row->Real()};
      const NoiseScale& noise = submap.noise_scale;
      if (version_ >= kFirstVersionWithPlanes) submap.planes.noise = row->Real();
      if (!(noise.point_depth > 0.0 && noise.line_pixel > 0.0 && noise.line_depth > 0.0 &&
            submap.planes.noise > 0.0)) {
        row->Fail("its noise is not positive");
      }
      row->Finish();
      contents_.submaps.push_back(std::move(submap));
    });
  }

  void ReadKeyframes() {
    SqliteStatement rows = database_.Prepare("SELECT * FROM keyframe ORDER BY id");
    SqliteStatement features = database_.Prepare("SELECT * FROM features ORDER BY keyframe");
    while (rows.Step()) {
      RowReader row(rows, database_.path(), "keyframe");
      if (!features.Step()) row.Fail("it has no features");
      RowReader features_row(features, database_.path(), "features");
      ReadKeyframe(&row, &features_row);
    }
    if (features.Step() || !planes_.empty()) Fail("it has features without a keyframe");
    ForEachLandmarkKind([&](auto kind) {
      auto& observations = observations_.Of<typename decltype(kind)::Landmark>();
      std::sort(observations.begin(), observations.end());
    });
  }

  void ReadKeyframe(RowReader* row, RowReader* features) {
    const KeyframeId id = row->Integer();
    if (id < 0 || id >= next_keyframe_) row->Fail("its id is not possible");
    SavedSubMap* const submap = FindSubMap(contents_, row->Integer());
    if (submap == nullptr) row->Fail("its submap does not exist");
    const Rigid3 cam_from_world = ReadPose(row);
    row->Finish();
    if (features->Integer() != id) row->Fail("it has no features");
    try {
      submap->map.AddKeyframe(ReadFrame(id, features), cam_from_world, id);
      submap->map.SetStepCovariance(id, ReadCovariance(features));
    } catch (const BlobError& error) {
      features->Fail(error.what());
    }
    features->Finish();
  }

  std::shared_ptr<const Frame> ReadFrame(KeyframeId id, RowReader* row) {
    const auto frame = std::make_shared<Frame>();
    frame->id = row->Integer();
    frame->timestamp = row->Real();
    const FrameCalibration* const calibration = calibrations_->Find(row->Integer());
    if (calibration == nullptr) row->Fail("its calibration does not exist");
    frame->camera = calibration->camera;
    frame->intrinsics = calibration->intrinsics;
    ReadFeatures<PointLandmark>(id, row, &*frame);
    ReadFeatures<LineLandmark>(id, row, &*frame);
    frame->depth_ranges = DecodeDepthRanges(row->Blob());
    frame->grid = FeatureGrid(frame->camera, frame->points);
    const auto planes = planes_.find(id);
    if (planes != planes_.end()) {
      frame->planes = std::move(planes->second);
      planes_.erase(planes);
    }
    return frame;
  }

  template <typename L>
  void ReadFeatures(KeyframeId id, RowReader* row, Frame* frame) {
    auto& features = OfKind<L>(*frame);
    DecodeFeatures(row->Blob(), &features);
    std::vector<LandmarkId> landmarks;
    DecodeLandmarks(row->Blob(), &landmarks);
    if (landmarks.size() != features.size()) row->Fail("its features and landmarks do not fit");
    for (size_t i = 0; i < landmarks.size(); ++i) {
      observations_.Of<L>().push_back({landmarks[i], id, static_cast<int>(i)});
    }
  }

  template <typename L>
  void ReadLandmarks() {
    ForEachRow(database_, L::kName, "id", [&](RowReader* row) { ReadLandmark<L>(row); });
    if (num_used_.Of<L>() != observations_.Of<L>().size()) {
      Fail("a feature observes a " + std::string(L::kName) + " that does not exist");
    }
  }

  template <typename L>
  void ReadLandmark(RowReader* row) {
    L landmark;
    landmark.id = row->Integer();
    if (landmark.id < 0 || landmark.id >= next_landmark_) row->Fail("its id is not possible");
    SavedSubMap* const submap = FindSubMap(contents_, row->Integer());
    if (submap == nullptr) row->Fail("its submap does not exist");
    landmark.first_keyframe = row->Integer();
    ReadGeometry(row, &landmark);
    const int64_t num_visible = row->Integer();
    const int64_t num_found = row->Integer();
    constexpr int64_t kMaxCount = int64_t{1} << 30;
    if (num_found < 0 || num_visible < 0 || num_found > kMaxCount || num_visible > kMaxCount) {
      row->Fail("its counts are not possible");
    }
    landmark.num_visible = static_cast<int>(num_visible);
    landmark.num_found = static_cast<int>(num_found);
    landmark.noise = row->Real();
    if (!(landmark.noise > 0.0)) row->Fail("its noise is not positive");
    landmark.has_false_depth = false_depths_.erase(landmark.id) > 0;
    row->Finish();
    const std::vector<NamedObservation>& observations = observations_.Of<L>();
    for (size_t& i = num_used_.Of<L>();
         i < observations.size() && observations[i].landmark == landmark.id; ++i) {
      const KeyframeId keyframe = observations[i].keyframe;
      if (submap->map.FindKeyframe(keyframe) == nullptr) {
        row->Fail("a keyframe is in another submap");
      }
      if (FindObservation(landmark, keyframe) != nullptr)
        row->Fail("two features observe it at once");
      landmark.observations.push_back({keyframe, observations[i].feature});
    }
    if (landmark.observations.empty()) row->Fail("no keyframe observes it");
    const LandmarkId id = landmark.id;
    submap->map.AddExisting(std::move(landmark));
    submap->map.Refresh<L>(id);
  }

  void ReadFalseDepths() {
    ForEachRow(database_, "false_depth", "landmark", [&](RowReader* row) {
      false_depths_.insert(row->Integer());
      row->Finish();
    });
  }

  void ReadLoops() {
    ForEachRow(database_, "loop", "id", [&](RowReader* row) {
      row->Integer();
      PoseGraphEdge loop;
      loop.from = row->Integer();
      loop.to = row->Integer();
      loop.to_from_from = ReadPose(row);
      loop.covariance = ReadCovariance(row);
      row->Finish();
      const bool is_valid = loop.from >= 0 && loop.to >= 0 && loop.from < next_keyframe_ &&
                            loop.to < next_keyframe_ &&
                            std::abs(loop.to_from_from.rotation().norm() - 1.0) < 1e-9;
      if (!is_valid) row->Fail("it is not valid");
      contents_.loops.push_back(loop);
    });
  }

  const SqliteDatabase& database_;
  CalibrationRows* calibrations_;
  MapContents contents_;
  KeyframeId next_keyframe_ = 0;
  LandmarkId next_landmark_ = 0;
  PerKind<std::vector<NamedObservation>> observations_;
  PerKind<size_t> num_used_;  // of the observations, by the landmarks that have been read
  const int version_ = SchemaVersion(database_);
  std::map<KeyframeId, std::vector<PlaneFeature>> planes_;  // of keyframes that are yet to be read
  std::set<LandmarkId> false_depths_;                       // of landmarks that are yet to be read
};

}  // namespace

MapContents ReadTables(const SqliteDatabase& database, CalibrationRows* calibrations) {
  return TableReader(database, calibrations).Read();
}

}  // namespace msc_vo
