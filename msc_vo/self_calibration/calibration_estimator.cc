// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "msc_vo/camera/lens_validity.h"

namespace msc_vo {

namespace {

// Pairs that are linearised again after a keyframe.
constexpr size_t kMaxRelinearized = 1;
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

// Pairs after which the estimation ends if all groups are certain.
constexpr size_t kSettledPairs = 150;

constexpr WrongGroups kAll = {true, true, true, true};
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

// The groups `before` and those whose correction is accepted. If the registration of depth may be
// wrong, nothing new is: its error may look like one of the colour camera.
CorrectionEstimate Select(const CalibrationInformation& information, const WrongGroups& before) {
  const std::array<double, kNumCorrectionGroups> log_odds =
      SelectCorrections(information, before).log_odds;
  const SensorCorrection::Vector sigma = EstimateCorrections(information, kAll).sigma;
  WrongGroups wrong = before;
  for (int g = 0; g < kNumCorrectionGroups && log_odds[kRegistration] < 0.0; ++g) {
    if (log_odds[g] > std::log(kAcceptedOdds) && IsCertain(static_cast<CorrectionGroup>(g), sigma))
      wrong[g] = true;
  }
  CorrectionEstimate estimate = EstimateCorrections(information, wrong);
  estimate.log_odds = log_odds;
  return estimate;
}

}  // namespace

CalibrationEstimator::CalibrationEstimator(const std::shared_ptr<const CameraIntrinsics>& given)
    : given_(given), present_(given), pairs_(*given) {}

bool CalibrationEstimator::Update(const Map& map, KeyframeId newest, const cv::Mat& depth,
                                  const std::vector<CalibrationImage>& images,
                                  double readout_sigma) {
  if (IsSettled(estimate_.sigma, pairs_.size())) return false;
  for (const CalibrationImage& image : images) {
    pairs_.AddImage(map, image, at_);
  }
  pairs_.AddKeyframe(map, newest, depth, at_);
  if (!SelectGroups(readout_sigma) && !IsReplacementDue()) return false;
  const auto corrected =
      std::make_shared<CameraIntrinsics>(Corrected(*given_, estimate_.correction));
  std::string error;
  if (!IsInvertible(corrected->distortion, corrected->camera, &error)) {
    estimate_ = applied_;
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
  CorrectionEstimate selected = Select(pairs_.Sum(readout_sigma), before);
  if (selected.is_corrected != before) {
    for (int i = 0; i < kIterations; ++i) linearize(pairs_.size());
    selected = Select(pairs_.Sum(readout_sigma), before);
  }
  estimate_ = selected;
  return estimate_.is_corrected != before;
}

bool CalibrationEstimator::IsReplacementDue() const {
  if (!estimate_.IsCorrected()) return false;
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

}  // namespace msc_vo
