// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/odometry_options.h"

#include <algorithm>

#include "msc_vo/odometry/option.h"
#include "msc_vo/text/enum_names.h"

namespace msc_vo {

namespace {

void ApplyMode(OdometryOptions* options) {
  if (options->mode == Mode::kPlVo) {
    options->features.line_depth = LineDepthMethod::kEndPoints;
    options->mapping.frame_structure = false;
  }
  if (options->mode != Mode::kMscVo) {
    options->mapping.pairs.parallel = false;
    options->mapping.pairs.perpendicular = false;
    options->mapping.axes.enabled = false;
    options->features.extract_planes = false;
  }
}

void ShareMatchers(OdometryOptions* options) {
  options->mapping.fusion.matchers = options->tracking.matchers;
}

void ShareLosses(OdometryOptions* options) {
  const BundleAdjustmentOptions& window = options->mapping.window;
  PoseOptions& pose = options->tracking.pose;
  pose.point_reprojection = window.point_reprojection;
  pose.point_depth = window.point_depth;
  pose.line_reprojection = window.line_reprojection;
  pose.line_depth = window.line_depth;
  pose.reject_chi2_2 = window.reject_chi2_2;
  pose.reject_chi2_3 = window.reject_chi2_3;
  pose.reject_chi2_4 = window.reject_chi2_4;
}

// Error message of a relation between options that does not hold, or nullptr.
const char* RelationError(const OdometryOptions& options) {
  if (!(options.features.min_depth < options.features.max_depth)) {
    return "features.min_depth must be less than features.max_depth";
  }
  const PointExtractorOptions& points = options.features.points;
  if (points.min_fast_threshold > points.fast_threshold) {
    return "features.points.min_fast_threshold must not exceed features.points.fast_threshold";
  }
  const KeyframePolicyOptions& keyframes = options.tracking.keyframes;
  if (keyframes.min_interval > keyframes.max_interval) {
    return "tracking.keyframes.min_interval must not exceed tracking.keyframes.max_interval";
  }
  if (options.tracking.min_matches > options.tracking.min_initial_features) {
    return "tracking.min_matches must not exceed tracking.min_initial_features";
  }
  return nullptr;
}

// Error message of an invalid option that ListOptions() does not contain, or nullptr. NaN is
// invalid.
const char* UnlistedError(const OdometryOptions& options) {
  if (!(options.tracking.segments.search_interval >= 0.0)) {
    return "tracking.segments.search_interval must not be negative";
  }
  if (options.mapping.selection.min_observations < 1) {
    return "mapping.selection.min_observations must be at least 1";
  }
  const double redundant_ratio = options.mapping.culling.redundant_ratio;
  if (!(redundant_ratio > 0.0 && redundant_ratio <= 1.0)) {
    return "mapping.culling.redundant_ratio must be in (0, 1]";
  }
  return nullptr;
}

}  // namespace

const char* ToString(Mode mode) {
  return EnumName<Mode::kMscVo>(mode, {"pl-vo", "pl-vo-depth", "msc-vo"});
}

bool OdometryOptions::IsValid(std::string* error) const {
  if (!use_points && !use_lines) {
    *error = "options: use_points and use_lines must not both be off";
    return false;
  }
  OdometryOptions effective = EffectiveOptions(*this);
  if (!AreInRange(ListOptions(&effective), error)) return false;
  const char* problem = RelationError(effective);
  if (problem == nullptr) problem = UnlistedError(effective);
  if (problem != nullptr) {
    *error = problem;
    return false;
  }
  // These components have relations and options without a range, too.
  return effective.tracking.pose.IsValid(error) && effective.mapping.noise.IsValid(error) &&
         effective.mapping.window.IsValid(error);
}

OdometryOptions EffectiveOptions(OdometryOptions options) {
  ApplyMode(&options);
  ShareMatchers(&options);
  ShareLosses(&options);
  return options;
}

SurfaceNormalOptions NormalOptions(const OdometryOptions& options) {
  constexpr double kMaxDepth = 25.0;  // metres; sums of larger depths overflow
  SurfaceNormalOptions normals;
  normals.min_depth = options.features.min_depth;
  normals.max_depth = std::min(options.features.max_depth, kMaxDepth);
  return normals;
}

}  // namespace msc_vo
