// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// A wall whose plane is known, for example from the plan of a building, as factors on the landmarks
// of the running odometry: points and lines of a window that lie near the plane are drawn to it.

#include <ceres/loss_function.h>

#include "apps/examples/simulated_camera.h"
#include "msc_vo/factors/cost_functor.h"

namespace {

using msc_vo::BlockId;

struct Plane {
  Eigen::Vector3d normal;  // unit vector, world
  double offset;           // metres; the plane is normal . x = offset

  double Distance(const Eigen::Vector3d& x) const { return std::abs(normal.dot(x) - offset); }
};

constexpr double kSigma = 0.01;  // metres: frames of doors and pictures protrude from the wall

// Distances of N points from a known plane, N rows:
//
//   r_k = (normal . X_k - offset) / sigma
//
// X_k: points in the world, metres (block 0, 3 N). N = 1: a point; N = 2: both ends of a line.
template <int N>
class PlaneDistance : public msc_vo::CostFunctor<PlaneDistance<N>, N, 3 * N> {
 public:
  explicit PlaneDistance(const Plane& plane) : plane_(plane) {}

  template <typename T>
  bool operator()(const T* points, T* residuals) const {
    for (int k = 0; k < N; ++k) {
      const Eigen::Map<const Eigen::Matrix<T, 3, 1>> x(points + 3 * k);
      residuals[k] = (plane_.normal.cast<T>().dot(x) - plane_.offset) / kSigma;
    }
    return true;
  }

 private:
  Plane plane_;
};

class KnownWall {
 public:
  explicit KnownWall(const Plane& plane)
      : plane_(plane),
        point_(PlaneDistance<1>::CreateShared(plane)),
        line_(PlaneDistance<2>::CreateShared(plane)) {}

  // Landmarks within three sigmas of the plane. Which these are is found again in every window,
  // because landmarks move and come and go.
  msc_vo::WindowFactors operator()(const msc_vo::WindowContext& window) const {
    msc_vo::WindowFactors result;
    for (const auto& point : window.data->points) {
      if (!IsNear(point.position)) continue;
      result.factors.push_back({"point on wall", point_, loss_, {BlockId::Point(point.id)}});
    }
    for (const auto& line : window.data->lines) {
      if (!IsNear(line.segment.start) || !IsNear(line.segment.end)) continue;
      result.factors.push_back({"line on wall", line_, loss_, {BlockId::Line(line.id)}});
    }
    return result;
  }

 private:
  bool IsNear(const Eigen::Vector3d& x) const { return plane_.Distance(x) < 3.0 * kSigma; }

  Plane plane_;
  std::shared_ptr<const ceres::CostFunction> point_, line_;
  std::shared_ptr<const ceres::LossFunction> loss_{new ceres::CauchyLoss(1.0)};
};

// The largest wall of the scene that faces +y, in the world of the odometry.
Plane WallOf(const msc_vo::SimulatedCamera& camera) {
  const msc_vo::Quad* wall = nullptr;
  for (const msc_vo::Quad& quad : camera.scene().quads) {
    if (quad.Normal().y() < 0.99) continue;
    if (wall == nullptr || quad.Area() > wall->Area()) wall = &quad;
  }
  const msc_vo::Rigid3 world_from_scene = camera.WorldFromScene();
  const Eigen::Vector3d normal = world_from_scene.rotation() * wall->Normal();
  return {normal, normal.dot(world_from_scene * wall->origin)};
}

// Root mean square error of the positions across a plane, metres.
double ErrorAcross(const Plane& plane, const msc_vo::SimulatedCamera& camera,
                   const msc_vo::OdometryResult& result) {
  double squares = 0.0;
  for (const msc_vo::FrameResult& frame : result.frames) {
    const Eigen::Vector3d truth = camera.CamFromWorld(static_cast<int>(frame.id)).OriginInSource();
    const double error = plane.normal.dot(frame.cam_from_world.OriginInSource() - truth);
    squares += error * error;
  }
  return std::sqrt(squares / static_cast<double>(result.frames.size()));
}

}  // namespace

int main() {
  const msc_vo::SimulatedCamera camera(msc_vo::SceneKind::kCorridor, 240);
  msc_vo::OdometryOptions options;
  options.mode = msc_vo::Mode::kPlVo;  // without Manhattan axes, which hold the direction too
  msc_vo::Odometry vision(options, camera.camera(), {}), both(options, camera.camera(), {});
  const Plane wall = WallOf(camera);
  both.SetWindowFactors(KnownWall(wall));
  const msc_vo::OdometryResult a = camera.Replay(&vision), b = camera.Replay(&both);
  std::printf("position error without wall %.1f mm, with wall %.1f mm\n",
              1000.0 * camera.PositionError(a), 1000.0 * camera.PositionError(b));
  // The direction that the wall determines.
  const double without = ErrorAcross(wall, camera, a), with = ErrorAcross(wall, camera, b);
  std::printf("across the wall: without %.1f mm, with %.1f mm\n", 1000.0 * without, 1000.0 * with);
  return with < without ? 0 : 1;
}
