// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Conventions of other programs, each with a pose that tells left from right: a camera that has
// turned by 90 degrees to the right and looks along the x axis of the world.

#include <cmath>
#include <memory>
#include <utility>

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/datasets/trajectory.h"
#include "msc_vo/datasets/trajectory_format.h"
#include "msc_vo/exports/colmap_model.h"
#include "msc_vo/exports/map_export.h"
#include "msc_vo/exports/nerfstudio.h"
#include "msc_vo/exports/trajectory_export.h"

namespace msc_vo {
namespace {

// z of the camera is x of the world; x of the camera is -z of the world.
Rigid3 TurnedRight() {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY())),
          {1.0, 2.0, 3.0}};
}

CameraIntrinsics Intrinsics(LensDistortion lens = {}) {
  return {{500.0, 510.0, 319.5, 239.5, 640, 480}, std::move(lens)};
}

class ExportedTrajectoryTest : public TemporaryFolder {};

TEST_F(ExportedTrajectoryTest, IsReadBack) {
  const std::vector<TimedPose> poses = {{1305031102.175304, TurnedRight()},
                                        {1305031103.0, TurnedRight().Inverse()}};
  WriteText("kitti.txt", FormatKitti(poses));
  WriteText("euroc.csv", FormatEuroc(poses));
  for (const auto& [name, format] : {std::pair("kitti.txt", TrajectoryFormat::kKitti),
                                     std::pair("euroc.csv", TrajectoryFormat::kEuroc)}) {
    const TrajectoryFile file = ReadTrajectoryFile(Path(name));  // recognised by its contents
    EXPECT_EQ(file.format, format);
    ASSERT_EQ(file.poses.size(), 2u);
    for (size_t i = 0; i < 2; ++i) {
      const Rigid3 difference = file.poses[i].world_from_cam * poses[i].world_from_cam.Inverse();
      EXPECT_LT(difference.translation().norm(), 1e-7) << name;
      EXPECT_LT(difference.rotation().angularDistance(Eigen::Quaterniond::Identity()), 1e-7);
    }
  }
  EXPECT_THAT(FormatEuroc(poses), testing::HasSubstr("\n1305031102175304000,"));
  EXPECT_EQ(ReadTrajectoryFile(Path("euroc.csv")).poses[0].timestamp, 1305031102.175304);
}

TEST(Tum, HasTheCameraInTheWorld) {
  EXPECT_THAT(FormatTrajectory({{1.5, TurnedRight()}}),
              testing::HasSubstr("1.500000 1.0000000000 2.0000000000 3.0000000000 0.0000000000 "
                                 "0.7071067812 0.0000000000 0.7071067812\n"));
}

TEST(Nerfstudio, HasTheAxesOfOpenGl) {
  LensDistortion lens;
  lens.k = {0.1, -0.2, 0.001, 0.002};
  const auto json = nlohmann::json::parse(
      FormatNerfstudio(ExportCamera(Intrinsics(lens)), {{"c.png", "d.png", TurnedRight()}}));
  EXPECT_EQ(json["camera_model"], "OPENCV");
  EXPECT_EQ(json["fl_y"], 510.0);
  EXPECT_EQ(json["cx"], 320.0);  // centres of pixels end in .5
  EXPECT_EQ(json["k2"], -0.2);
  EXPECT_EQ(json["p2"], 0.002);
  const auto& frame = json["frames"][0];
  EXPECT_EQ(frame["file_path"], "c.png");
  EXPECT_EQ(frame["depth_file_path"], "d.png");
  const auto column = [&](int i) {
    const auto& matrix = frame["transform_matrix"];
    return Eigen::Vector3d(matrix[0][i], matrix[1][i], matrix[2][i]);
  };
  EXPECT_LT((column(0) - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12);  // right
  EXPECT_LT((column(1) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);  // up: y of the world is down
  EXPECT_LT((column(2) - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-12);  // backwards
  EXPECT_EQ(column(3), Eigen::Vector3d(1, 2, 3));
}

TEST(Nerfstudio, RefusesRationalLenses) {
  LensDistortion lens;
  lens.model = LensModel::kRational;
  lens.k = {0.1, 0.2, 0.0, 0.0, 0.3, 0.4, 0.0, 0.0};
  EXPECT_THROW(FormatNerfstudio(ExportCamera(Intrinsics(lens)), {}), std::runtime_error);
}

TEST(ExportedCamera, NamesTheModelOfTheLens) {
  LensDistortion lens;
  EXPECT_EQ(ExportCamera(Intrinsics()).model, "PINHOLE");
  lens.k = {0.1, 0.2, 0.0, 0.0, 0.3};
  EXPECT_EQ(ExportCamera(Intrinsics(lens)).model, "FULL_OPENCV");
  EXPECT_EQ(ExportCamera(Intrinsics(lens)).parameters.size(), 12u);
  LensDistortion fisheye;
  fisheye.model = LensModel::kFisheye;
  fisheye.k = {0.02, -0.01, 0.003, -0.001};
  fisheye.recorded = PinholeCamera{300.0, 301.0, 400.0, 300.0, 800, 600};
  const ExportedCamera camera = ExportCamera(Intrinsics(fisheye));
  EXPECT_EQ(camera.model, "OPENCV_FISHEYE");
  EXPECT_EQ(camera.width, 800);
  EXPECT_THAT(camera.parameters,
              testing::ElementsAre(300.0, 301.0, 400.5, 300.5, 0.02, -0.01, 0.003, -0.001));
}

// Two keyframes, of which the second has turned, and one point that both see.
class ColmapModelTest : public testing::Test {
 protected:
  ColmapModelTest() {
    lens_.k[0] = 0.1;
    const Rigid3 poses[] = {Rigid3(), TurnedRight().Inverse()};
    for (int i = 0; i < 2; ++i) {
      auto frame = std::make_shared<Frame>();
      frame->id = 5 * i;
      frame->camera = Intrinsics().camera;
      frame->intrinsics = std::make_shared<CameraIntrinsics>(Intrinsics(lens_));
      PointFeature feature;
      feature.pixel = frame->camera.Project(poses[i] * position_) + Eigen::Vector2d(0.0, 3.0 * i);
      frame->points = {PointFeature(), feature};
      keyframes_[i] = map_.AddKeyframe(frame, poses[i]);
    }
    const LandmarkId id = map_.Add<PointLandmark>(keyframes_[0], 1, position_);
    map_.Observe<PointLandmark>(id, keyframes_[1], 1);
    map_.Add<PointLandmark>(keyframes_[0], 0, position_);  // one observation
  }

  LensDistortion lens_;
  Eigen::Vector3d position_ = {4.0, 2.5, 3.5};
  KeyframeId keyframes_[2];
  Map map_;
};

TEST_F(ColmapModelTest, HasDistortedPixelsAndTracks) {
  const ColmapModel model = MakeColmapModel(
      map_, [](const Keyframe& keyframe) { return std::to_string(keyframe.frame->id) + ".png"; });
  ASSERT_EQ(model.cameras.size(), 1u);
  EXPECT_EQ(model.cameras[0].model, "OPENCV");
  ASSERT_EQ(model.images.size(), 2u);
  EXPECT_EQ(model.images[1].name, "5.png");
  ASSERT_EQ(model.points.size(), 1u);
  ASSERT_EQ(model.points[0].track.size(), 2u);
  // COLMAP's own projection: OPENCV, centres of pixels at .5.
  const ColmapModel::Image& image = model.images[1];
  const Eigen::Vector3d x = image.cam_from_world * position_;
  const Eigen::Vector2d u = x.head<2>() / x.z();
  const double radial = 1.0 + 0.1 * u.squaredNorm();
  const Eigen::Vector2d projected(500.0 * radial * u.x() + 320.0, 510.0 * radial * u.y() + 240.0);
  const double error = (image.features[0].pixel - projected).norm();
  EXPECT_LT(error, 4.0);  // of which 3 px are in the undistorted image
  EXPECT_NEAR(model.points[0].error, 0.5 * error, 1e-9);  // the other image has none
  EXPECT_NEAR(model.images[0].features[0].pixel.x(),
              500.0 * (4.0 / 3.5) * (1.0 + 0.1 * (16.0 + 6.25) / 12.25) + 320.0, 1e-9);
}

TEST_F(ColmapModelTest, ItsGraphHasTheCamerasInTheWorld) {
  const SavedSubMap submap = {0, std::move(map_), std::nullopt, {}};
  const std::string graph = FormatG2o(submap, {});
  EXPECT_THAT(graph, testing::StartsWith("VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n"));
  // Scalar last, and the camera has turned to its right.
  EXPECT_THAT(graph, testing::HasSubstr("\nVERTEX_SE3:QUAT 1 1 2 3 0 0.707106781 0 0.707106781\n"));
}

TEST_F(ColmapModelTest, OnlyItsBinaryFormHasNamesWithBlanks) {
  const ColmapModel model = MakeColmapModel(map_, [](const Keyframe&) { return "left 1.png"; });
  EXPECT_THAT(MessageOf([&] { FormatColmapText(model); }), Names("'left 1.png'", "--binary"));
  EXPECT_EQ(FormatColmapBinary(model).size(), 3u);
}

TEST_F(ColmapModelTest, IsTheSameAsTextAndBinary) {
  const ColmapModel model = MakeColmapModel(map_, [](const Keyframe&) { return "a.png"; });
  const std::vector<ModelFile> text = FormatColmapText(model), binary = FormatColmapBinary(model);
  EXPECT_EQ(text[0].content.substr(text[0].content.find('\n') + 1),
            "1 OPENCV 640 480 500 510 320 240 0.1 0 0 0\n");
  // Scalar first, world to camera: the second image has turned by 90 degrees about -y.
  EXPECT_THAT(text[1].content, testing::HasSubstr("\n2 0.707106781187 0 -0.707106781187 0 "));
  EXPECT_THAT(text[2].content, testing::HasSubstr("\n1 4 2.5 3.5 128 128 128 1.51714 1 0 2 0\n"));
  // The sizes that follow from the format.
  EXPECT_EQ(binary[0].content.size(), 8u + 4 + 4 + 8 + 8 + 8 * 8);
  EXPECT_EQ(binary[1].content.size(), 8u + 2 * (4 + 7 * 8 + 4 + 6 + 8 + 24));
  EXPECT_EQ(binary[2].content.size(), 8u + 8 + 24 + 3 + 8 + 8 + 2 * 8);
}

}  // namespace
}  // namespace msc_vo
