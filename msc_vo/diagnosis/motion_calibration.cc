// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/motion_calibration.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "msc_vo/datasets/calibration_correction.h"
#include "msc_vo/diagnosis/registration_edges.h"
#include "msc_vo/frame/rolling_shutter.h"
#include "msc_vo/map/keyframe.h"
#include "msc_vo/self_calibration/readout_time_estimator.h"
#include "msc_vo/self_calibration/sensor_calibration.h"

namespace msc_vo {

namespace {

// Pairs of images, of all stretches of a track together: a bound of the computing time. As many of
// one recording take part in a SensorCalibration by default.
constexpr size_t kMaxPairs = 150;
// Candidates for a pair, since some match badly.
constexpr size_t kCandidatesPerPair = 2;
constexpr int kMinPairs = 10;
// Images before an image that its readout time is estimated with, as in a run.
constexpr size_t kPartners = 2;

constexpr auto kRegistration = static_cast<size_t>(CorrectionGroup::kDepthRegistration);

// Indices of the images whose depth is known.
std::vector<size_t> SelectImages(const MotionTrack& track) {
  std::vector<size_t> selected;
  for (size_t i = 0; i < track.images.size(); ++i) {
    if (track.images[i].depth) selected.push_back(i);
  }
  return selected;
}

// Seconds from the image before; none at the begin of a segment.
std::optional<double> IntervalBefore(const MotionTrack& track, size_t i) {
  if (!track.images[i].linked) return std::nullopt;
  return track.images[i].timestamp - track.images[i - 1].timestamp;
}

// Estimated as in a run, from each image and the ones before it, seconds. 0: global shutter.
double ReadoutTime(const std::optional<double>& known, const MotionTrack& track,
                   const std::vector<size_t>& selected) {
  ReadoutTimeEstimator estimator(known);
  std::vector<Keyframe> keyframes;
  for (const size_t i : selected) {
    const MotionImage& image = track.images[i];
    Keyframe keyframe;
    keyframe.frame =
        std::make_shared<Frame>(CompensateRollingShutter(*image.frame, image.camera_velocity, 0.0));
    keyframe.cam_from_world = image.cam_from_origin;
    keyframes.push_back(std::move(keyframe));
  }
  for (size_t i = 0; i < selected.size(); ++i) {
    std::vector<const Keyframe*> partners;
    for (size_t k = 1; k <= std::min(i, kPartners); ++k) {
      const bool is_partner =
          track.images[selected[i - k]].segment == track.images[selected[i]].segment;
      if (is_partner) partners.push_back(&keyframes[i - k]);
    }
    estimator.Update(keyframes[i], partners, IntervalBefore(track, selected[i]));
  }
  return estimator.readout_time();
}

// One sequence per segment, whose poses have a common origin; none for a single image.
std::vector<CalibrationSequence> MakeViews(const std::optional<double>& readout_time,
                                           const MotionTrack& track) {
  const std::vector<size_t> selected = SelectImages(track);
  const double seconds = ReadoutTime(readout_time, track, selected);
  std::vector<CalibrationSequence> sequences;
  int segment = -1;
  for (const size_t i : selected) {
    const MotionImage& image = track.images[i];
    if (image.segment != segment) sequences.emplace_back();
    segment = image.segment;
    sequences.back().push_back({std::make_shared<Frame>(CompensateRollingShutter(
                                    *image.frame, image.camera_velocity, seconds)),
                                *image.depth, image.cam_from_origin});
  }
  sequences.erase(std::remove_if(sequences.begin(), sequences.end(),
                                 [](const CalibrationSequence& s) { return s.size() < 2; }),
                  sequences.end());
  return sequences;
}

// The bounds of a sequence that together bound the time.
CalibrationEffort EffortFor(size_t num_sequences) {
  CalibrationEffort effort;
  effort.max_pairs = kMaxPairs / std::max<size_t>(1, num_sequences);
  effort.max_candidates = kCandidatesPerPair * effort.max_pairs;
  return effort;
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
  const std::vector<CalibrationSequence> sequences = MakeViews(given.readout_time, track);
  const SensorCalibration calibration(given.camera, given.distortion, sequences,
                                      EffortFor(sequences.size()));
  if (calibration.num_pairs() < kMinPairs) return std::nullopt;
  CorrectionGroups right = {};
  CorrectionEstimate estimate = calibration.MakeEstimate().selected;
  if (estimate.is_corrected[kRegistration] &&
      !EdgesAgree(decoder, Corrected(given, estimate.correction))) {
    right[kRegistration] = true;
    estimate = calibration.MakeEstimate({}, right).selected;
  }
  const CorrectionGroups wrong = LikelyWrong(estimate);
  if (wrong != estimate.is_corrected) estimate = calibration.MakeEstimate(wrong, right).selected;
  return MotionCalibration{estimate, right[kRegistration]};
}

}  // namespace msc_vo
