// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <limits>
#include <vector>

#include "msc_vo/geometry/pose_covariance.h"
#include "msc_vo/geometry/rigid3.h"
#include "msc_vo/map/map.h"
#include "msc_vo/map/pose_graph_edge.h"

namespace msc_vo {

/// The systematic part of the drift of a path of `length` metres on which the camera turns by
/// `turn` radians, apart from lever arms. Camera frame.
PoseCovariance SystematicCovariance(double length, double turn);

/// Drift of the odometry along a path, as a covariance: each step adds the error of a tracked pose,
/// and the path as a whole has what errors of the calibration and of the depth sensor, which are
/// the same in every step, add up to. Steps are summed in a fixed frame, the base.
class PathDrift {
 public:
  /// Adds a step between two cameras. `covariance`: of the tracked pose of one of them, in the base
  /// frame (TransportCovariance() of CameraCovariance()).
  void AddStep(const Rigid3& base_from_begin, const Rigid3& base_from_end,
               const PoseCovariance& covariance);
  /// Adds another independent error of a camera on the path, in its own frame.
  void AddError(const Rigid3& base_from_cam, const PoseCovariance& covariance) {
    steps_ += TransportCovariance(base_from_cam, covariance);
  }
  /// Covariance of the pose of a camera, the last one of the path, relative to the begin of the
  /// path, in the frame of the camera. The systematic part is multiplied by `factor`^2.
  PoseCovariance At(const Rigid3& cam_from_base, double factor = 1.0) const;
  /// The same without the systematic part.
  PoseCovariance StepsAt(const Rigid3& cam_from_base) const {
    return TransportCovariance(cam_from_base, steps_);
  }
  /// Of the path, metres.
  double length() const { return length_; }
  /// The rotation vectors of all steps added up, base frame, radians: whole turns count, and
  /// turning back undoes a turn.
  const Eigen::Vector3d& turn() const { return turn_; }
  /// Trace of the covariance in the base frame, without the part of the turn: what only grows along
  /// a path.
  double Trace() const;

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    auto& [steps, path_length, turn, lever, view] = *this;  // all members, or it does not compile
    archive(steps, path_length, turn, lever, view);
  }

 private:
  // Of rotations by the turn that err by an unknown ratio, in the base frame.
  PoseCovariance TurnCovariance() const;

  PoseCovariance steps_ = PoseCovariance::Zero();    // in the base frame
  double length_ = 0.0;                              // metres
  Eigen::Vector3d turn_ = Eigen::Vector3d::Zero();   // radians
  Eigen::Matrix3d lever_ = Eigen::Matrix3d::Zero();  // sum of place * turn^T, metres * radians
  Eigen::Vector3d view_change_ = Eigen::Vector3d::Zero();  // of the direction of view
};

/// The drift of the odometry from keyframe `a` to `b`, along the whole path between them in the
/// order of keyframes; base: `b`. Both are or were in the map, in any order.
PathDrift DriftBetween(const Map& map, KeyframeId a, KeyframeId b);

/// How uncertain the poses of all keyframes are relative to one of them, the root. The steps of
/// odometry and the closed loops link the keyframes to a graph; an edge of a loop is a step between
/// the two keyframes that show one place. The covariance of a pose is that along the path through
/// the graph with the smallest PathDrift::Trace() (frame of the root). Its part by the steps is not
/// smaller than the marginal covariance of the graph, to which the other paths add information.
class PathCovariances {
 public:
  /// `loops`: those of keyframes that the map does not know are left out. `root` is or was in the
  /// map.
  PathCovariances(const Map& map, const std::vector<PoseGraphEdge>& loops, KeyframeId root);

  /// Covariance of the pose of a keyframe, or of a camera near it, relative to the root, as by
  /// CameraCovariance(): in the frame of the camera. The keyframe is or was in the map. The way
  /// from it to the camera is a step, with the covariance `step` in the frame of the camera.
  PoseCovariance Of(KeyframeId keyframe, const Rigid3& cam_from_keyframe = Rigid3(),
                    const PoseCovariance& step = PoseCovariance::Zero()) const;
  /// Covariance of the pose of the root relative to a keyframe, in the frame of the root.
  PoseCovariance OfRoot(KeyframeId keyframe) const;
  /// The drift along the path from the root to a keyframe; base: the root.
  const PathDrift& DriftTo(KeyframeId keyframe) const { return Find(keyframe)->drift; }

 private:
  struct Node {
    KeyframeId id = kNoId;
    Rigid3 root_from_cam;
    PathDrift drift;  // base: the root
    double cost = std::numeric_limits<double>::infinity();
  };
  // A step between two nodes, with the covariance of the second one's tracked pose.
  struct Edge {
    size_t from = 0;
    size_t to = 0;
    PoseCovariance covariance;  // frame of the root
  };

  const Node* Find(KeyframeId keyframe) const;  // nullptr: not known
  std::vector<Edge> EdgesOf(const Map& map, const std::vector<PoseGraphEdge>& loops) const;
  void FindPaths(const std::vector<Edge>& edges, size_t root);

  std::vector<Node> nodes_;  // by ascending id
};

/// Squared norm of the whitened difference, six rows, of two poses of a camera: `by_path` by
/// odometry and `measured` by other means. `covariance`: the sum of that of the path and of all
/// others, in the camera frame.
double SquaredDriftError(const Rigid3& by_path, const Rigid3& measured,
                         const PoseCovariance& covariance);
/// Whether they differ by no more than their errors, by a chi-square test.
bool IsPossibleDrift(const Rigid3& by_path, const Rigid3& measured,
                     const PoseCovariance& covariance);

}  // namespace msc_vo
