// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/map_export.h"

#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/odometry/map_result.h"
#include "msc_vo/results/ply_file.h"
#include "msc_vo/structure/scene_axes.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr int kMinShared = 20;
constexpr double kSigma = 1e-3;  // of an edge of one shared landmark, metres and radians

std::string FormatPose(const Rigid3& pose) {
  const Eigen::Vector3d t = pose.translation().array() + 0.0;  // no negative zeros
  const Eigen::Vector4d q = pose.rotation().coeffs().array() + 0.0;
  return FormatText("%.9g %.9g %.9g %.9g %.9g %.9g %.9g", t.x(), t.y(), t.z(), q.x(), q.y(), q.z(),
                    q.w());
}

// The covariance of the error of an edge, a translation and the imaginary part of a quaternion in
// frame a, from that of b_from_a in the tangent of Rigid3Manifold.
Matrix6d ErrorCovariance(const Rigid3& b_from_a, const PoseCovariance& covariance) {
  const Eigen::Matrix3d a_from_b = b_from_a.rotation().conjugate().toRotationMatrix();
  Matrix6d jacobian = Matrix6d::Zero();
  jacobian.topRightCorner<3, 3>() = a_from_b;
  jacobian.bottomLeftCorner<3, 3>() = 0.5 * a_from_b;
  return jacobian * covariance * jacobian.transpose();
}

std::string FormatEdge(KeyframeId b, KeyframeId a, const Rigid3& b_from_a,
                       const PoseCovariance& covariance) {
  std::string text =
      FormatText("EDGE_SE3:QUAT %lld %lld ", static_cast<long long>(b), static_cast<long long>(a)) +
      FormatPose(b_from_a);
  const Matrix6d information = ErrorCovariance(b_from_a, covariance).inverse();
  for (int row = 0; row < 6; ++row) {
    for (int column = row; column < 6; ++column) {
      text += FormatText(" %.9g", information(row, column));
    }
  }
  return text + "\n";
}

std::vector<MapPoint> PointsOf(const Map& map) {
  std::vector<MapPoint> points;
  for (const auto& [id, point] : map.points()) {
    points.push_back({point.position, static_cast<int>(point.observations.size())});
  }
  return points;
}

std::vector<MapLine> LinesOf(const SavedSubMap& submap) {
  std::vector<MapLine> lines;
  for (const auto& [id, line] : submap.map.lines()) {
    lines.push_back({line.segment, static_cast<int>(line.observations.size()), true,
                     submap.axes ? AxisOfLine(*submap.axes, line) : std::nullopt,
                     line.viewing_direction});
  }
  return lines;
}

std::vector<MapPlane> PlanesOf(const SavedSubMap& submap) {
  PlaneMap planes;
  planes.Restore(submap.planes);
  return MakeMapPlanes(planes, submap.map, submap.axes);
}

// The keyframes of session `session` in a submap.
std::vector<TimedPose> KeyframesOf(const MapContents& contents, size_t session, const Map& map) {
  const KeyframeId first = contents.sessions[session].first_keyframe;
  const KeyframeId end = session + 1 < contents.sessions.size()
                             ? contents.sessions[session + 1].first_keyframe
                             : std::numeric_limits<KeyframeId>::max();
  std::vector<TimedPose> poses;
  for (const auto& [id, keyframe] : map.keyframes()) {
    if (id < first || id >= end) continue;
    poses.push_back({keyframe.frame->timestamp, keyframe.cam_from_world.Inverse()});
  }
  return poses;
}

}  // namespace

std::string FormatG2o(const SavedSubMap& submap, const std::vector<PoseGraphEdge>& loops) {
  const Map& map = submap.map;
  std::string text;
  for (const auto& [id, keyframe] : map.keyframes()) {
    text += FormatText("VERTEX_SE3:QUAT %lld ", static_cast<long long>(id)) +
            FormatPose(keyframe.cam_from_world.Inverse()) + "\n";
  }
  for (const auto& [id, keyframe] : map.keyframes()) {
    for (const Map::Covisible& covisible : map.FindCovisible(id)) {
      if (covisible.num_shared < kMinShared || covisible.keyframe > id) continue;
      const Rigid3 other_from_this =
          map.CamFromWorld(covisible.keyframe) * keyframe.cam_from_world.Inverse();
      text += FormatEdge(covisible.keyframe, id, other_from_this,
                         PoseCovariance::Identity() * (kSigma * kSigma / covisible.num_shared));
    }
  }
  for (const PoseGraphEdge& loop : loops) {
    if (map.FindKeyframe(loop.from) == nullptr || map.FindKeyframe(loop.to) == nullptr) continue;
    text += FormatEdge(loop.to, loop.from, loop.to_from_from, loop.covariance);
  }
  return text;
}

void ExportMap(const MapContents& contents, const std::string& folder) {
  for (const SavedSubMap& submap : contents.submaps) {
    const std::filesystem::path path =
        std::filesystem::path(folder) / ("submap_" + std::to_string(submap.id));
    MakeFolder(path.string());
    WriteFile((path / "points.ply").string(), FormatPointsPly(PointsOf(submap.map)));
    WriteFile((path / "lines.ply").string(), FormatLinesPly(LinesOf(submap)));
    if (!submap.planes.planes.empty()) {
      WriteFile((path / "planes.ply").string(), FormatPlanesPly(PlanesOf(submap)));
    }
    WriteFile((path / "graph.g2o").string(), FormatG2o(submap, contents.loops));
    for (size_t session = 0; session < contents.sessions.size(); ++session) {
      const std::vector<TimedPose> poses = KeyframesOf(contents, session, submap.map);
      if (poses.empty()) continue;
      const std::string name = "keyframes_" + std::to_string(session + 1) + ".txt";
      WriteTrajectory((path / name).string(), poses);
    }
  }
}

}  // namespace msc_vo
