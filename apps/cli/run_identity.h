// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <string>
#include <vector>

#include "apps/cli/gravity_arguments.h"
#include "apps/cli/run_map.h"
#include "msc_vo/config/option_list.h"
#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

/// What a run is, so that a checkpoint of another one is not continued by mistake.
struct RunIdentity {
  std::vector<std::string> arguments;  ///< of the command that began the run
  std::string command_line;            ///< the same as typed
  std::string folder;                  ///< in which it was typed
  std::string program;                 ///< version and checksum of the program
  std::string session;                 ///< name of the session in a map (NewSessionName())
  /// Everything else that determines the results, by name: options, camera, images.
  std::map<std::string, std::string> facts;
};

/// The identity of a run of this program. The number of threads is not part of it: it does not
/// affect the results.
RunIdentity IdentifyRun(const RgbdDecoder& decoder, const Configuration& configuration,
                        const GravityArguments& gravity, const MapArguments& map);

/// Describes what makes the run `present` another one than `saved`, and what to do about it; empty
/// if they are the same.
std::string DescribeDifference(const RunIdentity& saved, const RunIdentity& present);

}  // namespace msc_vo
