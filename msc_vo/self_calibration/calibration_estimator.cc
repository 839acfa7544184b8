// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/self_calibration/calibration_estimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/self_calibration/calibration_bounds.h"
#include "msc_vo/self_calibration/pair_view.h"
#include "msc_vo/self_calibration/self_calibrating_bundle_adjustment.h"
#include "msc_vo/sensor/depth_camera_correction.h"

namespace msc_vo {

namespace {

// Pairs that are linearised again after a keyframe: more where depth images may not be registered,
// whose large errors need several steps.
constexpr size_t kMaxRelinearized = 2;
constexpr size_t kMaxRelinearizedUnregistered = 4;
// Linearisations of all pairs before a correction is accepted.
constexpr int kLinearizations = 3;
// A correction in use is replaced when its standard deviation has shrunk to this ratio, and the
// estimate differs by more than this number of standard deviations.
constexpr double kSigmaRatio = 0.7;
constexpr double kMinChange = 1.0;

// Standard deviations up to which three of them are enough for a correction, a third of those of a
// wrong calibration: of the logarithm of the focal length, of the principal point (focal lengths),
// of k1, of the logarithm of the magnification of depth and of its roll. Chosen by measurement, see
// docs/lab/self_calibration.md.
constexpr double kMaxFocalLengthSigma = 0.01;
constexpr double kMaxCenterSigma = 0.0067;
constexpr double kMaxK1Sigma = 0.03;
constexpr double kMaxMagnificationSigma = 0.02;
constexpr double kMaxRollSigma = DegreesToRadians(0.33);
// Standard deviation of the logarithm of the focal length with which the images tell whether the
// given one is right.
constexpr double kKnownFocalLengthSigma = 0.015;

// Posterior odds above which a correction is accepted if the pairs alone hold the given value for
// more likely wrong than right. Chosen by measurement, see docs/lab/self_calibration.md.
constexpr double kAgreedOdds = 2.0;

// Keyframes in succession at which a group has to be a candidate. Chosen by measurement, see
// docs/lab/self_calibration.md.
constexpr int kMinCandidacy = 3;

// Pairs after which their estimation ends if the colour camera is certain and may be wrong; and if
// it is not certain: the pairs in memory have been replaced by then, so that further ones contain
// as much information as these.
constexpr size_t kSettledPairs = 150;
constexpr size_t kLastPair = 2 * kSettledPairs;

// Bundle adjustment is repeated when the map has grown by half, up to this size.
constexpr size_t kLastSize = 60;
// Its observations while nothing is corrected, a bound of the computing time, and afterwards.
// Chosen by measurement, see docs/lab/self_calibration.md.
constexpr size_t kNumCheckedObservations = 3000;
constexpr size_t kNumRefiningObservations = 6000;
// It replaces a correction that moves a pixel by more than this, radians: a tenth of the noise of a
// point.
constexpr double kMinShift = 2e-4;

constexpr CorrectionGroups kAll = {true, true, true, true};
constexpr auto kRegistration = static_cast<size_t>(CorrectionGroup::kDepthRegistration);

// Uncertainty of a group: its standard deviations in units of the largest ones with which it is
// certain enough.
double Uncertainty(CorrectionGroup group, const SensorCorrection::Vector& sigma) {
  using S = SensorCorrection;
  switch (group) {
    case CorrectionGroup::kFocalLength:
      return sigma(S::kFocalLength) / kMaxFocalLengthSigma;
    case CorrectionGroup::kPrincipalPoint:
      return std::max(sigma(S::kCenterX), sigma(S::kCenterY)) / kMaxCenterSigma;
    case CorrectionGroup::kLens:
      return sigma(S::kK1) / kMaxK1Sigma;
    case CorrectionGroup::kDepthRegistration:
      return std::max({sigma(S::kDepthFocalLength) / kMaxMagnificationSigma,
                       sigma(S::kDepthRoll) / kMaxRollSigma,
                       sigma(S::kFocalLength) / kKnownFocalLengthSigma});
  }
  return 0.0;
}

bool IsCertain(CorrectionGroup group, const SensorCorrection::Vector& sigma) {
  return Uncertainty(group, sigma) < 1.0;
}

// Whether a group is known well enough for its correction to be an improvement. What the model of
// the sensor leaves out looks like errors of parameters that are hardly observable. If the colour
// camera is not certain, its error has to exceed more than three standard deviations: as many times
// more as it is uncertain.
bool IsImprovement(CorrectionGroup group, CorrectionEstimate estimate) {
  const double uncertainty = Uncertainty(group, estimate.sigma);
  if (group == CorrectionGroup::kDepthRegistration && uncertainty >= 1.0) return false;
  estimate.sigma = std::max(1.0, uncertainty) * WithRegistrationErrors(estimate.sigma);
  return IsSignificant(group, estimate);
}

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

// Odds and standard deviations as if every group were wrong.
CorrectionEstimate Judge(const CalibrationInformation& information) {
  CorrectionEstimate estimate = EstimateCorrections(information, kAll);
  estimate.log_odds = GroupLogOdds(information);
  return estimate;
}

// A size that is larger by half.
size_t NextSize(size_t size) { return size + std::max<size_t>(1, size / 2); }

// The groups that may be wrong by the pairs alone. Half of the certainty of the colour camera is
// enough that a correction requires: the map adds to it.
CorrectionGroups CandidateGroups(const CorrectionEstimate& by_pairs) {
  CorrectionGroups candidates = {};
  for (const CorrectionGroup group : kColorGroups) {
    const auto g = static_cast<size_t>(group);
    candidates[g] =
        by_pairs.log_odds[g] > std::log(kCandidateOdds) && IsCertain(group, 0.5 * by_pairs.sigma);
  }
  candidates[kRegistration] = by_pairs.log_odds[kRegistration] > std::log(kAcceptedOdds);
  return candidates;
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

bool CalibrationEstimator::Update(const Map& map, KeyframeId newest,
                                  const std::shared_ptr<const RecordedImage>& recorded,
                                  const std::vector<CalibrationImage>& images,
                                  double readout_sigma) {
  if (!IsSettled()) {
    for (const CalibrationImage& image : images) pairs_.AddImage(map, image, at_);
    pairs_.AddKeyframe(map, newest, recorded, at_);
    images_.Add(newest, recorded);
    const bool is_registered = estimate_.log_odds[kRegistration] < 0.0;
    Linearize(readout_sigma, is_registered ? kMaxRelinearized : kMaxRelinearizedUnregistered);
    CountCandidacy(Judge(pairs_.Sum(readout_sigma)));
  }
  const bool is_adjusted = IsAdjustmentDue(map.keyframes().size()) && Adjust(map);
  estimate_ = Estimate(readout_sigma, estimate_.is_corrected);
  if (TakeBack(readout_sigma) || SelectGroups(readout_sigma) || IsReplacementDue(is_adjusted)) {
    return Apply();
  }
  if (!IsSettled() && IsEnough(readout_sigma)) {
    pairs_.Close(readout_sigma);
    images_.Clear();
  }
  return false;
}

bool CalibrationEstimator::IsDoubted() const {
  const auto is_doubted = [this](CorrectionGroup group, double odds) {
    const auto g = static_cast<size_t>(group);
    return !estimate_.is_corrected[g] && estimate_.log_odds[g] > std::log(odds);
  };
  // Registered depth has errors that the model leaves out, and their odds are large in recordings
  // of good cameras, too.
  return pairs_.num_added() > 0 && (is_doubted(CorrectionGroup::kFocalLength, kDoubtedOdds) ||
                                    is_doubted(CorrectionGroup::kLens, kDoubtedOdds) ||
                                    is_doubted(CorrectionGroup::kDepthRegistration, kAcceptedOdds));
}

CorrectionEstimate CalibrationEstimator::estimate() const {
  CorrectionEstimate estimate = estimate_;
  estimate.sigma = WithRegistrationErrors(estimate.sigma);
  return estimate;
}

bool CalibrationEstimator::IsEnough(double readout_sigma) const {
  if (pairs_.num_added() >= kLastPair) return true;
  const CorrectionEstimate by_pairs = Judge(pairs_.Sum(readout_sigma));
  const bool is_certain =
      std::all_of(kColorGroups.begin(), kColorGroups.end(),
                  [&](CorrectionGroup group) { return IsCertain(group, by_pairs.sigma); });
  if (!is_certain) return false;
  const bool is_right =
      std::all_of(by_pairs.log_odds.begin(), by_pairs.log_odds.end(),
                  [](double log_odds) { return log_odds < -std::log(kAcceptedOdds); });
  return is_right || pairs_.num_added() >= kSettledPairs;
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
    return false;
  }
  present_ = corrected;
  applied_ = estimate_;
  return true;
}

void CalibrationEstimator::Linearize(double readout_sigma, size_t max_pairs) {
  const CorrectionEstimate free = EstimateCorrections(pairs_.Sum(readout_sigma), kAll);
  at_ = free.correction;
  pairs_.Relinearize(at_, free.sigma, max_pairs);
}

void CalibrationEstimator::CountCandidacy(const CorrectionEstimate& by_pairs) {
  const CorrectionGroups candidates = CandidateGroups(by_pairs);
  for (size_t g = 0; g < candidates.size(); ++g) {
    candidacy_[g] = candidates[g] && !taken_back_[g] ? candidacy_[g] + 1 : 0;
  }
  is_suspected_ = {};
  for (size_t g = 0; g < candidates.size(); ++g) is_suspected_[g] = by_pairs.log_odds[g] > 0.0;
}

bool CalibrationEstimator::IsLastingCandidate(size_t group) const {
  return candidacy_[group] >= kMinCandidacy;
}

CalibrationInformation CalibrationEstimator::Information(double readout_sigma) const {
  CalibrationInformation sum = pairs_.Sum(readout_sigma);
  if (of_map_) {
    sum +=
        WithCommonError(*of_map_, MapCommonVariance(given_->distortion.Recorded(given_->camera)));
  }
  return sum;
}

CorrectionEstimate CalibrationEstimator::Estimate(double readout_sigma,
                                                  const CorrectionGroups& wrong) const {
  const CalibrationInformation information = Information(readout_sigma);
  CorrectionEstimate estimate = EstimateCorrections(information, wrong);
  estimate.log_odds = GroupLogOdds(information);
  if (of_map_ && is_map_corrected_) {
    CalibrationInformation independent = pairs_.Sum(readout_sigma);
    independent += *of_map_;
    estimate.correction = EstimateCorrections(independent, wrong).correction;
  }
  if (!IsSettled()) return estimate;
  // Without images, depths cannot be measured again: the registration in use remains.
  for (const int i : IndicesOf(CorrectionGroup::kDepthRegistration)) {
    estimate.correction(i) = applied_.correction(i);
  }
  return estimate;
}

// As long as the registration of depth may be wrong, nothing else is corrected: its error may look
// like one of the colour camera. It is corrected together with whatever else is more likely wrong
// than right, or not at all, because their errors may compensate each other; then the colour camera
// has to be certain.
CorrectionEstimate CalibrationEstimator::Select(double readout_sigma) const {
  const CorrectionGroups& before = estimate_.is_corrected;
  const CorrectionEstimate judged = Judge(Information(readout_sigma));
  CorrectionGroups wrong = before;
  for (size_t g = 0; g < wrong.size(); ++g) {
    const bool agrees = of_map_ && g != kRegistration && is_suspected_[g];
    const double required = std::log(agrees ? kAgreedOdds : kAcceptedOdds);
    wrong[g] = before[g] || (IsLastingCandidate(g) && judged.log_odds[g] > required);
  }
  if (pairs_.num_added() < next_registration_) wrong[kRegistration] = before[kRegistration];
  const CorrectionEstimate estimate = Estimate(readout_sigma, wrong);
  const bool may_mix = wrong[kRegistration] && !before[kRegistration];
  for (size_t g = 0; g < wrong.size(); ++g) {
    const auto group = static_cast<CorrectionGroup>(g);
    const bool is_clear = g == kRegistration || !may_mix || IsCertain(group, estimate.sigma);
    wrong[g] = before[g] || (wrong[g] && is_clear && IsImprovement(group, estimate));
  }
  const bool is_in_doubt = judged.log_odds[kRegistration] > 0.0 && !wrong[kRegistration];
  const bool is_new = wrong[kRegistration] && !before[kRegistration];
  const bool leaves_errors =
      AnyOfColor([&](size_t group) { return judged.log_odds[group] > 0.0 && !wrong[group]; });
  if (is_in_doubt || (is_new && leaves_errors)) wrong = before;
  return Estimate(readout_sigma, wrong);
}

bool CalibrationEstimator::SelectGroups(double readout_sigma) {
  const CorrectionGroups before = estimate_.is_corrected;
  bool has_candidate = false;
  for (size_t g = 0; g < before.size(); ++g) {
    has_candidate = has_candidate || (!before[g] && IsLastingCandidate(g));
  }
  if (!has_candidate) return false;
  CorrectionEstimate selected = Select(readout_sigma);
  if (selected.is_corrected == before) return false;
  if (!IsSettled()) {
    for (int i = 0; i < kLinearizations; ++i) Linearize(readout_sigma, pairs_.size());
    selected = Select(readout_sigma);
  }
  if (selected.is_corrected[kRegistration] && !before[kRegistration]) {
    const auto corrected = MakeCorrected(selected.correction);
    if (!corrected || !images_.EdgesAgree(*given_, *corrected)) {
      next_registration_ = NextSize(pairs_.num_added());
      selected = Select(readout_sigma);
    }
  }
  estimate_ = selected;
  next_size_ = 0;  // the map hides what contradicts the old calibration
  return estimate_.is_corrected != before;
}

bool CalibrationEstimator::TakeBack(double readout_sigma) {
  CorrectionGroups wrong = estimate_.is_corrected;
  for (size_t g = 0; g < wrong.size(); ++g) {
    if (!wrong[g] || estimate_.log_odds[g] > 0.0) continue;
    if (g == kRegistration && IsSettled()) continue;  // no image is left to measure depths in
    if (IsSignificant(static_cast<CorrectionGroup>(g), estimate_) &&
        estimate_.log_odds[g] > -std::log(kAcceptedOdds)) {
      continue;
    }
    wrong[g] = false;
    taken_back_[g] = true;
    candidacy_[g] = 0;
  }
  if (wrong == estimate_.is_corrected) return false;
  estimate_ = Estimate(readout_sigma, wrong);
  return true;
}

bool CalibrationEstimator::IsReplacementDue(bool is_adjusted) const {
  const SensorCorrection::Vector change = estimate_.correction - applied_.correction;
  for (size_t g = 0; g < estimate_.is_corrected.size(); ++g) {
    if (!estimate_.is_corrected[g] || (is_map_corrected_ && g != kRegistration)) continue;
    for (const int i : IndicesOf(static_cast<CorrectionGroup>(g))) {
      if (estimate_.sigma(i) < kSigmaRatio * applied_.sigma(i) &&
          std::abs(change(i)) > kMinChange * estimate_.sigma(i)) {
        return true;
      }
    }
  }
  if (!is_adjusted || !is_map_corrected_) return false;
  const auto corrected = MakeCorrected(estimate_.correction);
  return corrected != nullptr && LargestShift(*present_, *corrected) > kMinShift;
}

bool CalibrationEstimator::IsAdjustmentDue(size_t num_keyframes) const {
  const bool is_new_map = 2 * num_keyframes < adjusted_size_;
  return (num_keyframes >= next_size_ || is_new_map) && KnowsRegistration(estimate_) &&
         (CorrectsColor(estimate_) ||
          AnyOfColor([this](size_t group) { return IsLastingCandidate(group); }));
}

bool CalibrationEstimator::Adjust(const Map& map) {
  adjusted_size_ = map.keyframes().size();
  next_size_ =
      adjusted_size_ < kLastSize ? NextSize(adjusted_size_) : std::numeric_limits<size_t>::max();
  const size_t max_observations =
      CorrectsColor(applied_) ? kNumRefiningObservations : kNumCheckedObservations;
  const auto information =
      SelfCalibratingBundleAdjustment(*given_, map, estimate_.correction, max_observations);
  if (!information) return false;
  of_map_ = information;
  is_map_corrected_ = CorrectsColor(applied_);
  return true;
}

}  // namespace msc_vo
