// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "tests/phone_recordings/phone_folders.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/datasets/sequence_calibration.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

extern "C" VideoReader* msc_vo_make_video_reader();

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// The image of a camera with another focal length, and that camera.
struct Breathed {
  PinholeCamera camera;
  cv::Mat color;
  cv::Mat depth;       // CV_16UC1, millimetres
  cv::Mat confidence;  // CV_8UC1, 0, 1 or 2
};

Breathed Breathe(const PhoneSource& source, size_t i, const PhoneFolderOptions& options) {
  Breathed image;
  image.camera = source.camera;
  const double factor = 1.0 + options.breathing * std::sin(2.0 * M_PI * i / 8.0);
  image.camera.fx *= factor;
  image.camera.fy *= factor;
  const double s = 1.0 / factor, cx = source.camera.cx, cy = source.camera.cy;
  const cv::Matx23d map(s, 0.0, cx - s * cx, 0.0, s, cy - s * cy);
  const auto warp = [&](const cv::Mat& from, int interpolation) {
    cv::Mat to;
    cv::warpAffine(from, to, map, from.size(), interpolation | cv::WARP_INVERSE_MAP,
                   cv::BORDER_REPLICATE);
    return to;
  };
  const bool is_same = options.breathing == 0.0;
  const PhoneSource::Image& given = source.images[i];
  image.color = is_same ? given.color : warp(given.color, cv::INTER_CUBIC);
  const cv::Mat metres = is_same ? given.depth : warp(given.depth, cv::INTER_NEAREST);
  const int step = options.depth_step;
  image.depth.create(metres.rows / step, metres.cols / step, CV_16UC1);
  image.confidence = cv::Mat(image.depth.size(), CV_8UC1, cv::Scalar(2));
  for (int y = 0; y < image.depth.rows; ++y) {
    for (int x = 0; x < image.depth.cols; ++x) {
      float z = metres.at<float>(step * y + step / 2, step * x + step / 2);
      const bool is_uncertain = options.has_uncertain_depth && z > 0.0f &&
                                y < image.depth.rows / 2 && x < image.depth.cols / 2;
      if (is_uncertain) z += 0.3f;
      image.depth.at<uint16_t>(y, x) = cv::saturate_cast<uint16_t>(1000.0f * z);
      if (is_uncertain) image.confidence.at<uint8_t>(y, x) = 0;
    }
  }
  return image;
}

void Write(const fs::path& path, const cv::Mat& image) {
  fs::create_directories(path.parent_path());
  if (!cv::imwrite(path.string(), image)) throw std::runtime_error(path.string());
}

void Write(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

// ARKit's axes of the camera are x right, y up, z backward.
Eigen::Matrix4d ArkitPose(const Rigid3& world_from_cam) {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  pose.topLeftCorner<3, 3>() =
      world_from_cam.rotation().toRotationMatrix() * Eigen::Vector3d(1, -1, -1).asDiagonal();
  pose.topRightCorner<3, 1>() = world_from_cam.translation();
  return pose;
}

}  // namespace

PhoneSource ReadPhoneSource(const std::string& folder, int count) {
  SequenceIndex index = OpenSequence(folder, "tum");
  const Calibration calibration = ResolveCalibration({}, "", &index);
  const RgbdDecoder decoder(index, calibration);
  PhoneSource source;
  source.camera = calibration.camera;
  size_t next = 0;
  for (int i = 0; i < std::min(count, decoder.size()); ++i) {
    const RgbdImage image = decoder.Decode(i);
    while (next + 1 < index.ground_truth.size() &&
           std::abs(index.ground_truth[next + 1].timestamp - image.timestamp) <=
               std::abs(index.ground_truth[next].timestamp - image.timestamp)) {
      ++next;
    }
    source.images.push_back({image.timestamp, cv::imread(index.entries[i].color_path), image.depth,
                             index.ground_truth.at(next).world_from_cam});
  }
  return source;
}

void WriteStrayScanner(const PhoneSource& source, const PhoneFolderOptions& options,
                       const std::string& folder) {
  const fs::path root = folder;
  std::string odometry = "timestamp, frame, x, y, z, qx, qy, qz, qw";
  odometry += options.has_row_intrinsics ? ", fx, fy, cx, cy\n" : "\n";
  std::vector<cv::Mat> colors;
  PinholeCamera last;
  for (size_t i = 0; i < source.images.size(); ++i) {
    const Breathed image = Breathe(source, i, options);
    colors.push_back(image.color);
    const std::string name = FormatText("%06zu.png", i);
    Write(root / "depth" / name, image.depth);
    Write(root / "confidence" / name, image.confidence);
    const Rigid3& pose = source.images[i].world_from_cam;
    odometry += FormatText("%.9f, %06zu, %.9f, %.9f, %.9f, %.9f, %.9f, %.9f, %.9f",
                           source.images[i].timestamp, i, pose.translation().x(),
                           pose.translation().y(), pose.translation().z(), pose.rotation().x(),
                           pose.rotation().y(), pose.rotation().z(), pose.rotation().w());
    last = image.camera;
    odometry += options.has_row_intrinsics
                    ? FormatText(", %.6f, %.6f, %.6f, %.6f\n", last.fx, last.fy, last.cx, last.cy)
                    : "\n";
  }
  WriteVideo(colors, 30.0, (root / "rgb.mp4").string());
  Write(root / "odometry.csv", odometry);
  Write(root / "camera_matrix.csv", FormatText("%.6f, 0.0, %.6f\n0.0, %.6f, %.6f\n0.0, 0.0, 1.0",
                                               last.fx, last.cx, last.fy, last.cy));
}

void WritePolycam(const PhoneSource& source, const PhoneFolderOptions& options,
                  const std::string& prefix, const std::string& folder) {
  const fs::path root = fs::path(folder) / "keyframes";
  Write(fs::path(folder) / "mesh_info.json", std::string("{\"faceCount\": 1}"));
  for (size_t i = 0; i < source.images.size(); ++i) {
    const Breathed image = Breathe(source, i, options);
    const std::string name =
        std::to_string(std::llround(1e6 * (5000.0 + source.images[i].timestamp)));
    cv::Mat confidence;  // 0, 127, 255
    cv::LUT(
        image.confidence,
        [] {
          cv::Mat levels(1, 256, CV_8UC1, cv::Scalar(255));
          levels.at<uint8_t>(0) = 0;
          levels.at<uint8_t>(1) = 127;
          return levels;
        }(),
        confidence);
    Write(root / (prefix + "images") / (name + ".jpg"), image.color);
    Write(root / "depth" / (name + ".png"), image.depth);
    Write(root / "confidence" / (name + ".png"), confidence);
    Json camera = {{"fx", image.camera.fx},       {"fy", image.camera.fy},
                   {"cx", image.camera.cx},       {"cy", image.camera.cy},
                   {"width", image.camera.width}, {"height", image.camera.height},
                   {"blur_score", 90.0}};
    const Eigen::Matrix4d pose = ArkitPose(source.images[i].world_from_cam);
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 4; ++column) {
        camera[FormatText("t_%d%d", row, column)] = pose(row, column);
      }
    }
    Write(root / (prefix + "cameras") / (name + ".json"), camera.dump());
  }
}

void WriteScannerApp(const PhoneSource& source, const PhoneFolderOptions& options,
                     const std::string& folder) {
  const fs::path root = folder;
  for (size_t i = 0; i < source.images.size(); ++i) {
    const Breathed image = Breathe(source, i, options);
    const std::string number = FormatText("%05zu", 6 * i);
    Write(root / ("frame_" + number + ".jpg"), image.color);
    Write(root / ("depth_" + number + ".png"), image.depth);
    Write(root / ("conf_" + number + ".png"), image.confidence);
    const PinholeCamera& k = image.camera;
    const Eigen::Matrix<double, 4, 4, Eigen::RowMajor> pose =
        ArkitPose(source.images[i].world_from_cam);
    const Json json = {{"time", 70000.0 + source.images[i].timestamp},
                       {"frame_index", 6 * i},
                       {"intrinsics", {k.fx, 0.0, k.cx, 0.0, k.fy, k.cy, 0.0, 0.0, 1.0}},
                       {"cameraPoseARFrame", std::vector<double>(pose.data(), pose.data() + 16)}};
    Write(root / ("frame_" + number + ".json"), json.dump());
  }
}

void WriteVideo(const std::vector<cv::Mat>& images, double rate, const std::string& path) {
  fs::create_directories(fs::path(path).parent_path());
  cv::VideoWriter writer;
  for (const char* codec : {"avc1", "mp4v"}) {
    const int fourcc = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
    if (writer.open(path, cv::CAP_FFMPEG, fourcc, rate, images.front().size(), true)) break;
  }
  if (!writer.isOpened()) throw std::runtime_error(path + ": OpenCV cannot encode a video");
  for (const cv::Mat& image : images) writer.write(image);
}

std::unique_ptr<VideoReader> MakeTestVideoReader() {
  return std::unique_ptr<VideoReader>(msc_vo_make_video_reader());
}

}  // namespace msc_vo
