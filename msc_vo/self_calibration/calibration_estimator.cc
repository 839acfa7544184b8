// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/self_calibration/self_calibrating_bundle_adjustment.h"

namespace msc_vo {

namespace {

// Pairs that are linearised again after a keyframe.
constexpr size_t kMaxRelinearized = 2;
// Iterations over all pairs before a correction is accepted.
constexpr int kIterations = 3;
// A correction in use is replaced when its standard deviation has shrunk to this ratio, and the
// estimate differs by more than this number of standard deviations.
constexpr double kSigmaRatio = 0.7;
constexpr double kMinChange = 1.0;

// Posterior odds above which a correction is accepted, and the largest standard deviations with
// which it is: of the logarithm of the focal length, of the principal point (pixels), and of k1.
// Chosen by measurement, see docs/lab/self_calibration.md.
constexpr double kAcceptedOdds = 20.0;
constexpr double kMaxFocalLengthSigma = 0.01;
constexpr double kMaxCenterSigma = 3.5;
constexpr double kMaxK1Sigma = 0.03;

// Pairs after which their estimation ends if all groups are certain.
constexpr size_t kSettledPairs = 150;

// Bundle adjustment is repeated when the map has grown by this ratio, up to this size.
constexpr double kGrowth = 1.25;
constexpr size_t kLastSize = 60;
// It replaces a correction that moves a pixel by more than this, a tenth of the noise of a point.
constexpr double kMinShift = 0.1;

constexpr WrongGroups kAll = {true, true, true, true};
constexpr std::array<CorrectionGroup, 3> kColorGroups = {
    CorrectionGroup::kFocalLength, CorrectionGroup::kPrincipalPoint, CorrectionGroup::kLens};
constexpr auto kRegistration = static_cast<size_t>(CorrectionGroup::kDepthRegistration);

// Whether the parameters of a group are certain enough for a correction to be an improvement. What
// the model of the sensor leaves out looks like errors of parameters that are hardly observable.
bool IsCertain(CorrectionGroup group, const SensorCorrection::Vector& sigma) {
  using S = SensorCorrection;
  switch (group) {
    case CorrectionGroup::kFocalLength:
      return sigma(S::kFocalLength) < kMaxFocalLengthSigma;
    case CorrectionGroup::kPrincipalPoint:
      return std::max(sigma(S::kCenterX), sigma(S::kCenterY)) < kMaxCenterSigma;
    case CorrectionGroup::kLens:
      return sigma(S::kK1) < kMaxK1Sigma;
    case CorrectionGroup::kDepthRegistration:
      break;
  }
  return false;
}

// Whether all groups are certain, so that further images need not be looked at.
bool IsSettled(const SensorCorrection::Vector& sigma, size_t num_pairs) {
  return num_pairs >= kSettledPairs && IsCertain(CorrectionGroup::kFocalLength, sigma) &&
         IsCertain(CorrectionGroup::kPrincipalPoint, sigma) &&
         IsCertain(CorrectionGroup::kLens, sigma);
}

// Logarithms of the odds above which groups are accepted.
using LogOdds = std::array<double, kNumCorrectionGroups>;

LogOdds RequiredOfPairs() {
  LogOdds required;
  required.fill(std::log(kAcceptedOdds));
  return required;
}

// The groups `before`, and those whose correction is accepted. If the registration of depth may be
// wrong, nothing new is: its error may look like one of the colour camera.
CorrectionEstimate Select(const CalibrationInformation& information, const WrongGroups& before,
                          const LogOdds& required) {
  const LogOdds log_odds = SelectCorrections(information, before).log_odds;
  const SensorCorrection::Vector sigma = EstimateCorrections(information, kAll).sigma;
  WrongGroups wrong = before;
  for (int g = 0; g < kNumCorrectionGroups && log_odds[kRegistration] < 0.0; ++g) {
    if (log_odds[g] > required[g] && IsCertain(static_cast<CorrectionGroup>(g), sigma))
      wrong[g] = true;
  }
  CorrectionEstimate estimate = EstimateCorrections(information, wrong);
  estimate.log_odds = log_odds;
  return estimate;
}

// The groups of the colour camera that may be wrong by the pairs alone. Half of the certainty is
// enough that a correction requires.
WrongGroups CandidateGroups(const CorrectionEstimate& pairs) {
  WrongGroups candidates = {};
  for (const CorrectionGroup group : kColorGroups) {
    const auto g = static_cast<size_t>(group);
    candidates[g] =
        pairs.log_odds[g] > std::log(kCandidateOdds) && IsCertain(group, 0.5 * pairs.sigma);
  }
  return candidates;
}

// What bundle adjustment of the map requires: nothing is accepted that is no candidate by the
// pairs, and where they find an error more likely than not, the map needs to agree only.
LogOdds RequiredOfMap(const CorrectionEstimate& pairs) {
  const WrongGroups candidates = CandidateGroups(pairs);
  LogOdds required;
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    required[g] = !candidates[g]          ? std::numeric_limits<double>::infinity()
                  : pairs.log_odds[g] > 0 ? 0.0
                                          : std::log(kAcceptedOdds);
  }
  return required;
}

// The estimate of the pairs with the adjusted values of the corrected groups.
CorrectionEstimate WithAdjusted(const CorrectionEstimate& adjusted, CorrectionEstimate pairs) {
  for (const CorrectionGroup group : kColorGroups) {
    const auto g = static_cast<size_t>(group);
    if (!adjusted.is_corrected[g] || !pairs.is_corrected[g]) continue;
    pairs.log_odds[g] = adjusted.log_odds[g];
    for (const int i : IndicesOf(group)) {
      pairs.correction(i) = adjusted.correction(i);
      pairs.sigma(i) = std::max(pairs.sigma(i), adjusted.sigma(i));
    }
  }
  return pairs;
}

// Largest displacement (pixels) of an undistorted point when the calibration changes, at nine
// points of the image.
double LargestShift(const CameraIntrinsics& from, const CameraIntrinsics& to) {
  double shift = 0.0;
  for (const double x : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 0.5, 1.0}) {
      const Eigen::Vector2d pixel(x * from.camera.width, y * from.camera.height);
      const Eigen::Vector3d ray = from.camera.Ray(pixel);
      shift = std::max(shift, (MovePixel(from, to, pixel) - to.camera.Project(ray)).norm());
    }
  }
  return shift;
}

}  // namespace

CalibrationEstimator::CalibrationEstimator(const std::shared_ptr<const CameraIntrinsics>& given)
    : given_(given), present_(given), pairs_(*given) {}

bool CalibrationEstimator::Update(const Map& map, KeyframeId newest, const cv::Mat& depth,
                                  const std::vector<CalibrationImage>& images,
                                  double readout_sigma) {
  if (!IsSettled(estimate_.sigma, pairs_.size())) {
    for (const CalibrationImage& image : images) {
      pairs_.AddImage(map, image, at_);
    }
    pairs_.AddKeyframe(map, newest, depth, at_);
    if (SelectGroups(readout_sigma) || IsReplacementDue()) return Apply();
  }
  if (!IsAdjustmentDue(map.keyframes().size())) return false;
  return Adjust(map, readout_sigma) && Apply();
}

bool CalibrationEstimator::Apply() {
  const auto corrected =
      std::make_shared<CameraIntrinsics>(Corrected(*given_, estimate_.correction));
  std::string error;
  if (!IsInvertible(corrected->distortion, corrected->camera, &error)) {
    estimate_ = applied_;
    adjusted_.reset();
    return false;
  }
  present_ = corrected;
  applied_ = estimate_;
  return true;
}

bool CalibrationEstimator::SelectGroups(double readout_sigma) {
  const WrongGroups before = estimate_.is_corrected;
  // Linearises at the present optimum of all parameters.
  const auto linearize = [this, readout_sigma](size_t max_pairs) {
    const CorrectionEstimate free = EstimateCorrections(pairs_.Sum(readout_sigma), kAll);
    at_ = free.correction;
    pairs_.Relinearize(at_, free.sigma, max_pairs);
  };
  linearize(kMaxRelinearized);
  CorrectionEstimate selected = Select(pairs_.Sum(readout_sigma), before, RequiredOfPairs());
  if (selected.is_corrected != before) {
    for (int i = 0; i < kIterations; ++i) linearize(pairs_.size());
    selected = Select(pairs_.Sum(readout_sigma), before, RequiredOfPairs());
  }
  estimate_ = adjusted_ ? WithAdjusted(*adjusted_, selected) : selected;
  if (selected.is_corrected == before) return false;
  next_size_ = 0;
  return true;
}

bool CalibrationEstimator::IsReplacementDue() const {
  if (!estimate_.IsCorrected() || adjusted_) return false;
  const SensorCorrection::Vector change = estimate_.correction - applied_.correction;
  for (int g = 0; g < kNumCorrectionGroups; ++g) {
    if (!estimate_.is_corrected[g]) continue;
    for (const int i : IndicesOf(static_cast<CorrectionGroup>(g))) {
      if (estimate_.sigma(i) < kSigmaRatio * applied_.sigma(i) &&
          std::abs(change(i)) > kMinChange * estimate_.sigma(i)) {
        return true;
      }
    }
  }
  return false;
}

bool CalibrationEstimator::IsAdjustmentDue(size_t num_keyframes) const {
  const bool is_new_map = 2 * num_keyframes < adjusted_size_;
  return (num_keyframes >= next_size_ || is_new_map) && estimate_.log_odds[kRegistration] < 0.0 &&
         (estimate_.IsCorrected() || CandidateGroups(estimate_) != WrongGroups());
}

bool CalibrationEstimator::Adjust(const Map& map, double readout_sigma) {
  adjusted_size_ = map.keyframes().size();
  next_size_ = adjusted_size_ < kLastSize
                   ? std::max(adjusted_size_ + 1,
                              static_cast<size_t>(kGrowth * static_cast<double>(adjusted_size_)))
                   : std::numeric_limits<size_t>::max();
  auto information = SelfCalibratingBundleAdjustment(*given_, map, estimate_.correction);
  if (!information) return false;
  *information += pairs_.Sum(readout_sigma);
  const CorrectionEstimate adjusted =
      Select(*information, estimate_.is_corrected, RequiredOfMap(estimate_));
  const CameraIntrinsics corrected = Corrected(*given_, adjusted.correction);
  std::string error;
  if (!adjusted.IsCorrected() || !IsInvertible(corrected.distortion, corrected.camera, &error)) {
    return false;
  }
  const bool is_new = adjusted.is_corrected != estimate_.is_corrected;
  adjusted_ = adjusted;
  estimate_.is_corrected = adjusted.is_corrected;
  estimate_ = WithAdjusted(adjusted, estimate_);
  if (!is_new && LargestShift(*present_, corrected) <= kMinShift) return false;
  // Landmarks and outliers were selected with the calibration of the start.
  next_size_ = adjusted_size_ + 1;
  return true;
}

}  // namespace msc_vo
