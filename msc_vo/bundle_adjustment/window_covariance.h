// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {

/// Ids of the keyframes, landmarks and extra blocks whose covariances are requested.
struct CovarianceSelection {
  std::vector<int64_t> keyframes, points, lines;
  std::vector<int64_t> extra_blocks = {};
};

/// Marginal covariances in the order of a CovarianceSelection. Zero for fixed items; empty where
/// the window does not determine an item, such as a point observed once without depth, or a
/// landmark whose standard deviation exceeds a third of its distance from the nearest camera.
struct WindowCovariance {
  /// Of (w, u) in the tangent space of Rigid3Manifold, where the true cam_from_world is
  /// (Exp(w) q, t + u): rotation vector in the camera frame (radians), then translation (metres).
  std::vector<std::optional<Eigen::Matrix<double, 6, 6>>> keyframes;
  std::vector<std::optional<Eigen::Matrix3d>> points;  ///< World, metres^2.
  /// Of start, then end; world, metres^2. Along the line it is that of the endpoint prior,
  /// line_endpoint_prior_sigma^2, unless other terms constrain it further.
  std::vector<std::optional<Eigen::Matrix<double, 6, 6>>> lines;
  /// In the tangent spaces of the manifolds (radians for UnitVectorManifold), or of the values
  /// without a manifold.
  std::vector<std::optional<Eigen::MatrixXd>> extra_blocks;
};

/// Computes marginal covariances: blocks of the inverse Gauss-Newton Hessian (J^T J)^-1 at
/// `solved`, a window after LocalBundleAdjustment. Observations, depths, pairs and alignments that
/// are marked as rejected are excluded; factors are weighted by the derivative of their loss. With
/// options.landmark_noise, estimated factors count with their own uncertainty. The result is
/// relative to the fixed items, which count as exact.
///
/// Throws std::invalid_argument for the same input as LocalBundleAdjustment, and for a selected id
/// that is not in the window.
WindowCovariance EstimateCovariance(const BundleAdjustmentOptions& options,
                                    const WindowData& solved, const CovarianceSelection& selected);

/// Covariance of world_from_cam from that of cam_from_world (order as above): rotation vector in
/// the world (radians), then camera position in the world (metres).
Eigen::Matrix<double, 6, 6> CovarianceInWorld(const Rigid3& cam_from_world,
                                              const Eigen::Matrix<double, 6, 6>& covariance);

}  // namespace msc_vo
