// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Odometry from the images of a colour camera and of a depth camera beside it, which have different
// sizes and are not registered to each other. Reads them with OpenCV from a folder with
//
// - cameras.yml: M1, D1 of colour, M2, D2 of depth, R, T from colour to depth (metres), the names
//   that OpenCV's example of stereo calibration writes;
// - images.txt: time stamp in seconds, colour file, depth file (16 bits, millimetres) of an image.
//
// Prints the pose of every image: time stamp, position and quaternion (x y z w) of the camera in
// the world.

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "msc_vo/odometry/odometry.h"
#include "msc_vo/sensor/depth_registration.h"

namespace {

struct Cameras {
  msc_vo::PinholeCamera color;
  msc_vo::LensDistortion lens;
  msc_vo::DepthCamera depth;
};

cv::Mat ReadMatrix(const cv::FileStorage& file, const std::string& name) {
  cv::Mat matrix;
  file[name] >> matrix;
  if (matrix.empty()) throw std::runtime_error("cameras.yml has no matrix " + name);
  matrix.convertTo(matrix, CV_64F);
  return matrix;
}

msc_vo::PinholeCamera ReadCamera(const cv::FileStorage& file, const std::string& name,
                                 const cv::Size& size) {
  const cv::Mat_<double> k = ReadMatrix(file, name);
  return {k(0, 0), k(1, 1), k(0, 2), k(1, 2), size.width, size.height};
}

// OpenCV's models with up to 5 and with 8 coefficients.
msc_vo::LensDistortion ReadLens(const cv::FileStorage& file, const std::string& name) {
  const cv::Mat_<double> coefficients = ReadMatrix(file, name).reshape(1, 1);
  msc_vo::LensDistortion lens;
  if (coefficients.cols > static_cast<int>(lens.k.size())) {
    throw std::runtime_error(name + " in cameras.yml has more than 8 coefficients");
  }
  if (coefficients.cols > 5) lens.model = msc_vo::LensModel::kRational;
  std::copy(coefficients.begin(), coefficients.end(), lens.k.begin());
  return lens;
}

Cameras ReadCameras(const std::string& path, const cv::Size& color, const cv::Size& depth) {
  const cv::FileStorage file(path, cv::FileStorage::READ);
  if (!file.isOpened()) throw std::runtime_error("cannot read " + path);
  Cameras cameras;
  cameras.color = ReadCamera(file, "M1", color);
  cameras.lens = ReadLens(file, "D1");
  cameras.depth.camera = ReadCamera(file, "M2", depth);
  cameras.depth.distortion = ReadLens(file, "D2");
  const cv::Mat_<double> r = ReadMatrix(file, "R"), t = ReadMatrix(file, "T");
  const Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix3d>(r[0]).transpose();
  cameras.depth.depth_from_color = {Eigen::Quaterniond(rotation).normalized(),
                                    Eigen::Vector3d(t(0), t(1), t(2))};
  std::string error;
  if (!cameras.depth.IsValid(&error)) throw std::runtime_error(path + ": " + error);
  return cameras;
}

cv::Mat ReadImage(const std::string& path, int flags, int type) {
  const cv::Mat image = cv::imread(path, flags);
  if (image.empty()) throw std::runtime_error("cannot read " + path);
  if (image.type() != type) throw std::runtime_error(path + " is of another type than expected");
  return image;
}

void Print(const msc_vo::FrameResult& frame) {
  const msc_vo::Rigid3 pose = frame.cam_from_world.Inverse();
  const Eigen::Vector3d& x = pose.translation();
  const Eigen::Quaterniond& q = pose.rotation();
  std::printf("%.6f %.6f %.6f %.6f %.7f %.7f %.7f %.7f\n", frame.timestamp, x.x(), x.y(), x.z(),
              q.x(), q.y(), q.z(), q.w());
}

// Returns whether all images were tracked.
bool Run(const std::string& folder) {
  std::ifstream list(folder + "/images.txt");
  if (!list) throw std::runtime_error("cannot read " + folder + "/images.txt");
  std::unique_ptr<msc_vo::DepthRegistration> registration;
  std::unique_ptr<msc_vo::Odometry> odometry;
  msc_vo::RgbdImage image;
  int num_lost = 0;
  std::clock_t registration_time = 0;
  std::string color_file, depth_file;
  while (list >> image.timestamp >> color_file >> depth_file) {
    image.gray = ReadImage(folder + "/" + color_file, cv::IMREAD_GRAYSCALE, CV_8UC1);
    const cv::Mat raw = ReadImage(folder + "/" + depth_file, cv::IMREAD_UNCHANGED, CV_16UC1);
    raw.convertTo(image.recorded_depth, CV_32F, 0.001);
    if (odometry == nullptr) {  // the sizes are those of the first image
      const Cameras cameras = ReadCameras(folder + "/cameras.yml", image.gray.size(), raw.size());
      registration =
          std::make_unique<msc_vo::DepthRegistration>(cameras.depth, cameras.color, cameras.lens);
      odometry = std::make_unique<msc_vo::Odometry>(msc_vo::OdometryOptions(), cameras.color,
                                                    cameras.lens);
    }
    const std::clock_t begin = std::clock();
    image.depth = registration->Register(image.recorded_depth);
    registration_time += std::clock() - begin;
    const msc_vo::FrameResult frame = odometry->Process(image);
    const bool is_tracked = frame.status == msc_vo::TrackingStatus::kTracked ||
                            frame.status == msc_vo::TrackingStatus::kWeak;
    if (is_tracked) Print(frame);
    num_lost += !is_tracked;
    ++image.id;
  }
  if (odometry == nullptr) throw std::runtime_error(folder + "/images.txt lists no image");
  odometry->Finish();
  std::fprintf(stderr, "%ld images, %d lost, registration %.1f ms per image\n",
               static_cast<long>(image.id), num_lost,
               1000.0 * registration_time / CLOCKS_PER_SEC / static_cast<double>(image.id));
  return num_lost == 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  try {
    return Run(argv[1]) ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
