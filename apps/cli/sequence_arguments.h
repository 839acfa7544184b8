// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "msc_vo/config/option_list.h"
#include "msc_vo/datasets/rgbd_decoder.h"
#include "msc_vo/ros_bag/bag_sequence.h"

namespace msc_vo {

/// Arguments of all commands that read a sequence.
struct SequenceArguments {
  std::string directory;  ///< or a bag of ROS, a recording of OpenNI2, "openni2:" and a device
  std::string format = "auto";
  BagTopics topics;
  std::string camera;                     ///< preset; may be empty
  std::string min_confidence = "medium";  ///< of depths of telephones
  std::string mask;                       ///< file or folder; empty: none
  bool mask_zero = false;  ///< pixels that are zero are left out, instead of the others
};

/// Declares SEQUENCE and the arguments of AddLayoutArguments(). SEQUENCE, which is returned, is
/// optional unless the caller requires it.
CLI::Option* AddSequenceArguments(CLI::App* command, SequenceArguments* arguments);

/// Declares --format, --camera, --color-topic, --depth-topic, --min-confidence, --mask and
/// --mask-zero only, for commands with several sequences.
void AddLayoutArguments(CLI::App* command, SequenceArguments* arguments);

enum class LiveCameras { kAllowed, kRefused };

/// Opens the sequence. Throws std::runtime_error naming file, line and fix, also if it is a live
/// camera and these are refused.
RgbdDecoder OpenDecoder(const SequenceArguments& arguments, const Configuration& configuration,
                        LiveCameras live_cameras = LiveCameras::kRefused);

/// Throws std::runtime_error if a folder is that of a sequence which can be read, or one in it with
/// its images.
void RefuseSequenceFolder(const std::string& folder);
/// The same for a file that is a part of a sequence, see RefuseToOverwriteSequence().
void RefuseSequenceFile(const std::string& file);

/// Checks a sequence before its images are used, see CheckSequenceQuickly(). Returns the warnings.
/// Throws std::runtime_error with the first error, with which no result is right; `advice` is added
/// to its message.
std::vector<std::string> CheckInput(const RgbdDecoder& decoder, const std::string& advice = "");

/// Takes the depth sensor that the sequence names, unless the options give one.
void UseDepthSensorOf(const SequenceIndex& index, OdometryOptions* options);

/// Whether the sequence is a live camera.
bool IsLiveCamera(const std::string& directory);

/// Name of a sequence in the results: the last component of its path, without the ending of a
/// recording.
std::string SequenceName(const std::string& directory);

}  // namespace msc_vo
