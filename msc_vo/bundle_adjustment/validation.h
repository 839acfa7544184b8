// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cmath>
#include <string>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/geometry/line_fit.h"
#include "msc_vo/geometry/line_segment.h"
#include "msc_vo/geometry/rigid3.h"

namespace msc_vo {

// Input checks that local bundle adjustment and pose optimization share. Each returns a description
// of the error, or nullptr; the caller adds the name of the item.

const char* PoseError(const Rigid3& cam_from_world);
const char* PositionError(const Eigen::Vector3d& position);
const char* MapLineError(const LineSegment3& segment);
const char* PointObservationError(const Eigen::Vector2d& pixel, double sigma, double inverse_depth,
                                  double inverse_depth_sigma);
const char* LineObservationError(const LineSegment2& segment, double sigma, bool has_depth,
                                 const LineDepth& depth);
const char* NoiseError(double noise);
const char* DepthOffsetError(double offset);
/// Requires correlations that are symmetric to 1e-6, and positive definiteness.
const char* CovarianceError(const Eigen::Matrix2d& covariance);
const char* CovarianceError(const Eigen::Matrix<double, 6, 6>& covariance);
const char* LinePairError(const WindowData::LinePair& pair);
const char* AxisAlignmentError(const WindowData::AxisAlignment& alignment);
const char* UnitVectorError(const Eigen::Vector3d& v);

/// Checks the options that BundleAdjustmentOptions and PoseOptions share.
template <typename Options>
bool CommonOptionsAreValid(const Options& options, std::string* error) {
  const auto is_positive = [](double x) { return std::isfinite(x) && x > 0.0; };
  if (!is_positive(options.point_reprojection.huber) || !is_positive(options.point_depth.huber) ||
      !is_positive(options.line_reprojection.huber) || !is_positive(options.line_depth.huber)) {
    *error = "every huber threshold must be a positive number of sigmas";
  } else if (!is_positive(options.reject_chi2_2) || !is_positive(options.reject_chi2_3) ||
             !is_positive(options.reject_chi2_4)) {
    *error = "reject_chi2_2, reject_chi2_3 and reject_chi2_4 must be positive";
  } else {
    return true;
  }
  return false;
}

}  // namespace msc_vo
