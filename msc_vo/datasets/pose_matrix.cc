// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/pose_matrix.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

Eigen::MatrixXd ReadMatrix(const std::string& path, int rows, int columns) {
  std::vector<double> values;
  for (const TextLine& line : ReadTextLines(path)) {
    for (const std::string& field : line.fields) {
      const std::optional<double> value = ParseNumber(field);
      if (!value) line.Fail("'" + field + "' is not a number; correct the line");
      values.push_back(*value);
    }
  }
  if (rows == 4 && columns == 4 && values.size() == 12) {
    values.insert(values.end(), {0.0, 0.0, 0.0, 1.0});
  }
  if (values.size() != static_cast<size_t>(rows) * columns) {
    throw std::runtime_error(path + ": expected " + std::to_string(rows) + " x " +
                             std::to_string(columns) + " numbers, found " +
                             std::to_string(values.size()) + "; write all " + std::to_string(rows) +
                             " rows");
  }
  return Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), rows, columns);
}

std::optional<Rigid3> RigidFromMatrix(const Eigen::Matrix4d& matrix) {
  if (!matrix.allFinite()) return std::nullopt;
  const Eigen::Matrix3d r = matrix.topLeftCorner<3, 3>();
  // Far above the rounding of numbers with about six digits, far below other matrices.
  constexpr double kMaxDeviation = 1e-2;
  const double deviation = (r.transpose() * r - Eigen::Matrix3d::Identity()).norm();
  if (deviation > kMaxDeviation || r.determinant() < 0.0) return std::nullopt;
  constexpr double kMaxRounding = 1e-6;
  const Eigen::RowVector4d last_row(0.0, 0.0, 0.0, 1.0);
  if ((matrix.row(3) - last_row).norm() > kMaxRounding) return std::nullopt;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(r, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Matrix3d nearest = svd.matrixU() * svd.matrixV().transpose();
  return Rigid3(Eigen::Quaterniond(nearest).normalized(), matrix.topRightCorner<3, 1>());
}

std::optional<Rigid3> PoseFromMatrix(const Eigen::Matrix4d& matrix, const std::string& place) {
  std::optional<Rigid3> pose = RigidFromMatrix(matrix);
  if (pose || !RigidFromMatrix(matrix.transpose())) return pose;
  throw std::runtime_error(place +
                           ": the last row of the pose holds the translation; write the "
                           "transposed matrix, [R t; 0 0 0 1]");
}

void ReadPoseFiles(const std::function<std::string(const SequenceEntry&)>& pose_path,
                   SequenceIndex* index) {
  int num_invalid = 0;
  for (const SequenceEntry& entry : index->entries) {
    const std::string path = pose_path(entry);
    if (!HasEntry(path)) continue;
    const std::optional<Rigid3> pose = PoseFromMatrix(ReadMatrix(path, 4, 4), path);
    if (pose) {
      index->ground_truth.push_back({entry.timestamp, *pose});
    } else {
      ++num_invalid;
    }
  }
  if (num_invalid > 0) {
    index->warnings.push_back(std::to_string(num_invalid) +
                              " ground-truth poses are not valid and are left out");
  }
}

}  // namespace msc_vo
