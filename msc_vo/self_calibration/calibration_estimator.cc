// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/self_calibration/calibration_bounds.h"
#include "msc_vo/self_calibration/self_calibrating_bundle_adjustment.h"
#include "msc_vo/sensor/depth_camera_correction.h"

namespace msc_vo {

namespace {

// Pairs that are linearised again after a keyframe: more where depth images may not be registered,
// whose large errors need several steps.
constexpr size_t kMaxRelinearized = 2;
constexpr size_t kMaxRelinearizedUnregistered = 12;
// Iterations over all pairs before a correction is accepted.
constexpr int kIterations = 3;
// A correction in use is replaced when its standard deviation has shrunk to this ratio, and the
// estimate differs by more than this number of standard deviations.
constexpr double kSigmaRatio = 0.7;
constexpr double kMinChange = 1.0;

// Largest standard deviations with which a correction is accepted, a third of those of a wrong
// calibration: of the logarithm of the focal length, of the principal point (focal lengths), of k1,
// of the logarithm of the magnification of depth and of its roll. Chosen by measurement, see
// docs/lab/self_calibration.md.
constexpr double kMaxFocalLengthSigma = 0.01;
constexpr double kMaxCenterSigma = 0.0067;
constexpr double kMaxK1Sigma = 0.03;
constexpr double kMaxMagnificationSigma = 0.02;
constexpr double kMaxRollSigma = DegreesToRadians(0.33);
// Standard deviation of the logarithm of the focal length with which the images tell whether the
// given one is right.
constexpr double kKnownFocalLengthSigma = 0.015;

// Pairs after which their estimation ends if the colour camera is certain.
constexpr size_t kSettledPairs = 150;

// Bundle adjustment is repeated when the map has grown by a quarter, up to this size.
constexpr size_t kLastSize = 60;
// It replaces a correction that moves a pixel by more than this, radians: a tenth of the noise of a
// point.
constexpr double kMinShift = 2e-4;

constexpr CorrectionGroups kAll = {true, true, true, true};
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
      return sigma(S::kDepthFocalLength) < kMaxMagnificationSigma &&
             sigma(S::kDepthRoll) < kMaxRollSigma &&
             sigma(S::kFocalLength) < kKnownFocalLengthSigma;
  }
  return false;
}

// Logarithms of the odds above which groups are accepted.
using LogOdds = std::array<double, kNumCorrectionGroups>;

// Whether the registration of depth is as given or corrected, so that its error cannot look like
// one of the colour camera.
bool KnowsRegistration(const CorrectionEstimate& estimate) {
  return estimate.log_odds[kRegistration] < 0.0 || estimate.is_corrected[kRegistration];
}

template <typename Predicate>
bool AnyOfColor(const Predicate& predicate) {
  return std::any_of(kColorGroups.begin(), kColorGroups.end(),
                     [&](CorrectionGroup group) { return predicate(static_cast<size_t>(group)); });
}

bool CorrectsColor(const CorrectionEstimate& estimate) {
  return AnyOfColor([&](size_t group) { return estimate.is_corrected[group]; });
}

// The groups `before`, and those whose correction is accepted. As long as the registration of depth
// may be wrong, nothing else is: its error may look like one of the colour camera. It is corrected
// together with whatever else is more likely wrong than right, or not at all, because their errors
// may compensate each other.
CorrectionEstimate Select(const CalibrationInformation& information, const CorrectionGroups& before,
                          const LogOdds& required) {
  const LogOdds log_odds = SelectCorrections(information, before).log_odds;
  const SensorCorrection::Vector sigma = EstimateCorrections(information, kAll).sigma;
  CorrectionGroups wrong = before;
  for (size_t g = 0; g < wrong.size(); ++g) {
    if (log_odds[g] > required[g] && IsCertain(static_cast<CorrectionGroup>(g), sigma)) {
      wrong[g] = true;
    }
  }
  const bool is_in_doubt = log_odds[kRegistration] > 0.0 && !wrong[kRegistration];
  const bool is_new = wrong[kRegistration] && !before[kRegistration];
  const bool leaves_errors =
      AnyOfColor([&](size_t group) { return log_odds[group] > 0.0 && !wrong[group]; });
  if (is_in_doubt || (is_new && leaves_errors)) wrong = before;
  CorrectionEstimate estimate = EstimateCorrections(information, wrong);
  estimate.log_odds = log_odds;
  return estimate;
}

// A size that is larger by a quarter.
size_t NextSize(size_t size) { return size + std::max<size_t>(1, size / 4); }

// The groups of the colour camera that may be wrong by the pairs alone. Half of the certainty is
// enough that a correction requires.
CorrectionGroups CandidateGroups(const CorrectionEstimate& pairs) {
  CorrectionGroups candidates = {};
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
  const CorrectionGroups candidates = CandidateGroups(pairs);
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

// Largest displacement (radians) of an undistorted point when the calibration changes, at nine
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
  return shift / to.camera.FocalLength();
}

}  // namespace

CalibrationEstimator::CalibrationEstimator(const std::shared_ptr<const CameraIntrinsics>& given)
    : given_(given), present_(given), pairs_(*given) {}

bool CalibrationEstimator::IsSettled() const {
  return pairs_.size() >= kSettledPairs &&
         std::all_of(kColorGroups.begin(), kColorGroups.end(),
                     [this](CorrectionGroup group) { return IsCertain(group, estimate_.sigma); });
}

bool CalibrationEstimator::Update(const Map& map, KeyframeId newest,
                                  const std::shared_ptr<const RecordedImage>& recorded,
                                  const std::vector<CalibrationImage>& images,
                                  double readout_sigma) {
  if (!IsSettled()) {
    for (const CalibrationImage& image : images) {
      pairs_.AddImage(map, image, at_);
    }
    pairs_.AddKeyframe(map, newest, recorded, at_);
    images_.Add(newest, recorded);
    if (SelectGroups(readout_sigma) || IsReplacementDue()) return Apply();
  } else {
    // Without images, depths cannot be measured again: the registration in use remains.
    images_.Clear();
    for (const int i : IndicesOf(CorrectionGroup::kDepthRegistration)) {
      estimate_.correction(i) = applied_.correction(i);
    }
  }
  if (!IsAdjustmentDue(map.keyframes().size())) return false;
  return Adjust(map, readout_sigma) && Apply();
}

std::shared_ptr<const CameraIntrinsics> CalibrationEstimator::MakeCorrected(
    const SensorCorrection::Vector& correction) const {
  if (!DescribeImplausible(*given_, correction).empty()) return nullptr;
  const auto corrected = std::make_shared<CameraIntrinsics>(Corrected(*given_, correction));
  std::string error;
  if (corrected->registration && !DepthCameraOf(*given_, *corrected).IsValid(&error)) {
    return nullptr;
  }
  return corrected;
}

bool CalibrationEstimator::Apply() {
  const auto corrected = MakeCorrected(estimate_.correction);
  if (!corrected) {
    estimate_.correction = applied_.correction;
    estimate_.is_corrected = applied_.is_corrected;
    adjusted_.reset();
    return false;
  }
  present_ = corrected;
  applied_ = estimate_;
  return true;
}

CorrectionEstimate CalibrationEstimator::SelectByPairs(double readout_sigma,
                                                       const CorrectionGroups& before) const {
  LogOdds required;
  required.fill(std::log(kAcceptedOdds));
  if (pairs_.num_added() < next_registration_) {
    required[kRegistration] = std::numeric_limits<double>::infinity();
  }
  return Select(pairs_.Sum(readout_sigma), before, required);
}

bool CalibrationEstimator::SelectGroups(double readout_sigma) {
  const CorrectionGroups before = estimate_.is_corrected;
  // Linearises at the present optimum of all parameters.
  const auto linearize = [this, readout_sigma](size_t max_pairs) {
    const CorrectionEstimate free = EstimateCorrections(pairs_.Sum(readout_sigma), kAll);
    at_ = free.correction;
    pairs_.Relinearize(at_, free.sigma, max_pairs);
  };
  const bool is_registered = estimate_.log_odds[kRegistration] < 0.0;
  linearize(is_registered ? kMaxRelinearized : kMaxRelinearizedUnregistered);
  CorrectionEstimate selected = SelectByPairs(readout_sigma, before);
  if (selected.is_corrected != before) {
    for (int i = 0; i < kIterations; ++i) linearize(pairs_.size());
    selected = SelectByPairs(readout_sigma, before);
  }
  if (selected.is_corrected[kRegistration] && !before[kRegistration]) {
    const auto corrected = MakeCorrected(selected.correction);
    if (!corrected || !images_.EdgesAgree(*given_, *corrected)) {
      next_registration_ = NextSize(pairs_.num_added());
      selected = SelectByPairs(readout_sigma, before);
    }
  }
  estimate_ = adjusted_ ? WithAdjusted(*adjusted_, selected) : selected;
  if (selected.is_corrected == before) return false;
  next_size_ = 0;
  return true;
}

bool CalibrationEstimator::IsReplacementDue() const {
  const SensorCorrection::Vector change = estimate_.correction - applied_.correction;
  for (size_t g = 0; g < estimate_.is_corrected.size(); ++g) {
    if (!estimate_.is_corrected[g] || (adjusted_ && g != kRegistration)) continue;
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
  return (num_keyframes >= next_size_ || is_new_map) && KnowsRegistration(estimate_) &&
         (CorrectsColor(estimate_) || CandidateGroups(estimate_) != CorrectionGroups());
}

bool CalibrationEstimator::Adjust(const Map& map, double readout_sigma) {
  adjusted_size_ = map.keyframes().size();
  next_size_ =
      adjusted_size_ < kLastSize ? NextSize(adjusted_size_) : std::numeric_limits<size_t>::max();
  auto information = SelfCalibratingBundleAdjustment(*given_, map, estimate_.correction);
  if (!information) return false;
  *information += pairs_.Sum(readout_sigma);
  const CorrectionEstimate adjusted =
      Select(*information, estimate_.is_corrected, RequiredOfMap(estimate_));
  const auto corrected = MakeCorrected(adjusted.correction);
  if (!CorrectsColor(adjusted) || !corrected) return false;
  const bool is_new = adjusted.is_corrected != estimate_.is_corrected;
  adjusted_ = adjusted;
  estimate_.is_corrected = adjusted.is_corrected;
  estimate_ = WithAdjusted(adjusted, estimate_);
  if (!is_new && LargestShift(*present_, *corrected) <= kMinShift) return false;
  // Landmarks and outliers were selected with the calibration of the start.
  next_size_ = adjusted_size_ + 1;
  return true;
}

}  // namespace msc_vo
