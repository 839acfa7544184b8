// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The example 08_depth_camera on images with 1280x720 colour and 640x480 depth pixels.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"
#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "msc_vo/sensor/depth_camera.h"
#include "msc_vo/synthetic/scene/synthetic_sequence.h"

namespace msc_vo {
namespace {

constexpr int kNumImages = 20;

class DepthCameraExample : public TemporaryFolder {
 protected:
  DepthCameraExample() {
    depth_camera_.camera = {580.0, 582.0, 318.0, 241.0, 640, 480};
    depth_camera_.depth_from_color = {
        Eigen::Quaterniond(Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ())),
        {0.025, 0.002, 0.001}};
  }

  // Writes the folder that the example reads; `rotation`: whether cameras.yml has R.
  void Render(int num_images, bool rotation = true) {
    const SyntheticSequence sequence(SyntheticSequenceOptions{});
    const Renderer color(sequence.scene(), color_), depth(sequence.scene(), depth_camera_.camera);
    std::ofstream list(Path("images.txt"));
    for (int i = 0; i < num_images; ++i) {
      const TimedPose pose = sequence.PoseAt(i);
      const Rigid3 color_from_world = pose.world_from_cam.Inverse();
      RenderedImage color_image = color.Render(color_from_world);
      RenderedImage depth_image = depth.Render(depth_camera_.depth_from_color * color_from_world);
      cv::Mat raw;
      cv::Mat(480, 640, CV_32FC1, depth_image.depth.data()).convertTo(raw, CV_16U, 1000.0);
      const std::string name = std::to_string(i) + ".png";
      cv::imwrite(Path("color" + name),
                  cv::Mat(720, 1280, CV_8UC1, color_image.Gray().data()).clone());
      cv::imwrite(Path("depth" + name), raw);
      list << std::to_string(pose.timestamp) << " color" << name << " depth" << name << "\n";
      truth_.push_back(color_from_world * sequence.PoseAt(0).world_from_cam);
    }
    WriteCameras(rotation);
  }

  // Runs the example, which prints to a file. Returns its exit code.
  int Run() {
    const std::string command = std::string(MSC_VO_DEPTH_CAMERA_EXAMPLE) + " " + Folder() + " > " +
                                Path("poses.txt") + " 2> " + Path("messages.txt");
    return std::system(command.c_str());
  }
  std::string Read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(Path(name)).rdbuf();
    return text.str();
  }

  const std::vector<Rigid3>& truth() const { return truth_; }

 private:
  void WriteCameras(bool rotation) const {
    const auto matrix = [](const PinholeCamera& camera) {
      return cv::Matx33d(camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0);
    };
    const Eigen::Matrix3d r = depth_camera_.depth_from_color.rotation().toRotationMatrix();
    const Eigen::Vector3d& t = depth_camera_.depth_from_color.translation();
    const cv::Mat no_lens = cv::Mat::zeros(1, 5, CV_64FC1);
    cv::FileStorage file(Path("cameras.yml"), cv::FileStorage::WRITE);
    file << "M1" << cv::Mat(matrix(color_)) << "D1" << no_lens;
    file << "M2" << cv::Mat(matrix(depth_camera_.camera)) << "D2" << no_lens;
    if (rotation) {
      const cv::Matx33d rows(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1),
                             r(2, 2));
      file << "R" << cv::Mat(rows);
    }
    file << "T" << cv::Mat(cv::Vec3d(t.x(), t.y(), t.z()));
  }

  PinholeCamera color_{910.0, 910.0, 639.5, 359.5, 1280, 720};
  DepthCamera depth_camera_;
  std::vector<Rigid3> truth_;  // cam_from_world
};

TEST_F(DepthCameraExample, TracksImagesOfDifferentSizes) {
  Render(kNumImages);
  ASSERT_EQ(Run(), 0) << Read("messages.txt");
  std::istringstream poses(Read("poses.txt"));
  int count = 0;
  double time = 0.0, x = 0.0, y = 0.0, z = 0.0, qx = 0.0, qy = 0.0, qz = 0.0, qw = 0.0;
  while (poses >> time >> x >> y >> z >> qx >> qy >> qz >> qw) {
    ASSERT_LT(count, kNumImages);
    const Rigid3 truth = this->truth()[count++].Inverse();
    EXPECT_LT((Eigen::Vector3d(x, y, z) - truth.translation()).norm(), 0.01) << time;
    EXPECT_LT(Eigen::Quaterniond(qw, qx, qy, qz).angularDistance(truth.rotation()), 0.005) << time;
  }
  EXPECT_EQ(count, kNumImages);
}

TEST_F(DepthCameraExample, NamesWhatIsMissing) {
  EXPECT_NE(Run(), 0);
  EXPECT_NE(Read("messages.txt").find("images.txt"), std::string::npos);
  Render(1, /*rotation=*/false);
  EXPECT_NE(Run(), 0);
  EXPECT_NE(Read("messages.txt").find("no matrix R"), std::string::npos);
  std::filesystem::remove(Path("depth0.png"));
  EXPECT_NE(Run(), 0);
  EXPECT_NE(Read("messages.txt").find("depth0.png"), std::string::npos);
}

}  // namespace
}  // namespace msc_vo
