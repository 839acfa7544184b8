// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/ground_truth_reading.h"

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/diagnosis/expected_finding.h"
#include <Eigen/Geometry>
#include <gmock/gmock.h>

#include "msc_vo/diagnosis/depth_quality.h"
#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/geometry/angles.h"
#include "msc_vo/geometry/so3.h"
#include "msc_vo/geometry/timed_pose.h"

namespace msc_vo {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;
using Path = std::vector<TimedPose>;

constexpr double kRate = 30.0;  // Hz

// A camera that is moved by hand for five seconds. `turns` and `moves` scale rotation vectors and
// positions.
Path HandHeldPath(const Eigen::Vector3d& turns = Eigen::Vector3d::Ones(),
                  const Eigen::Vector3d& moves = Eigen::Vector3d::Ones(), double phase = 0.0) {
  Path path;
  for (int i = 0; i < 150; ++i) {
    const double t = i / kRate + phase;
    const Eigen::Vector3d position(0.5 * std::sin(1.1 * t), 0.3 * std::sin(1.7 * t + 1.0),
                                   0.4 * std::sin(0.8 * t + 2.0));
    const Eigen::Vector3d rotation(0.3 * std::sin(1.9 * t), 0.4 * std::sin(1.3 * t + 0.5),
                                   0.3 * std::sin(2.3 * t + 1.0));
    path.push_back({100.0 + i / kRate,
                    Rigid3(ExpSO3(turns.cwiseProduct(rotation)), moves.cwiseProduct(position))});
  }
  return path;
}

// The motion that the odometry finds in the images, with errors of 0.03 degrees and 1 mm.
MotionTrack TrackOf(const Path& path, int seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&](double sigma) {
    const double x = sigma * normal(random), y = sigma * normal(random);
    return Eigen::Vector3d(x, y, sigma * normal(random));
  };
  MotionTrack track;
  for (const TimedPose& pose : path) {
    MotionImage image;
    image.timestamp = pose.timestamp;
    image.cam_from_world =
        Rigid3(ExpSO3(vector(5e-4)), vector(1e-3)) * pose.world_from_cam.Inverse();
    track.images.push_back(image);
  }
  for (int i = 0; i + 15 < static_cast<int>(path.size()); i += 5)
    track.pairs.push_back({i, i + 15});
  return track;
}

Path Changed(Path path, const std::function<Rigid3(const Rigid3&)>& change) {
  for (TimedPose& pose : path) pose.world_from_cam = change(pose.world_from_cam);
  return path;
}

// Poses of a body whose axes in the camera are given.
Path WithAxes(const Path& path, const Eigen::Matrix3d& camera_from_body) {
  return Changed(path, [&](const Rigid3& pose) {
    return pose * Rigid3(Eigen::Quaterniond(camera_from_body), Eigen::Vector3d::Zero());
  });
}

// The motion in images that are mirrored along an axis.
Path Mirrored(const Path& path, int axis) {
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  signs(axis) = -1.0;
  const Eigen::Matrix3d mirror = signs.asDiagonal();
  return Changed(path, [&](const Rigid3& pose) {
    const Eigen::Matrix3d rotation = mirror * pose.rotation().toRotationMatrix() * mirror;
    return Rigid3(Eigen::Quaterniond(rotation), mirror * pose.translation());
  });
}

Path Inverse(const Path& path) {
  return Changed(path, [](const Rigid3& pose) { return pose.Inverse(); });
}

Path WithInverseRotations(const Path& path) {
  return Changed(path, [](const Rigid3& pose) {
    return Rigid3(Eigen::Quaterniond(pose.rotation()).conjugate(), pose.translation());
  });
}

Path WithScalarFirst(const Path& path) {
  return Changed(path, [](const Rigid3& pose) {
    const Eigen::Quaterniond q(pose.rotation());
    return Rigid3(Eigen::Quaterniond(q.z(), q.w(), q.x(), q.y()), pose.translation());
  });
}

// All rotations between axes that are parallel up to their signs.
std::vector<Eigen::Matrix3d> RightAngledRotations() {
  std::vector<Eigen::Matrix3d> rotations;
  for (int x = 0; x < 6; ++x) {
    for (int y = 0; y < 6; ++y) {
      if (x % 3 == y % 3) continue;
      Eigen::Matrix3d rotation;
      rotation.col(0) = (x < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(x % 3);
      rotation.col(1) = (y < 3 ? 1.0 : -1.0) * Eigen::Vector3d::Unit(y % 3);
      rotation.col(2) = rotation.col(0).cross(rotation.col(1));
      rotations.push_back(rotation);
    }
  }
  return rotations;
}

Eigen::Matrix3d TurnAbout(const Eigen::Vector3d& axis, double degrees) {
  return Eigen::AngleAxisd(DegreesToRadians(degrees), axis.normalized()).toRotationMatrix();
}

std::string DescriptionOf(const TruthReading& reading) {
  const ReadingDescription description = DescribeReading(reading);
  return description.text + "; " + description.fix;
}

void ExpectReading(const TruthReading& reading, PoseConvention convention,
                   const Eigen::Matrix3d& axes, const std::string& name) {
  EXPECT_EQ(reading.convention, convention) << name;
  EXPECT_LT((reading.Axes() - axes).norm(), 0.03) << name << "\n" << reading.Axes();
  EXPECT_LT(reading.disagreement, 0.05) << name;
}

TEST(FindReading, FindsAllRightAngledAxes) {
  const Path path = HandHeldPath();
  const MotionTrack track = TrackOf(path);
  for (const Eigen::Matrix3d& axes : RightAngledRotations()) {
    const TruthReading best = FindReading(track, WithAxes(path, axes)).best;
    EXPECT_FALSE(best.is_mirrored);
    ExpectReading(best, PoseConvention::kCameraInWorld, axes, "rotation");
  }
}

TEST(FindReading, FindsImagesMirroredAlongEachAxis) {
  const Path path = HandHeldPath();
  for (int axis = 0; axis < 3; ++axis) {
    const MotionTrack track = TrackOf(Mirrored(path, axis));
    Eigen::Vector3d signs = Eigen::Vector3d::Ones();
    signs(axis) = -1.0;
    for (const Eigen::Matrix3d& axes : RightAngledRotations()) {
      const Eigen::Matrix3d expected = signs.asDiagonal() * axes;
      // Rotations with all axes reversed are those of the camera.
      if (expected == -Eigen::Matrix3d::Identity()) continue;
      const TruthReading best = FindReading(track, WithAxes(path, axes)).best;
      EXPECT_TRUE(best.is_mirrored);
      ExpectReading(best, PoseConvention::kCameraInWorld, expected, std::to_string(axis));
    }
  }
}

TEST(FindReading, FindsEachConventionWithAndWithoutOtherAxes) {
  const Path path = HandHeldPath();
  const MotionTrack track = TrackOf(path);
  const Eigen::Matrix3d opengl = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  for (const Eigen::Matrix3d& axes : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), opengl}) {
    const Path body = WithAxes(path, axes);
    ExpectReading(FindReading(track, body).best, PoseConvention::kCameraInWorld, axes, "given");
    ExpectReading(FindReading(track, Inverse(body)).best, PoseConvention::kWorldInCamera, axes,
                  "inverse");
    ExpectReading(FindReading(track, WithInverseRotations(body)).best,
                  PoseConvention::kInverseRotation, axes, "inverse rotation");
    ExpectReading(FindReading(track, WithScalarFirst(body)).best, PoseConvention::kScalarFirst,
                  axes, "scalar first");
  }
}

TEST(FindReading, PositionsDecideIfTheCameraDoesNotRoll) {
  // Reversed rotations are those of an upside-down camera.
  const Path path = HandHeldPath({1.0, 1.0, 0.0});
  const MotionTrack track = TrackOf(path);
  const Eigen::Matrix3d upside_down = Eigen::Vector3d(-1.0, -1.0, 1.0).asDiagonal();
  ExpectReading(FindReading(track, WithAxes(path, upside_down)).best,
                PoseConvention::kCameraInWorld, upside_down, "upside down");
  const Eigen::Matrix3d camera = Eigen::Matrix3d::Identity();
  ExpectReading(FindReading(track, Inverse(path)).best, PoseConvention::kWorldInCamera, camera,
                "inverse");
  ExpectReading(FindReading(track, WithInverseRotations(path)).best,
                PoseConvention::kInverseRotation, camera, "inverse rotation");
}

TEST(FindReading, FindsAxesAtATimeOffset) {
  const Path path = HandHeldPath();
  const MotionTrack track = TrackOf(path);
  for (const Eigen::Matrix3d& axes : RightAngledRotations()) {
    Path late = WithAxes(path, axes);
    for (TimedPose& pose : late) pose.timestamp += 0.15;
    const TruthReading best = FindReading(track, late).best;
    ExpectReading(best, PoseConvention::kCameraInWorld, axes, "late");
    EXPECT_NEAR(best.offset, 0.15, 0.01);
  }
}

TEST(FindReading, KeepsPosesThatAgree) {
  const Path path = HandHeldPath();
  for (int seed = 0; seed < 20; ++seed) {
    const TruthReading best =
        FindReading(TrackOf(path, seed), WithAxes(path, TurnAbout({1.0, 2.0, 3.0}, 3.0))).best;
    EXPECT_TRUE(best.camera_from_body.isIdentity());
    EXPECT_EQ(best.convention, PoseConvention::kCameraInWorld);
  }
}

TEST(FindReading, ReadsNoOtherSequence) {
  const MotionTrack track = TrackOf(HandHeldPath());
  for (const double phase : {7.0, 20.0, 33.0, 46.0, 59.0, 72.0, 85.0, 98.0}) {
    const TruthReading best = FindReading(track, HandHeldPath({1, 1, 1}, {1, 1, 1}, phase)).best;
    EXPECT_GT(best.disagreement, kMaxDisagreement) << phase << ": " << DescriptionOf(best);
  }
}

TEST(DescribeReading, NamesAxes) {
  const Path path = HandHeldPath();
  const MotionTrack track = TrackOf(path);
  const auto describe = [&](const Eigen::Matrix3d& axes) {
    return DescriptionOf(FindReading(track, WithAxes(path, axes)).best);
  };
  const struct {
    Eigen::Vector3d axis;
    double degrees;
    const char* text;
  } turns[] = {{{1, 0, 0}, 180, "are x, -y, -z of the camera; rotate"},
               {{0, 1, 0}, 180, "are -x, y, -z of the camera; rotate"},
               {{0, 0, 1}, 180, "are -x, -y, z of the camera; rotate"},
               {{0, 0, 1}, 90, "are y, -x, z of the camera; rotate"},
               {{1, 0, 0}, 169, "are x, -y, -z of the camera up to 11.*degrees"},
               {{1, 0, 0}, 11, "rotated by a 11.* degree turn about x"},
               {{1, 2, 3}, 37, "rotated by a 37.* degree turn about .0.27, 0.5[34], 0.80"}};
  for (const auto& turn : turns) {
    EXPECT_THAT(describe(TurnAbout(turn.axis, turn.degrees)), ContainsRegex(turn.text));
  }
}

TEST(DescribeReading, NamesMirroredImages) {
  const Path path = HandHeldPath();
  const auto describe = [&](int axis, const Eigen::Matrix3d& axes) {
    return DescriptionOf(FindReading(TrackOf(Mirrored(path, axis)), WithAxes(path, axes)).best);
  };
  const Eigen::Matrix3d camera = Eigen::Matrix3d::Identity();
  EXPECT_THAT(describe(0, camera), Names("mirrored left to right", "mirror the images"));
  EXPECT_THAT(describe(0, camera), Not(HasSubstr("fy")));
  EXPECT_THAT(describe(1, camera), Names("top to bottom", "make fy negative"));
  EXPECT_THAT(describe(2, camera), Names("mirrored", "x, y, -z of the camera"));
  // Images that are mirrored both ways are turned.
  EXPECT_THAT(describe(0, TurnAbout({0, 0, 1}, 180)), Names("make fy negative"));
  EXPECT_THAT(describe(1, TurnAbout({0, 0, 1}, 180)), Names("left to right"));
  EXPECT_THAT(describe(1, TurnAbout({1, 2, 3}, 37)), Names("mirrored", "rotated"));
}

TEST(DescribeReading, LeavesMirroringOpenIfTheCameraStaysInPlace) {
  const Path path = HandHeldPath({1.0, 1.0, 1.0}, {0.01, 0.01, 0.01});
  const TruthReading best =
      FindReading(TrackOf(path), WithAxes(path, TurnAbout({1, 0, 0}, 180))).best;
  EXPECT_THAT(DescriptionOf(best), Names("x, -y, -z of the camera", "mirrored"));
}

TEST(GroundTruthFindings, TakeAxesAndMirroringForOneFault) {
  const Path path = HandHeldPath();
  for (int axis = -1; axis < 3; ++axis) {
    const MotionTrack track = TrackOf(axis < 0 ? path : Mirrored(path, axis));
    for (int turned = axis < 0 ? 0 : -1; turned < 3; ++turned) {
      if (axis >= 0 && turned == axis) continue;  // all axes are reversed
      const Eigen::Matrix3d axes = turned < 0 ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                              : TurnAbout(Eigen::Vector3d::Unit(turned), 180);
      Findings findings;
      AddGroundTruthMotionFindings(track, WithAxes(path, axes), {5000.0, false}, true, &findings);
      int num_warnings = 0;
      for (const Finding& finding : findings) {
        num_warnings += finding.severity != Severity::kGood;
      }
      EXPECT_EQ(num_warnings, 1) << axis << " " << turned << "\n" << Text(findings);
      ExpectFinding(findings, Severity::kWarning, "ground_truth.convention", Names("ground truth"),
                    "axes");
    }
  }
}

// The finding of a check that is not tested.
std::string NotTested(const MotionTrack& track, const Path& path, const std::string& check) {
  Findings findings;
  AddGroundTruthMotionFindings(track, path, {5000.0, false}, true, &findings);
  return ExpectFinding(findings, Severity::kGood, check, Names("not tested"), check).text;
}

TEST(GroundTruthFindings, NameTheReasonWhyNothingIsTested) {
  const Path path = HandHeldPath();
  MotionTrack track = TrackOf(path);
  track.images.resize(20);
  track.pairs.resize(1);
  track.num_images = 150;
  track.num_weak = 130;
  EXPECT_THAT(NotTested(track, path, "ground_truth.convention"),
              Names("20 of 150", "130", "weak", "1 pairs", "8"));
  const Path straight = HandHeldPath({0, 0, 0});
  EXPECT_THAT(NotTested(TrackOf(straight), straight, "ground_truth.convention"),
              Names("turns too little", "degrees", "1.7"));
  const Path tripod = HandHeldPath({1, 1, 1}, {0, 0, 0});
  EXPECT_THAT(NotTested(TrackOf(tripod), tripod, "ground_truth.positions"),
              Names("moves too little", "0 mm", "30"));
}

// The rotations of a uniform turn are the same at all times.
TEST(GroundTruthFindings, HaveNoTimeOffsetThatTheMotionDoesNotDetermine) {
  Path path = HandHeldPath();
  for (TimedPose& pose : path) {
    pose.world_from_cam = Rigid3(ExpSO3(0.3 * pose.timestamp * Eigen::Vector3d(0.1, 1.0, 0.2)),
                                 pose.world_from_cam.translation());
  }
  EXPECT_THAT(NotTested(TrackOf(path), path, "ground_truth.time_offset"), Names("+-", "ms"));
}

}  // namespace
}  // namespace msc_vo
