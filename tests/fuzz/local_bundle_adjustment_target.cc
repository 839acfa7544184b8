// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Local bundle adjustment of a small window whose fields and options the input changes to finite
// and non-finite values: refused with a message, or solved with finite results.

#include <cmath>
#include <stdexcept>

#include "tests/fuzz/fuzz_target.h"
#include "tests/fuzz/window_changes.h"
#include "tests/support/test_window.h"

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/bundle_adjustment/window_covariance.h"

namespace msc_vo {
namespace {

WindowData MakeWindow() {
  TestWindowOptions options;
  options.num_keyframes = 3;
  options.num_fixed = 1;
  options.num_points = 5;
  options.num_lines = 6;
  options.max_observations = 2;
  WindowData data = MakeTestWindow(options).data;
  const auto id = [&data](size_t i) { return data.lines[i].id; };
  data.parallel_pairs = {{id(0), id(3)}, {id(1), id(4), 0.02, 3}};
  data.perpendicular_pairs = {{id(0), id(1)}, {id(2), id(3)}};
  data.axis_alignments = {{id(0), Eigen::Vector3d::UnitX()}, {id(5), Eigen::Vector3d::UnitZ()}};
  WindowData::PosePrior prior{data.keyframes[1].id, data.keyframes[1].cam_from_world};
  prior.covariance *= 1e-4;
  data.pose_priors = {prior};
  return data;
}

void CheckSolved(const BundleAdjustmentSummary& summary, const WindowData& data) {
  Require(std::isfinite(summary.initial_cost) && std::isfinite(summary.final_cost),
          "finite costs of a usable result");
  for (const auto& keyframe : data.keyframes) {
    Require(keyframe.cam_from_world.params.allFinite(), "finite poses");
    Require(std::abs(keyframe.cam_from_world.rotation().norm() - 1.0) < 1e-6, "unit quaternions");
  }
  for (const auto& point : data.points) {
    Require(point.position.allFinite() && std::isfinite(point.noise) && point.noise > 0.0,
            "finite points with positive noise");
  }
  for (const auto& line : data.lines) {
    Require(line.segment.start.allFinite() && line.segment.end.allFinite() &&
                std::isfinite(line.depth_offset) && std::isfinite(line.noise) && line.noise > 0.0,
            "finite lines with positive noise");
  }
}

template <typename Covariances>
void CheckCovariances(const Covariances& covariances) {
  for (const auto& covariance : covariances) {
    if (!covariance) continue;
    Require(covariance->allFinite(), "finite covariances");
    Require(covariance->diagonal().minCoeff() >= 0.0, "variances that are not negative");
  }
}

void CheckCovariance(const BundleAdjustmentOptions& options, const WindowData& solved) {
  CovarianceSelection selection;
  for (const auto& keyframe : solved.keyframes) selection.keyframes.push_back(keyframe.id);
  for (const auto& point : solved.points) selection.points.push_back(point.id);
  for (const auto& line : solved.lines) selection.lines.push_back(line.id);
  const WindowCovariance covariance = EstimateCovariance(options, solved, selection);
  CheckCovariances(covariance.keyframes);
  CheckCovariances(covariance.points);
  CheckCovariances(covariance.lines);
}

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static const WindowData window = MakeWindow();
  BundleAdjustmentOptions options;
  options.landmark_noise.enabled = true;
  WindowData changed = window;
  WindowChanges(data, size).Apply(&options, &changed);
  WindowData solved = changed;
  BundleAdjustmentSummary summary;
  if (!AcceptsData([&] { summary = LocalBundleAdjustment(options, &solved); })) return 0;
  if (!summary.usable) {
    Require(SameState(solved, changed), "a solver that fails leaves the data unchanged");
    return 0;
  }
  CheckSolved(summary, solved);
  CheckCovariance(options, solved);
  return 0;
}
