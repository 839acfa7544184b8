// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/motion_calibration.h"

#include "msc_vo/datasets/calibration.h"
#include "msc_vo/diagnosis/registration_edges.h"
#include "msc_vo/self_calibration/sensor_calibration.h"

namespace msc_vo {

namespace {

// Pairs of images, of all stretches of a track together: a bound of the computing time. As many of
// one recording take part in a SensorCalibration by default.
constexpr size_t kMaxCalibrationPairs = 150;
// Candidates for a pair, since some match badly.
constexpr size_t kCandidatesPerPair = 2;
constexpr int kMinCalibrationPairs = 10;

constexpr auto kRegistration = static_cast<size_t>(CorrectionGroup::kDepthRegistration);

// The bounds of a sequence that together bound the time.
CalibrationEffort EffortFor(size_t num_sequences) {
  CalibrationEffort effort;
  effort.max_pairs = kMaxCalibrationPairs / num_sequences;
  effort.max_candidates = kCandidatesPerPair * effort.max_pairs;
  return effort;
}

// Whether every correction of `to` that `from` lacks exceeds three of its standard deviations.
bool AreNewOnesSignificant(const CorrectionEstimate& from, const CorrectionEstimate& to) {
  for (size_t g = 0; g < to.is_corrected.size(); ++g) {
    if (!to.is_corrected[g] || from.is_corrected[g]) continue;
    if (!IsSignificant(static_cast<CorrectionGroup>(g), to)) return false;
  }
  return true;
}

// The groups that are corrected, and those of the colour camera that are more likely wrong than
// right.
CorrectionGroups LikelyWrong(const CorrectionEstimate& estimate) {
  CorrectionGroups wrong = estimate.is_corrected;
  for (const CorrectionGroup group : kColorGroups) {
    const auto g = static_cast<size_t>(group);
    wrong[g] = wrong[g] || estimate.log_odds[g] > 0.0;
  }
  return wrong;
}

}  // namespace

std::optional<MotionCalibration> CalibrateFromMotion(const RgbdDecoder& decoder,
                                                     const MotionTrack& track) {
  const Calibration& given = decoder.calibration();
  const SensorCalibration calibration(given.camera, given.distortion, track.views,
                                      EffortFor(track.views.size()));
  if (calibration.num_pairs() < kMinCalibrationPairs) return std::nullopt;
  CorrectionGroups right = {};
  const auto estimate_with = [&](const CorrectionGroups& wrong) {
    return calibration.MakeEstimate(wrong, right, track.of_maps).selected;
  };
  CorrectionEstimate estimate = estimate_with({});
  if (estimate.is_corrected[kRegistration] &&
      !EdgesAgree(decoder, Corrected(given, estimate.correction))) {
    right[kRegistration] = true;
    estimate = estimate_with({});
  }
  const CorrectionGroups wrong = LikelyWrong(estimate);
  if (wrong != estimate.is_corrected) {
    const CorrectionEstimate likely = estimate_with(wrong);
    if (AreNewOnesSignificant(estimate, likely)) estimate = likely;
  }
  return MotionCalibration{estimate, right[kRegistration]};
}

}  // namespace msc_vo
