// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/sensor/clipped_depth.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "msc_vo/geometry/quantile.h"

namespace msc_vo {

namespace {

// Largest distance between samples, pixels, and samples in a row of a smaller image: with fewer,
// the distances between sampled values next to a clipped one exceed the rounding.
constexpr int kMaxStep = 8, kMinColumns = 80;
// Ratio of the image that areas of a clipped value cover.
constexpr double kMinArea = 0.01;
// Images that end at a value this close to the extreme one do not reach it by chance only.
constexpr float kSimilar = 0.9f;
constexpr size_t kNumLevels = 16;  // values next to the extreme one that show the rounding
// Samples of a clipped value in proportion to those of the values next to it. Where depth ends
// without being clipped, the last step of the rounding has as many as those before.
constexpr size_t kMinExcess = 4;
constexpr size_t kMinCommon = 32;   // samples that show the motion
constexpr float kMinMotion = 2.0f;  // steps of the rounding
// Images of real surfaces reach one, with depth rounded to 3 cm two; see docs/lab/depth.md.
constexpr int kMinMoved = 4;

// Calls visit(x, y) for every sample.
template <typename Visitor>
void ForEachSample(const cv::Mat& depth, const Visitor& visit) {
  const int step = std::clamp(depth.cols / kMinColumns, 2, kMaxStep);
  for (int y = step / 2; y + 1 < depth.rows; y += step) {
    for (int x = step / 2; x + 1 < depth.cols; x += step) visit(x, y);
  }
}

// Samples of a depth image, 0 outside the limits.
std::vector<float> SampleDepths(const cv::Mat& depth, const DepthLimits& limits) {
  std::vector<float> samples;
  ForEachSample(depth, [&](int x, int y) {
    const float z = depth.at<float>(y, x);
    samples.push_back(limits.Contain(z) ? z : 0.0f);
  });
  return samples;
}

// Ratio of the samples that have this value, and whose four neighbours have it.
double AreaOf(float value, const cv::Mat& depth, size_t num_samples) {
  size_t count = 0;
  ForEachSample(depth, [&](int x, int y) {
    const float* z = depth.ptr<float>(y) + x;
    if (z[0] == value && z[-1] == value && z[1] == value && depth.at<float>(y - 1, x) == value &&
        depth.at<float>(y + 1, x) == value) {
      ++count;
    }
  });
  return static_cast<double>(count) / static_cast<double>(num_samples);
}

// The rounding of the values next to the extreme one.
struct Rounding {
  float step = 0.0f;       // usual distance between them; 0: there are too few
  size_t num_samples = 0;  // usual number of samples with the same value
  size_t num_extreme = 0;  // number of samples with the extreme value
};

Rounding RoundingNextTo(float extreme, std::vector<float> samples, int sign) {
  std::sort(samples.begin(), samples.end(),
            [sign](float a, float b) { return static_cast<float>(sign) * (a - b) > 0.0f; });
  std::vector<float> steps, counts;
  Rounding rounding;
  float last = 0.0f;
  for (const float z : samples) {
    if (z == extreme) ++rounding.num_extreme;
    if (z <= 0.0f || z == extreme) continue;
    if (z != last) {
      if (steps.size() == kNumLevels) break;
      if (last > 0.0f) steps.push_back(std::abs(z - last));
      counts.push_back(0.0f);
      last = z;
    }
    ++counts.back();
  }
  if (steps.size() < 2) return rounding;
  rounding.step = UpperMedian(std::move(steps));
  rounding.num_samples = static_cast<size_t>(UpperMedian(std::move(counts)));
  return rounding;
}

// Change of depth of the scene between two images, as a surface at the extreme value would show it:
// by a rotation, nearer ones change less. 0 if the images have too little in common.
float MotionBetween(const std::vector<float>& a, const std::vector<float>& b, float extreme) {
  std::vector<float> changes;
  for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (a[i] <= 0.0f || b[i] <= 0.0f || a[i] == extreme || b[i] == extreme) continue;
    changes.push_back(std::abs(a[i] - b[i]) * std::min(1.0f, extreme / b[i]));
  }
  return changes.size() < kMinCommon ? 0.0f : UpperMedian(std::move(changes));
}

}  // namespace

bool ClippedDepthFinder::AddEvidence(const cv::Mat& depth, const std::vector<float>& samples,
                                     int sign, Evidence* evidence) {
  float extreme = 0.0f;
  for (const float z : samples) {
    if (z > 0.0f && (extreme == 0.0f || static_cast<float>(sign) * (z - extreme) > 0.0f)) {
      extreme = z;
    }
  }
  if (extreme == 0.0f) return false;
  const float ratio = evidence->value == 0.0f ? 0.0f
                      : sign > 0              ? extreme / evidence->value
                                              : evidence->value / extreme;
  if (evidence->value == 0.0f || ratio > 1.0f) {
    *evidence = {};
    evidence->value = extreme;
  }
  if (extreme != evidence->value) {
    if (ratio > kSimilar) ++evidence->num_others;
    return false;
  }
  Rounding rounding;
  const bool has_areas = AreaOf(extreme, depth, samples.size()) >= kMinArea;
  if (has_areas) rounding = RoundingNextTo(extreme, samples, sign);
  if (!has_areas || rounding.num_extreme < kMinExcess * rounding.num_samples) {
    ++evidence->num_others;
    return false;
  }
  ++evidence->num_clipped;
  const bool is_first = evidence->num_moved == 0;
  if (rounding.step == 0.0f) return false;
  if (!is_first &&
      MotionBetween(evidence->last_moved, samples, extreme) <= kMinMotion * rounding.step) {
    return false;
  }
  evidence->last_moved = samples;
  ++evidence->num_moved;
  return evidence->num_moved >= kMinMoved && evidence->num_clipped >= evidence->num_others;
}

bool ClippedDepthFinder::Add(const cv::Mat& depth) {
  const std::vector<float> samples = SampleDepths(depth, limits_);
  const bool is_far = AddEvidence(depth, samples, 1, &farthest_);
  const bool is_near = AddEvidence(depth, samples, -1, &nearest_);
  if (is_far) {
    limits_.farthest = farthest_.value;
    farthest_ = {};
  }
  if (is_near) {
    limits_.nearest = nearest_.value;
    nearest_ = {};
  }
  return is_far || is_near;
}

}  // namespace msc_vo
