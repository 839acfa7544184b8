// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <vector>

#include <opencv2/core.hpp>

namespace msc_vo {

/// A depth image (CV_32FC1, may be empty) as plain values, for checkpoints.
class StoredDepth {
 public:
  explicit StoredDepth(const cv::Mat& depth) : rows_(depth.rows), columns_(depth.cols) {
    for (int row = 0; row < rows_; ++row) {
      values_.insert(values_.end(), depth.ptr<float>(row), depth.ptr<float>(row) + columns_);
    }
  }

  cv::Mat Image() const {
    if (values_.empty()) return {};
    return cv::Mat(values_).reshape(1, rows_).clone();
  }

  /// Lists the state for a checkpoint.
  template <typename Archive>
  void Serialize(Archive& archive) {
    archive(rows_, columns_, values_);
  }

 private:
  int rows_;
  int columns_;
  std::vector<float> values_;
};

}  // namespace msc_vo
