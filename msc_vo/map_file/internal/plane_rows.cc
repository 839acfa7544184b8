// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/plane_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "msc_vo/geometry/convex_polygon.h"
#include "msc_vo/geometry/plane_extent.h"
#include "msc_vo/map_file/internal/blob.h"
#include "msc_vo/map_file/internal/map_schema.h"
#include "msc_vo/map_file/internal/row.h"

namespace msc_vo {

namespace {

constexpr int kNumColumns = 10;
constexpr size_t kMaxVertices = 255;
// Ten times the largest error of a number that was rounded to 32 bits, relative to the largest of
// those that it is computed with.
constexpr double kRounding = 6e-7;
// Largest angle, radians, by which a plane has turned since it was extended: the first writers of
// version 2 wrote its extent as it was then.
constexpr double kLargestTurn = 0.1;

// The upper triangle of a symmetric matrix, by rows.
void Put(const Eigen::Matrix3d& matrix, BlobWriter* blob) {
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) blob->F32(matrix(i, j));
  }
}

Eigen::Matrix3d GetSymmetric(BlobReader* blob) {
  Eigen::Matrix3d matrix;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) matrix(i, j) = matrix(j, i) = blob->F32();
  }
  return matrix;
}

template <typename Vertices>
void PutVertices(const Vertices& vertices, BlobWriter* blob) {
  blob->U8(static_cast<uint8_t>(std::min(vertices.size(), kMaxVertices)));
  for (size_t i = 0; i < std::min(vertices.size(), kMaxVertices); ++i) {
    for (const double x : vertices[i]) blob->F32(x);
  }
}

template <typename Vertices>
void GetVertices(BlobReader* blob, Vertices* vertices) {
  vertices->resize(blob->U8());
  Require(vertices->empty() || vertices->size() >= 3, "a polygon of one or two vertices");
  for (auto& vertex : *vertices) {
    for (double& x : vertex) x = blob->F32();
  }
}

// A hull as GetPlane() returns it: rounding may put a vertex onto an edge.
ConvexPolygon AsRead(ConvexPolygon hull) {
  for (Eigen::Vector2d& vertex : hull) vertex = vertex.cast<float>().cast<double>();
  return ConvexHull(std::move(hull));
}

// Whether a matrix can be the mean of b b^T of rays b = (x / z, y / z, 1).
bool IsMeanSquareRay(const Eigen::Matrix3d& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(matrix, Eigen::EigenvaluesOnly);
  return std::abs(matrix(2, 2) - 1.0) <= kRounding &&
         eigen.eigenvalues()[0] >= -kRounding * matrix.trace();
}

PlaneFeature GetPlane(BlobReader* blob) {
  PlaneFeature plane;
  for (double& x : plane.inverse_depth) x = blob->F32();
  plane.covariance = GetSymmetric(blob);
  plane.mean_square_ray = GetSymmetric(blob);
  const int64_t num_pixels = blob->Varint();
  Require(plane.inverse_depth.norm() > 0.0, "a plane at infinity");
  Require(plane.covariance.llt().info() == Eigen::Success, "a covariance that is not positive");
  Require(IsMeanSquareRay(plane.mean_square_ray), "a mean of squared rays that is not possible");
  Require(num_pixels > 0 && num_pixels <= INT32_MAX, "a plane without pixels");
  plane.num_pixels = static_cast<int>(num_pixels);
  GetVertices(blob, &plane.hull);
  Require(plane.hull.size() <= PlaneFeature::kMaxHullVertices, "a hull of too many vertices");
  plane.hull = ConvexHull(plane.hull);
  return plane;
}

// The features that observe a plane.
using Observations = std::vector<std::pair<KeyframeId, int>>;

std::map<LandmarkId, Observations> ByPlane(const SavedPlanes& planes) {
  std::map<LandmarkId, Observations> by_plane;
  for (const auto& [keyframe, matches] : planes.observations) {
    for (const PlaneMatch& match : matches) {
      by_plane[match.plane].emplace_back(keyframe, match.feature);
    }
  }
  return by_plane;
}

std::string Encode(const Observations& observations) {
  BlobWriter blob;
  KeyframeId last = 0;
  for (const auto& [keyframe, feature] : observations) {
    blob.Varint(keyframe - last);
    blob.Varint(feature);
    last = keyframe;
  }
  return blob.bytes();
}

// Adds the observations of a plane, whose features exist and observe no other plane.
void ReadObservations(std::string_view bytes, LandmarkId plane, SavedSubMap* submap) {
  Require(!bytes.empty(), "no keyframe observes it");
  BlobReader blob(bytes);
  KeyframeId id = 0;
  while (!blob.AtEnd()) {
    const int64_t step = blob.Varint();
    Require(step >= 0 && step <= std::numeric_limits<KeyframeId>::max() - id,
            "its keyframes are not in order");
    id += step;
    const int64_t feature = blob.Varint();
    const Keyframe* const keyframe = submap->map.FindKeyframe(id);
    Require(keyframe != nullptr, "a keyframe that observes it is not in its submap");
    const auto num_features = static_cast<int64_t>(keyframe->frame->planes.size());
    Require(feature >= 0 && feature < num_features, "a feature that observes it does not exist");
    std::vector<PlaneMatch>& matches = submap->planes.observations[id];
    const bool is_taken = std::any_of(matches.begin(), matches.end(), [&](const PlaneMatch& match) {
      return match.feature == feature;
    });
    Require(!is_taken, "a feature observes two planes");
    matches.push_back({static_cast<int>(feature), plane});
  }
}

// The extent on the plane as it is now.
PlaneExtent OnPlane(const HostedPlane& plane) {
  PlaneExtent extent = plane.extent;
  for (Eigen::Vector3d& vertex : extent) vertex = Project(plane.in_host, vertex);
  return extent;
}

HostedPlane ReadPlane(RowReader* row) {
  HostedPlane plane;
  plane.host = row->Integer();
  for (double& x : plane.in_host.params) x = row->Real();
  const bool is_valid =
      std::abs(plane.in_host.normal().norm() - 1.0) < 1e-9 && plane.in_host.params.allFinite();
  if (!is_valid) row->Fail("its parameters are not valid");
  BlobReader extent(row->Blob());
  GetVertices(&extent, &plane.extent);
  Require(extent.AtEnd(), "too many bytes");
  for (Eigen::Vector3d& vertex : plane.extent) {
    const Eigen::Vector3d on_plane = Project(plane.in_host, vertex);
    Require((vertex - on_plane).norm() <= kLargestTurn * vertex.norm(), "its extent is elsewhere");
    vertex = on_plane;
  }
  plane.extent = ConvexHull(plane.in_host, plane.extent, kMaxVertices);
  return plane;
}

}  // namespace

std::string EncodePlanes(const std::vector<PlaneFeature>& planes) {
  BlobWriter blob;
  for (const PlaneFeature& plane : planes) {
    for (const double x : plane.inverse_depth) blob.F32(x);
    Put(plane.covariance, &blob);
    Put(plane.mean_square_ray, &blob);
    blob.Varint(plane.num_pixels);
    PutVertices(AsRead(plane.hull), &blob);
  }
  return blob.bytes();
}

std::vector<PlaneFeature> DecodePlanes(std::string_view bytes) {
  std::vector<PlaneFeature> planes;
  BlobReader blob(bytes);
  while (!blob.AtEnd()) planes.push_back(GetPlane(&blob));
  return planes;
}

void WritePlanes(const SqliteDatabase& database, const MapContents& contents) {
  database.Execute("DELETE FROM plane");
  SqliteStatement insert = PrepareUpsert(database, "plane", kNumColumns);
  int64_t id = 0;
  for (const SavedSubMap& submap : contents.submaps) {
    const std::map<LandmarkId, Observations> observations = ByPlane(submap.planes);
    for (const auto& [plane_id, plane] : submap.planes.planes) {
      RowWriter row(&insert);
      row.Integer(id++).Integer(submap.id).Integer(plane.host);
      for (const double x : plane.in_host.params) row.Real(x);
      BlobWriter extent;
      PutVertices(OnPlane(plane), &extent);
      const std::string observed = Encode(observations.at(plane_id));
      row.Blob(extent.bytes()).Blob(observed).Execute();
    }
  }
}

std::map<KeyframeId, std::vector<PlaneFeature>> ReadPlaneFeatures(const SqliteDatabase& database) {
  std::map<KeyframeId, std::vector<PlaneFeature>> planes;
  ForEachRow(database, "plane_features", "keyframe", [&](RowReader* row) {
    const KeyframeId keyframe = row->Integer();
    planes[keyframe] = DecodePlanes(row->Blob());
    row->Finish();
  });
  return planes;
}

void ReadPlanes(const SqliteDatabase& database, MapContents* contents) {
  ForEachRow(database, "plane", "id", [&](RowReader* row) {
    const LandmarkId id = row->Integer();
    if (id < 0 || id > kMaxLandmarks) row->Fail("its id is not possible");
    SavedSubMap* const submap = FindSubMap(*contents, row->Integer());
    if (submap == nullptr) row->Fail("its submap does not exist");
    const HostedPlane plane = ReadPlane(row);
    if (submap->map.FindKeyframe(plane.host) == nullptr) row->Fail("its host does not exist");
    submap->planes.planes[id] = plane;
    ReadObservations(row->Blob(), id, submap);
    row->Finish();
  });
}

}  // namespace msc_vo
