// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/depth_curve.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include "msc_vo/geometry/quantile.h"

namespace msc_vo {

namespace {

// Depth is sampled in cells, so many per row of the image.
constexpr int kCellsPerRow = 160;
// Widths of the patches, cells: small ones where surfaces are small, large ones where depth is
// noisy. Neighbours overlap by half.
constexpr int kPatchSizes[] = {12, 24, 40};
// Standard deviation of rounding to whole raw units.
constexpr double kRounding = 0.3;

// Steepest slope of a patch, relative to its value: of depth, an incidence of 79 degrees. Beyond,
// it is likely a depth edge that a stereo matcher has smoothed, whose two halves bend.
constexpr double kMaxSlope = 5.0;

// A patch counts if the two curves differ by so many standard deviations of its measurement. It
// supports the curve that it is nearer to than this ratio of their difference.
constexpr double kMinSigmas = 4.0;
constexpr double kTolerance = 0.25;
// Fewest patches in excess of those by chance that support a curve, and fewest places in the image
// where such patches are.
constexpr int kMinVotes = 10;
// Ratio of these patches to those that support the other curve: surfaces that are not plane support
// both about equally. Of sequences that are described right, at most 0.4 times as many patches
// support another curve as depth, see docs/lab/depth_curve.md.
constexpr int kMinRatio = 2;
// A curve with a parameter must gain so much over inverse depth, which has none.
constexpr double kMinGain = 1.2;

// Origins of inverted depth as multiples of the largest value, exponents of z = v^q, and scales of
// log z = v / a as multiples of the median value.
constexpr double kOrigins[] = {1.02, 1.05, 1.1, 1.18, 1.3, 1.5, 2.0, 3.0};
constexpr double kCompressed[] = {2.0, 3.0};
constexpr double kStretched[] = {0.5, 1.0 / 3.0};
constexpr double kLogScales[] = {0.2, 0.25, 0.3, 0.4};
// Undescribed lenses x (1 + k |x|^2), which undistort the plane z = 1: from the pincushions of
// depth cameras (k < 0) to fisheye lenses (tan(x) / x: 0.33 near the axis, 0.8 far from it), so
// close that the bend of a lens between two of them is within kTolerance of one.
constexpr double kLenses[] = {-0.25, -0.18, -0.13, -0.09, -0.06, -0.04, 0.04, 0.06, 0.09,
                              0.13,  0.18,  0.25,  0.33,  0.43,  0.55,  0.68, 0.82};

using PatchesByPlace = std::vector<std::vector<SurfacePatch>>;

// What a patch measures if the values are a function of depth.
using Prediction = std::function<double(const SurfacePatch&)>;

struct Hypothesis {
  DepthCurve curve = DepthCurve::kDepth;
  Prediction predict;  // the bowl if the curve is kRayLength, else the bend
  double origin = 0.0;
};

bool Proves(int num_for, int num_against) { return num_for >= kMinRatio * num_against + kMinVotes; }

// Of depth behind a lens that is not described.
Prediction DepthBehindLens(DepthCurve curve, double k) {
  if (curve == DepthCurve::kRayLength) {
    return [k](const SurfacePatch& patch) { return patch.BowlOfLens(k); };
  }
  return [k](const SurfacePatch& patch) { return patch.BendOfLens(k); };
}

// Numbers of patches that agree with the first and with the second prediction, and of places with
// the first ones. Only patches count whose measurement distinguishes the two.
struct Support {
  int first = 0;
  int second = 0;
  int first_places = 0;
};

Support Compare(const PatchesByPlace& patches, DepthCurve curve, const Prediction& first,
                const Prediction& second) {
  const bool is_bowl = curve == DepthCurve::kRayLength;
  Support support;
  for (const std::vector<SurfacePatch>& place : patches) {
    const int before = support.first;
    for (const SurfacePatch& patch : place) {
      const double measured = is_bowl ? patch.bowl : patch.bend;
      const double of_first = first(patch);
      const double of_second = second(patch);
      const double difference = std::abs(of_first - of_second);
      if (!(difference > kMinSigmas * (is_bowl ? patch.bowl_sigma : patch.bend_sigma))) continue;
      support.first += std::abs(measured - of_first) < kTolerance * difference;
      support.second += std::abs(measured - of_second) < kTolerance * difference;
    }
    support.first_places += support.first > before;
  }
  return support;
}

DepthCurveTest::Votes CountVotes(const PatchesByPlace& patches, const Hypothesis& hypothesis) {
  const Support support = Compare(patches, hypothesis.curve, hypothesis.predict,
                                  DepthBehindLens(hypothesis.curve, 0.0));
  return {hypothesis.curve,     support.first,     support.second,
          support.first_places, hypothesis.origin, false};
}

// Whether depth behind some undescribed lens explains the patches as well, or nearly so.
bool MayBeLens(const PatchesByPlace& patches, const Hypothesis& hypothesis) {
  return std::any_of(std::begin(kLenses), std::end(kLenses), [&](double k) {
    const Support support = Compare(patches, hypothesis.curve, hypothesis.predict,
                                    DepthBehindLens(hypothesis.curve, k));
    return !Proves(support.first, support.second);
  });
}

Hypothesis InverseDepth() {
  return {DepthCurve::kInverse, [](const SurfacePatch&) { return 0.0; }};
}

// Every curve other than depth; those with a parameter once for each value.
std::vector<Hypothesis> CurvesFor(const PatchesByPlace& patches) {
  std::vector<double> values;
  for (const std::vector<SurfacePatch>& place : patches) {
    for (const SurfacePatch& patch : place) values.push_back(patch.value);
  }
  const double largest = *std::max_element(values.begin(), values.end());
  const double median = Median(std::move(values));
  std::vector<Hypothesis> curves = {InverseDepth()};
  for (const double factor : kOrigins) {
    const double origin = factor * largest;
    curves.push_back({DepthCurve::kInverted,
                      [origin](const SurfacePatch& patch) { return 2.0 / (origin - patch.value); },
                      origin});
  }
  const auto add_power = [&](DepthCurve curve, double q) {
    curves.push_back({curve, [q](const SurfacePatch& patch) { return -(q + 1.0) / patch.value; }});
  };
  for (const double q : kCompressed) add_power(DepthCurve::kCompressed, q);
  for (const double q : kStretched) add_power(DepthCurve::kStretched, q);
  for (const double a : kLogScales) {
    const double bend = -1.0 / (a * median);
    curves.push_back({DepthCurve::kCompressed, [bend](const SurfacePatch&) { return bend; }});
  }
  curves.push_back(
      {DepthCurve::kRayLength, [](const SurfacePatch& patch) { return patch.BowlOfRay(); }});
  return curves;
}

double Score(const DepthCurveTest::Votes& votes) {
  return (votes.num_curve - votes.num_depth) / std::sqrt(votes.num_curve + votes.num_depth + 1.0);
}

}  // namespace

bool DepthCurveTest::Votes::ProveCurve() const {
  return Proves(num_curve, num_depth) && num_curve_places >= kMinVotes;
}

bool DepthCurveTest::Votes::ProveDepth() const { return Proves(num_depth, num_curve); }

DepthCurveTest::DepthCurveTest(const PinholeCamera& camera, const LensDistortion& distortion,
                               double depth_scale)
    : depth_scale_(depth_scale) {
  const PinholeCamera& recorded = distortion.Recorded(camera);
  step_ = std::max(1, recorded.width / kCellsPerRow);
  rays_.create((recorded.height + step_ - 1) / step_, (recorded.width + step_ - 1) / step_);
  constexpr double kRayTolerance = 1e-6;
  for (int y = 0; y < rays_.rows; ++y) {
    for (int x = 0; x < rays_.cols; ++x) {
      const Eigen::Vector2d distorted = recorded.Ray({x * step_, y * step_}).head<2>();
      const Eigen::Vector2d ray = distortion.UndistortNormalized(distorted, kRayTolerance);
      rays_(y, x) = {ray.x(), ray.y()};
    }
  }
}

void DepthCurveTest::Add(const cv::Mat& recorded) {
  // Some drivers write their largest value for everything beyond.
  cv::Mat depth = recorded.clone();
  cv::patchNaNs(depth, 0.0);
  double largest = 0.0;
  cv::minMaxLoc(depth, nullptr, &largest);
  depth.setTo(0.0f, depth >= largest);
  cv::Mat_<float> values(rays_.size());
  for (int y = 0; y < values.rows; ++y) {
    for (int x = 0; x < values.cols; ++x) values(y, x) = depth.at<float>(y * step_, x * step_);
  }
  const double rounding = kRounding / depth_scale_;
  size_t place = 0;
  for (const int size : kPatchSizes) {
    for (int y = 0; y + size <= values.rows; y += size / 2) {
      for (int x = 0; x + size <= values.cols; x += size / 2) {
        const cv::Rect cells(x, y, size, size);
        const std::optional<SurfacePatch> patch =
            MeasurePatch(values(cells), rays_(cells), rounding);
        if (patch && patch->gradient.norm() < kMaxSlope * patch->value) {
          patches_.resize(std::max(patches_.size(), place + 1));
          patches_[place].push_back(*patch);
        }
        ++place;
      }
    }
  }
}

DepthCurveTest::Votes DepthCurveTest::OfInverse() const {
  return CountVotes(patches_, InverseDepth());
}

DepthCurveTest::Votes DepthCurveTest::Best() const {
  Votes best;
  if (patches_.empty()) return best;
  Hypothesis best_curve;
  for (const Hypothesis& curve : CurvesFor(patches_)) {
    const Votes votes = CountVotes(patches_, curve);
    const double gain = best.curve == DepthCurve::kInverse && Score(best) > 0.0 ? kMinGain : 1.0;
    const bool is_first = best.curve == DepthCurve::kDepth;
    if (!is_first && !(Score(votes) > gain * Score(best))) continue;
    best = votes;
    best_curve = curve;
  }
  best.may_be_lens = best.ProveCurve() && MayBeLens(patches_, best_curve);
  return best;
}

bool DepthCurveTest::IsDecided() const {
  if (patches_.empty()) return false;
  if (Best().ProveCurve()) return true;
  const std::vector<Hypothesis> curves = CurvesFor(patches_);
  return std::all_of(curves.begin(), curves.end(), [this](const Hypothesis& curve) {
    return CountVotes(patches_, curve).ProveDepth();
  });
}

}  // namespace msc_vo
