// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/nerfstudio.h"

#include <algorithm>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace msc_vo {

namespace {

using Json = nlohmann::ordered_json;

// The matrix of the pose; its camera has y up and z backwards.
Json OpenGlMatrix(const Rigid3& world_from_cam) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = world_from_cam.rotation().toRotationMatrix();
  matrix.topRightCorner<3, 1>() = world_from_cam.translation();
  matrix.col(1) = -matrix.col(1);
  matrix.col(2) = -matrix.col(2);
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    Json values = Json::array();
    for (int column = 0; column < 4; ++column) values.push_back(matrix(row, column));
    rows.push_back(values);
  }
  return rows;
}

}  // namespace

std::string FormatNerfstudio(const ExportedCamera& camera,
                             const std::vector<NerfstudioFrame>& frames) {
  constexpr size_t kNumPolynomial = 9;  // parameters up to k3
  for (size_t i = kNumPolynomial; i < camera.parameters.size(); ++i) {
    if (camera.parameters[i] == 0.0) continue;
    throw std::runtime_error("nerfstudio has no rational lens (k4, k5, k6); undistort the images");
  }
  Json json;
  json["generator"] = "msc_vo export";
  const bool is_fisheye = camera.model == "OPENCV_FISHEYE";
  json["camera_model"] = is_fisheye ? "OPENCV_FISHEYE" : "OPENCV";
  const char* const names[] = {"fl_x", "fl_y", "cx", "cy"};
  for (size_t i = 0; i < 4; ++i) json[names[i]] = camera.parameters[i];
  json["w"] = camera.width;
  json["h"] = camera.height;
  const std::vector<std::string> coefficients =
      is_fisheye ? std::vector<std::string>{"k1", "k2", "k3", "k4"}
                 : std::vector<std::string>{"k1", "k2", "p1", "p2", "k3"};
  for (size_t i = 4; i < std::min(camera.parameters.size(), kNumPolynomial); ++i) {
    json[coefficients[i - 4]] = camera.parameters[i];
  }
  Json list = Json::array();
  for (const NerfstudioFrame& frame : frames) {
    Json entry;
    entry["file_path"] = frame.color_path;
    if (!frame.depth_path.empty()) entry["depth_file_path"] = frame.depth_path;
    entry["transform_matrix"] = OpenGlMatrix(frame.world_from_cam);
    list.push_back(entry);
  }
  json["frames"] = list;
  return json.dump(2) + "\n";
}

}  // namespace msc_vo
