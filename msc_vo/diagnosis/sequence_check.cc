// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/sequence_check.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "msc_vo/datasets/clipped_depth_search.h"
#include "msc_vo/diagnosis/depth_curve.h"
#include "msc_vo/diagnosis/depth_quality.h"
#include "msc_vo/diagnosis/edge_alignment.h"
#include "msc_vo/diagnosis/image_exposure.h"
#include "msc_vo/diagnosis/motion_calibration.h"
#include "msc_vo/diagnosis/motion_track.h"
#include "msc_vo/diagnosis/sequence_findings.h"
#include "msc_vo/diagnosis/texture.h"
#include "msc_vo/features/frame_builder.h"
#include "msc_vo/geometry/erase_if.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

constexpr int kMaxReports = 5;
constexpr int kQuickImages = 4;
// Images that decide what the depth values are, if the quick ones do not; they include those.
constexpr int kCurveImages = 13;
constexpr int kDeepImages = 240;
// Depth images that are compared with the colour images before and after, and how many of these.
constexpr int kDelayImages = 12;
constexpr int kDelayReach = 3;
constexpr char kCalibrationCheck[] = "calibration";
constexpr char kByteOrderCheck[] = "depth.byte_order";
constexpr char kScaleCheck[] = "depth.scale";

// What the images of a sample say.
struct SampleMeasurements {
  std::vector<ImageExposure> exposures;
  std::vector<DepthQuality> depths;
  DepthUnits units;
  ByteOrder byte_order;
  std::vector<EdgeAlignment> alignments;
  std::vector<ImageTexture> textures;
  std::vector<std::string> failures;
};

// Position of image k of `count` evenly spread ones.
int SampleIndex(int k, int count, int size) {
  if (count == 1) return 0;
  return static_cast<int>(static_cast<int64_t>(k) * (size - 1) / (count - 1));
}

// Whether a file of the entry cannot be read, which AddFileFindings() reports.
bool HasUnreadableFile(const SequenceIndex& index, int entry) {
  if (index.container) return false;
  const SequenceEntry& files = index.entries[entry];
  return !FileProblem(files.color_path, kMaxImageBytes).empty() ||
         !FileProblem(files.depth_path, kMaxImageBytes).empty();
}

// Features and the fine score of edges take longer than the rest: they are left out without
// `features`.
SampleMeasurements MeasureSample(const RgbdDecoder& decoder, int count,
                                 const std::optional<FrameBuilderOptions>& features,
                                 DepthCurveTest* curve) {
  SampleMeasurements sample;
  sample.units = FindDepthUnits(decoder);
  const Calibration& calibration = decoder.calibration();
  std::optional<FrameBuilder> builder;
  if (features) builder.emplace(*features, calibration.camera, calibration.distortion);
  for (int k = 0; k < count; ++k) {
    const int entry = SampleIndex(k, count, decoder.size());
    try {
      const RgbdImage image = decoder.Decode(entry);
      sample.exposures.push_back(MeasureExposure(image.gray));
      sample.depths.push_back(MeasureDepth(image.depth));
      sample.exposures.back().measured_depth = sample.depths.back().valid;
      sample.byte_order.Add(image.recorded_depth.empty() ? image.depth : image.recorded_depth,
                            calibration.depth_scale);
      curve->Add(image.depth);
      sample.alignments.push_back(AlignEdges(image.gray, image.depth, features.has_value()));
      sample.alignments.back().depth_delay = image.depth_delay;
      if (builder) sample.textures.push_back(MeasureTexture(builder->Build(image)));
    } catch (const std::exception& error) {
      if (HasUnreadableFile(decoder.index(), entry)) continue;
      sample.failures.emplace_back(error.what());
    }
  }
  return sample;
}

// Adds images between the quick ones until they decide.
void DecideCurve(const RgbdDecoder& decoder, DepthCurveTest* curve) {
  static_assert((kCurveImages - 1) % (kQuickImages - 1) == 0);
  constexpr int kKnown = (kCurveImages - 1) / (kQuickImages - 1);
  if (decoder.size() < kCurveImages) return;
  for (int k = 0; k < kCurveImages; ++k) {
    if (k % kKnown == 0) continue;
    if (curve->IsDecided()) return;
    try {
      curve->Add(decoder.Decode(SampleIndex(k, kCurveImages, decoder.size())).depth);
    } catch (const std::exception&) {
      continue;  // reported by the run
    }
  }
}

void AddDecodingFindings(const SampleMeasurements& sample, int count, Findings* findings) {
  const int failed = static_cast<int>(sample.failures.size());
  for (int i = 0; i < std::min(failed, kMaxReports); ++i) {
    findings->push_back(Error("images.decoding", sample.failures[i], ""));
  }
  if (failed == 0) {
    // Fewer than `count` if files are missing.
    findings->push_back(Good("images.decoding", std::to_string(sample.exposures.size()) +
                                                    " images decoded without errors"));
  } else if (failed > kMaxReports) {
    findings->push_back(
        Error("images.decoding", FormatText("%d of %d images cannot be used", failed, count),
              "see the messages above", Measurement{static_cast<double>(failed) / count, "ratio"}));
  }
}

double MedianInterval(const SequenceIndex& index) {
  std::vector<double> intervals;
  for (size_t i = 1; i < index.entries.size(); ++i) {
    intervals.push_back(index.entries[i].timestamp - index.entries[i - 1].timestamp);
  }
  return Median(std::move(intervals));
}

// Whether depth belongs to colour images of another time. Paired images that differ in time by
// their stamps are left out.
void AddDelay(const RgbdDecoder& decoder, int max_images, Findings* findings) {
  constexpr int kNumOffsets = 2 * kDelayReach + 1;
  const int num_centers = decoder.size() - 2 * kDelayReach;
  const int count = std::min(max_images, num_centers);
  const double interval = MedianInterval(decoder.index());
  std::vector<EdgeAlignment> by_offset(std::max(count, 0) > 0 ? kNumOffsets : 0);
  for (int k = 0; k < count; ++k) {
    const int first = SampleIndex(k, count, num_centers);
    try {
      const RgbdImage center = decoder.Decode(first + kDelayReach);
      if (2.0 * std::abs(center.depth_delay) > interval) continue;
      std::vector<EdgeAlignment> alignments;
      for (int i = 0; i < kNumOffsets; ++i) {
        const bool is_center = i == kDelayReach;
        const cv::Mat gray = is_center ? center.gray : decoder.Decode(first + i).gray;
        alignments.push_back(AlignEdges(gray, center.depth, false));
      }
      for (int i = 0; i < kNumOffsets; ++i) Add(alignments[i], &by_offset[i]);
    } catch (const std::exception&) {
      continue;  // reported by the check of decoded images
    }
  }
  AddDelayFindings(by_offset, interval, findings);
}

bool HasError(const Findings& findings, const std::string& check) {
  return std::any_of(findings.begin(), findings.end(), [&check](const Finding& finding) {
    return finding.severity == Severity::kError && finding.check == check;
  });
}

void AddSampleFindings(const SampleMeasurements& sample, const DepthCurveTest& curve,
                       const Calibration& calibration, Findings* findings) {
  AddExposureFindings(sample.exposures, calibration.camera.width, findings);
  Findings depths;
  AddDepthFindings(sample.depths, sample.byte_order, sample.units, &depths);
  // Swapped bytes leave no surfaces, and what is not depth has no scale.
  if (!HasError(depths, kByteOrderCheck)) AddDepthCurveFindings(curve, &depths);
  const bool is_depth = !HasError(depths, DepthCurveTest::kCheck);
  for (Finding& finding : depths) {
    if (is_depth || finding.check != kScaleCheck) findings->push_back(std::move(finding));
  }
}

void AddClippingFindings(const RgbdDecoder& decoder, Findings* findings) {
  for (const ClippingReport& report :
       DescribeClippedDepth(decoder.index().clipped_depth, decoder.calibration().depth_scale)) {
    findings->push_back(Warning("depth.clipped", report.text, "write 0 where nothing was measured",
                                Measurement{report.depth, "m"}));
  }
}

// Whether the images do not contradict the calibration, as far as it was tested.
bool IsCalibrated(const Findings& findings) {
  return std::none_of(findings.begin(), findings.end(), [](const Finding& finding) {
    const std::string topic = finding.check.substr(0, finding.check.find('.'));
    return finding.severity != Severity::kGood &&
           (topic == kCalibrationCheck || topic == "registration");
  });
}

void AddMotionFindings(const RgbdDecoder& decoder, const OdometryOptions& options,
                       const DepthUnits& units, Findings* findings) {
  const Calibration& calibration = decoder.calibration();
  const MotionTrack track = TrackMotion(decoder, options, kDeepImages);
  AddFrameMotionFindings(track, calibration.camera.width, findings);
  AddLatencyFindings(track, findings);
  const auto estimate = CalibrateFromMotion(decoder, track);
  if (estimate) {
    AddCalibrationFindings(calibration, *estimate, findings);
  } else {
    findings->push_back(
        Good(kCalibrationCheck, "calibration against motion: not tested, too few images match"));
  }
  AddGroundTruthMotionFindings(track, decoder.index().ground_truth, units, IsCalibrated(*findings),
                               findings);
  AddNoiseFindings(track, findings);
}

// Findings about poses that are no ground truth do not call them so.
void NameReference(const SequenceIndex& index, Findings* findings) {
  constexpr char kTruth[] = "ground truth";
  if (index.reference.empty()) return;
  for (Finding& finding : *findings) {
    for (std::string* text : {&finding.text, &finding.fix}) {
      for (size_t at = text->find(kTruth); at != std::string::npos; at = text->find(kTruth, at)) {
        if (finding.check == "sequence") break;  // which says that they are none
        text->replace(at, sizeof(kTruth) - 1, TruthName(index));
        at += TruthName(index).size();
      }
    }
  }
}

bool HoldsNoDepth(const Findings& findings) {
  return HasError(findings, kByteOrderCheck) || HasError(findings, DepthCurveTest::kCheck);
}

// Whether no run can succeed in spite of an error.
bool StopsRun(const Finding& finding) {
  return finding.severity == Severity::kError &&
         (finding.check == kScaleCheck || HoldsNoDepth({finding}));
}

}  // namespace

Findings CheckSequence(const RgbdDecoder& decoder, const SequenceCheckOptions& options) {
  std::string error;
  if (!options.odometry.IsValid(&error)) throw std::invalid_argument(error);
  const SequenceIndex& index = decoder.index();
  const Calibration& calibration = decoder.calibration();
  Findings findings;
  for (const std::string& warning : index.warnings) {
    findings.push_back(Warning("sequence", warning, ""));
  }
  AddFileFindings(index, &findings);
  if (!index.recorder.empty()) {
    findings.push_back(Good("sequence.recorder", "recorded with: " + index.recorder));
  }
  AddStampFindings(index, &findings);
  AddCameraFindings(calibration, index.format, &findings);
  const int count = std::min(std::max(options.max_images, 1), decoder.size());
  DepthCurveTest curve(calibration.camera, calibration.distortion, calibration.depth_scale);
  const SampleMeasurements sample =
      MeasureSample(decoder, count, options.odometry.features, &curve);
  AddDecodingFindings(sample, count, &findings);
  AddSampleFindings(sample, curve, calibration, &findings);
  AddClippingFindings(decoder, &findings);
  AddRegistrationFindings(sample.alignments, calibration.camera.width, &findings);
  if (!HasError(findings, "registration.mirrored")) AddDelay(decoder, kDelayImages, &findings);
  AddTextureFindings(sample.textures, &findings);
  AddGroundTruthStampFindings(index, &findings);
  if (HoldsNoDepth(findings)) {
    findings.push_back(
        Good(kCalibrationCheck, "calibration against motion: not tested, depth is not depth"));
  } else if (options.deep) {
    AddMotionFindings(decoder, options.odometry, sample.units, &findings);
  } else {
    findings.push_back(Good(kCalibrationCheck,
                            "calibration against motion: not tested; to test it, run msc_vo check "
                            "--deep"));
  }
  NameReference(index, &findings);
  return findings;
}

Findings CheckSequenceQuickly(const RgbdDecoder& decoder) {
  const SequenceIndex& index = decoder.index();
  const Calibration& calibration = decoder.calibration();
  Findings findings;
  AddStampFindings(index, &findings);
  AddCameraFindings(calibration, index.format, &findings);
  DepthCurveTest curve(calibration.camera, calibration.distortion, calibration.depth_scale);
  const SampleMeasurements sample =
      MeasureSample(decoder, std::min(kQuickImages, decoder.size()), std::nullopt, &curve);
  DecideCurve(decoder, &curve);
  AddSampleFindings(sample, curve, calibration, &findings);
  AddRegistrationFindings(sample.alignments, calibration.camera.width, &findings);
  if (!findings.empty() && findings.back().severity == Severity::kWarning &&
      findings.back().check == "registration.shift") {
    AddDelay(decoder, kQuickImages, &findings);
  }
  AddGroundTruthStampFindings(index, &findings);
  NameReference(index, &findings);
  EraseIf(&findings, [](const Finding& finding) { return finding.severity == Severity::kGood; });
  for (Finding& finding : findings) {
    if (!StopsRun(finding)) finding.severity = Severity::kWarning;
  }
  return findings;
}

bool HasRegisteredEdges(const RgbdDecoder& decoder) {
  const Calibration& calibration = decoder.calibration();
  DepthCurveTest curve(calibration.camera, calibration.distortion, calibration.depth_scale);
  const SampleMeasurements sample =
      MeasureSample(decoder, std::min(kQuickImages, decoder.size()), std::nullopt, &curve);
  Findings findings;
  AddRegistrationFindings(sample.alignments, calibration.camera.width, &findings);
  // Without a value, there are too few edges.
  return findings.front().severity == Severity::kGood && findings.front().value.has_value();
}

}  // namespace msc_vo
