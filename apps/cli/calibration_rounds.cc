// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/calibration_rounds.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "apps/cli/command_log.h"
#include "apps/cli/sequence_arguments.h"
#include "msc_vo/camera/lens_validity.h"
#include "msc_vo/datasets/calibration.h"
#include "msc_vo/diagnosis/calibration_views.h"
#include "msc_vo/diagnosis/registration_edges.h"
#include "msc_vo/self_calibration/calibration_bounds.h"
#include "msc_vo/self_calibration/self_calibrating_bundle_adjustment.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr int kMaxRounds = 3;
// A correction that is smaller, in standard deviations, needs no further round.
constexpr double kMinCorrection = 0.5;
// Images of all sequences in which depth edges are compared before and after a correction of the
// registration.
constexpr size_t kNumEdgeImages = 20;

constexpr auto kRegistration = static_cast<size_t>(CorrectionGroup::kDepthRegistration);

bool NeedsAnotherRound(const CorrectionEstimate& estimate) {
  return (estimate.correction.cwiseQuotient(estimate.sigma).array().abs() > kMinCorrection).any();
}

// The readout times that runs have found, weighted by their information.
class ReadoutMean {
 public:
  void Add(const OdometryResult& result) {
    if (result.readout_time == 0.0 || !(result.readout_time_sigma > 0.0)) return;
    const double information = 1.0 / (result.readout_time_sigma * result.readout_time_sigma);
    information_ += information;
    sum_ += information * result.readout_time;
  }
  std::optional<ReadoutEstimate> Result() const {
    if (information_ == 0.0) return std::nullopt;
    return ReadoutEstimate{sum_ / information_, 1.0 / std::sqrt(information_)};
  }

 private:
  double information_ = 0.0;  // 1/seconds^2
  double sum_ = 0.0;
};

// Why there can be no camera with the calibration, which is `given` with the corrections of all
// rounds, and what to do; empty if there can be one.
std::string DescribeProblem(const Calibration& given, const SensorCorrection::Vector& correction,
                            const Calibration& calibration) {
  std::string error;
  const LensDistortion& lens = calibration.distortion;
  std::string ignored;
  if (IsInvertible(lens, calibration.camera, &ignored)) {
    error = DescribeImplausible({given.camera, given.distortion}, correction);
    if (error.empty() && calibration.IsValid(&error)) return "";
    return "no camera fits the images: " + error +
           "; check that the depth images hold depth along the optical axis and belong to the "
           "colour images, and that the given focal length is that of this image size (msc_vo "
           "check "
           "--deep)";
  }
  const char* const advice =
      lens.model == LensModel::kFisheye
          ? "give the coefficients of the lens, or a smaller field_of_view"
          : "if it is a wide-angle lens, describe it as a fisheye (camera.lens: fisheye with k1, "
            "k2, k3 and k4, which may be 0; see Lenses in docs/cameras.md) and calibrate again";
  return FormatText(
      "no %s lens fits the images: the best one, k1 = %.4g and k2 = %.4g, folds over "
      "inside the image; %s",
      LensModelName(lens.model), lens.k[0], lens.k[1], advice);
}

}  // namespace

CalibrationRounds::CalibrationRounds(std::vector<RgbdDecoder> sequences,
                                     const Configuration& configuration, const RunArguments& run,
                                     const InterruptGuard& interrupt)
    : sequences_(std::move(sequences)),
      configuration_(configuration),
      run_(run),
      interrupt_(interrupt) {
  // The calibration is estimated from all images at once.
  configuration_.odometry.mapping.self_calibration = false;
  report_.given = report_.used = sequences_.front().calibration();
}

ExitCode CalibrationRounds::Run() {
  for (int round = 0; round < kMaxRounds; ++round) {
    const ExitCode exit_code = Track(round);
    if (exit_code != kExitSuccess) return exit_code;
    const bool is_last = !Estimate(round);
    if (interrupt_.IsInterrupted()) {
      PrintWarning("interrupted; nothing is written");
      return kExitInterrupted;
    }
    if (is_last) break;
  }
  if (report_.readout) report_.used.readout_time = report_.readout->seconds;
  return kExitSuccess;
}

ExitCode CalibrationRounds::Track(int round) {
  views_.clear();
  of_maps_ = {};
  ReadoutMean readout;
  for (const RgbdDecoder& sequence : sequences_) {
    const std::string& directory = sequence.index().directory;
    RunCallbacks callbacks;
    callbacks.frame = [](const FrameResult&) {};
    run_.label =
        FormatText("round %d of at most %d, ", round + 1, kMaxRounds) + SequenceName(directory);
    const SequenceRun run = RunSequence(sequence, configuration_, run_, interrupt_, callbacks);
    if (run.exit_code == kExitError) {
      throw std::runtime_error(directory + ": " + run.context.outcome);
    }
    if (run.exit_code == kExitTrackingFailed) {
      PrintError(directory + ": " + run.context.outcome + "; nothing is written");
    }
    if (run.exit_code == kExitInterrupted) PrintWarning("interrupted; nothing is written");
    if (run.exit_code != kExitSuccess) return run.exit_code;
    if (!report_.given.readout_time) readout.Add(run.result);
    views_.push_back(MakeCalibrationViews(sequence, configuration_.odometry.features, run.result));
    const Calibration& present = sequence.calibration();
    const auto of_map = SelfCalibratingBundleAdjustment(
        {present.camera, present.distortion}, run.map->map, SensorCorrection::Vector::Zero());
    if (of_map) of_maps_ += *of_map;
  }
  report_.readout = readout.Result();
  return kExitSuccess;
}

bool CalibrationRounds::Estimate(int round) {
  const Calibration present = report_.used;
  const SensorCorrection::Vector zero = SensorCorrection::Vector::Zero();
  const SensorCalibration calibration(present.camera, present.distortion, views_);
  if (round == 0) RequirePairs(calibration);
  const SensorCalibration::Estimate estimate = MakeEstimate(calibration);
  const CorrectionEstimate& selected = estimate.selected;
  if (round == 0) {
    report_.log_odds = selected.log_odds;
    report_.num_views = calibration.num_views();
    report_.num_pairs = calibration.num_pairs();
    report_.residuals.given = Residuals(calibration, zero);
  }
  report_.refinement = selected;
  report_.estimated = Corrected(present, selected.correction);
  report_.unrestricted = Corrected(present, estimate.unrestricted);
  SensorCorrection::Vector total = correction_ + selected.correction;
  total.segment<2>(SensorCorrection::kDepthOffset) = selected.depth_errors;
  report_.problem = DescribeProblem(report_.given, total, report_.estimated);
  if (!report_.problem.empty()) {
    if (round > 0) report_.residuals.estimated = Residuals(calibration, zero);
    return false;
  }
  if (!selected.IsCorrected()) return false;
  correction_ += selected.correction;
  wrong_ = report_.is_corrected = selected.is_corrected;
  report_.used = report_.estimated;
  if (round == kMaxRounds - 1 || (round > 0 && !NeedsAnotherRound(selected))) {
    report_.residuals.estimated = Residuals(calibration, selected.correction);
    return false;
  }
  for (RgbdDecoder& sequence : sequences_) sequence = {sequence.index(), report_.used};
  return true;
}

SensorCalibration::Estimate CalibrationRounds::MakeEstimate(const SensorCalibration& calibration) {
  const auto make = [&] { return calibration.MakeEstimate(wrong_, right_, of_maps_); };
  SensorCalibration::Estimate estimate = make();
  const CorrectionEstimate& selected = estimate.selected;
  if (selected.is_corrected[kRegistration] && !wrong_[kRegistration] &&
      !EdgesAgree(Corrected(report_.used, selected.correction))) {
    right_[kRegistration] = report_.edges_contradict = true;
    contradicted_ = estimate.unrestricted;
    estimate = make();
  }
  if (contradicted_) {
    for (const int i : IndicesOf(CorrectionGroup::kDepthRegistration)) {
      estimate.unrestricted(i) = (*contradicted_)(i);
    }
  }
  return estimate;
}

bool CalibrationRounds::EdgesAgree(const Calibration& corrected) const {
  std::string ignored;
  if (!corrected.IsValid(&ignored)) return true;  // not used anyway
  EdgeComparison comparison;
  for (size_t s = 0; s < sequences_.size(); ++s) {
    const size_t num_views = views_[s].size();
    const size_t share = std::max<size_t>(1, kNumEdgeImages / sequences_.size());
    const size_t count = std::min(share, num_views);
    std::vector<int> images;
    for (size_t i = 0; i < count; ++i) {
      images.push_back(static_cast<int>(views_[s][i * num_views / count].frame->id));
    }
    CompareEdges(sequences_[s], images, corrected, &comparison);
  }
  return comparison.Agrees();
}

void CalibrationRounds::RequirePairs(const SensorCalibration& calibration) const {
  for (size_t s = 0; s < sequences_.size(); ++s) {
    if (calibration.num_pairs(s) > 0) continue;
    const int size = sequences_[s].size();
    throw std::runtime_error(
        sequences_[s].index().directory +
        FormatText(": too little for a calibration: %d images, 0 pairs with enough points in "
                   "common; record 10 seconds of a textured place at 1 to 4 m, turn the camera by "
                   "30 degrees about all axes and move it by half a metre",
                   run_.max_frames > 0 ? std::min(size, run_.max_frames) : size));
  }
}

std::vector<CalibrationResidual> CalibrationRounds::Residuals(
    const SensorCalibration& calibration, const SensorCorrection::Vector& correction) const {
  const PinholeCamera& recorded = report_.given.Recorded();
  const Eigen::Vector2d center(0.5 * (recorded.width - 1), 0.5 * (recorded.height - 1));
  std::vector<CalibrationResidual> result;
  for (const PairResidual& residual : calibration.Residuals(correction)) {
    result.push_back({(residual.pixel - center).norm(), residual.reprojection.norm(),
                      1.0 / residual.inverse_depth,
                      std::abs(residual.inverse_depth_error) / residual.inverse_depth});
  }
  return result;
}

}  // namespace msc_vo
