// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Pose optimization of a frame whose matches, prediction and options the input changes to finite
// and non-finite values: refused with a message, or solved with finite results.

#include <cmath>
#include <stdexcept>

#include "tests/fuzz/byte_reader.h"
#include "tests/fuzz/fuzz_target.h"
#include "tests/support/test_window.h"

#include "msc_vo/pose_estimation/pose_optimization.h"

namespace msc_vo {
namespace {

PoseData MakeFrame() {
  TestWindowOptions options;
  options.num_keyframes = 3;
  options.num_points = 12;
  options.num_lines = 6;
  options.max_observations = 3;
  return MakePoseData(MakeTestWindow(options), 1);
}

class PoseChanges {
 public:
  PoseChanges(const uint8_t* data, size_t size) : bytes_(data, size) {}

  void Apply(PoseOptions* options, PoseData* data) {
    constexpr int kMaxChanges = 24;
    for (int i = 0; i < kMaxChanges && !bytes_.AtEnd(); ++i) {
      switch (bytes_.Below(6)) {
        case 0:
          ChangeOptions(options);
          break;
        case 1:
          ChangeItems(data);
          break;
        case 2:
          Change(Fields(data));
          break;
        case 3:
          if (!data->lines.empty()) ChangeLine(&data->lines[bytes_.Below(data->lines.size())]);
          break;
        default:
          if (!data->points.empty()) ChangePoint(&data->points[bytes_.Below(data->points.size())]);
      }
    }
  }

 private:
  void Change(const std::vector<double*>& fields) {
    double* const field = fields[bytes_.Below(fields.size())];
    *field = bytes_.NumberFor(*field);
  }

  static std::vector<double*> Fields(PoseData* data) {
    PinholeCamera& camera = data->camera;
    std::vector<double*> fields = {&camera.fx, &camera.fy, &camera.cx, &camera.cy};
    for (int i = 0; i < 7; ++i) fields.push_back(&data->cam_from_world.params[i]);
    return fields;
  }

  void ChangePoint(PoseData::Point* point) {
    std::vector<double*> fields = {
        &point->pixel.x(),     &point->pixel.y(),           &point->sigma,
        &point->inverse_depth, &point->inverse_depth_sigma, &point->map_variance};
    for (int i = 0; i < 3; ++i) fields.push_back(&point->position[i]);
    Change(fields);
    point->confirmed = bytes_.Below(4) != 0;
  }

  void ChangeLine(PoseData::Line* line) {
    std::vector<double*> fields = {&line->sigma, &line->depth.start, &line->depth.end,
                                   &line->map_variance};
    for (int i = 0; i < 3; ++i) {
      fields.push_back(&line->map_segment.start[i]);
      fields.push_back(&line->map_segment.end[i]);
    }
    for (int i = 0; i < 2; ++i) {
      fields.push_back(&line->segment.start[i]);
      fields.push_back(&line->segment.end[i]);
      fields.push_back(&line->depth.covariance(0, i));
      fields.push_back(&line->depth.covariance(1, i));
    }
    Change(fields);
    line->has_depth = bytes_.Below(4) != 0;
  }

  void ChangeItems(PoseData* data) {
    constexpr size_t kMaxItems = 64;
    const size_t action = bytes_.Below(6);
    if (action < 2) data->points.resize(bytes_.Below(data->points.size() + 1));
    if (action == 2) data->lines.resize(bytes_.Below(data->lines.size() + 1));
    if (action > 2 && !data->points.empty() && data->points.size() < kMaxItems) {
      data->points.push_back(PoseData::Point(data->points[bytes_.Below(data->points.size())]));
    }
  }

  void ChangeOptions(PoseOptions* options) {
    int* const counts[] = {&options->num_rounds, &options->num_robust_rounds,
                           &options->iterations_per_round};
    if (bytes_.Below(2) == 0) {
      // More rounds would only take longer.
      int* const count = counts[bytes_.Below(3)];
      *count = static_cast<int>(bytes_.Below(66)) - 1;
      return;
    }
    Change({&options->point_reprojection.huber, &options->point_depth.huber,
            &options->line_reprojection.huber, &options->line_depth.huber, &options->reject_chi2_2,
            &options->reject_chi2_3, &options->reject_chi2_4, &options->max_frame_noise});
    options->line_reprojection.enabled = bytes_.Below(8) != 0;
    options->point_depth.enabled = bytes_.Below(8) != 0;
    options->consensus.enabled = bytes_.Below(8) != 0;
  }

  ByteReader bytes_;
};

void CheckSolved(const PoseSummary& summary, const PoseData& data) {
  Require(data.cam_from_world.params.allFinite(), "a finite pose");
  Require(std::abs(data.cam_from_world.rotation().norm() - 1.0) < 1e-6, "a unit quaternion");
  Require(std::isfinite(summary.final_cost), "a finite cost");
  Require(summary.covariance.allFinite(), "a finite covariance");
  Require(summary.covariance.diagonal().minCoeff() > 0.0, "positive variances");
}

}  // namespace
}  // namespace msc_vo

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static const PoseData frame = MakeFrame();
  PoseOptions options;
  PoseData changed = frame;
  PoseChanges(data, size).Apply(&options, &changed);
  PoseData solved = changed;
  PoseSummary summary;
  if (!AcceptsData([&] { summary = OptimizePose(options, &solved); })) return 0;
  if (summary.usable) {
    CheckSolved(summary, solved);
  } else {
    Require(solved.cam_from_world.params == changed.cam_from_world.params,
            "without a result, the pose is the prediction");
  }
  return 0;
}
