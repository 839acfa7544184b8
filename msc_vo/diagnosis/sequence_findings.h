// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "msc_vo/diagnosis/finding.h"

namespace msc_vo {

class DepthCurveTest;
struct Calibration;
struct DepthUnits;
struct EdgeAlignment;
struct MotionCalibration;
struct MotionTrack;
struct SequenceIndex;
struct TimedPose;

/// Missing and unreadable files (names, sizes), and consecutive images whose files are equal byte
/// for byte: the frozen stream of a camera. Decodes equal images only: uniform ones do not count.
void AddFileFindings(const SequenceIndex& index, Findings* findings);

/// Rate, gaps and unit of the time stamps, and the delays between colour and depth that the stamps
/// give.
void AddStampFindings(const SequenceIndex& index, Findings* findings);

/// Whether the ground truth has poses at the times of the images.
void AddGroundTruthStampFindings(const SequenceIndex& index, Findings* findings);

/// Numbers of a calibration that are unusual for any camera; images are not needed. `format` is the
/// name of the sequence's layout.
void AddCameraFindings(const Calibration& calibration, const std::string& format,
                       Findings* findings);

/// Shift of the depth images against the colour images, and mirrored images, from the edges of
/// several images. `width` is that of the images, pixels.
void AddRegistrationFindings(const std::vector<EdgeAlignment>& images, int width,
                             Findings* findings);

/// Adds a warning in place of registration.shift if the depth images belong to colour images of
/// another time. `by_offset`: edges of depth against the colour images at the same offsets before
/// and after, in order of time; empty: not tested. `interval`: seconds between two images.
void AddDelayFindings(const std::vector<EdgeAlignment>& by_offset, double interval,
                      Findings* findings);

/// An error that names what the values are, if they are no depths; a warning, if an undescribed
/// lens can look like it.
void AddDepthCurveFindings(const DepthCurveTest& test, Findings* findings);

/// Whether the images can be tracked, and how far features move between them compared with the
/// image width, pixels.
void AddFrameMotionFindings(const MotionTrack& track, int width, Findings* findings);

/// Latency of the depth images: the shift between depth and colour edges grows in proportion to the
/// velocity of the image if depth is taken at another time than its stamp says. Not tested in
/// uniform motion, in which a constant shift explains the edges as well.
void AddLatencyFindings(const MotionTrack& track, Findings* findings);

/// Errors of depth relative to the sigmas of the features. At the largest factor that the odometry
/// uses, depth and images contradict each other; that is a warning unless `findings` already has
/// one, which names the cause.
void AddNoiseFindings(const MotionTrack& track, Findings* findings);

/// Compares the motion of the images with the ground truth: frame convention, time offset, scale
/// (that of depth in `units`) and hand-eye offset. Adds nothing if there is no ground truth. The
/// scale is not judged unless `is_calibrated`: another error of the calibration changes lengths,
/// too.
void AddGroundTruthMotionFindings(const MotionTrack& track, const std::vector<TimedPose>& truth,
                                  const DepthUnits& units, bool is_calibrated, Findings* findings);

/// Reports a warning for each part of the calibration that is wrong by the evidence of the images,
/// with its estimate. Values are those of the recorded images.
void AddCalibrationFindings(const Calibration& given, const MotionCalibration& calibration,
                            Findings* findings);

}  // namespace msc_vo
