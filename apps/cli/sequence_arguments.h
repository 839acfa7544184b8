// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "msc_vo/config/option_list.h"
#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

/// Arguments of all commands that read a sequence.
struct SequenceArguments {
  std::string directory;
  std::string format = "auto";
  std::string camera;  ///< preset; may be empty
};

/// Declares SEQUENCE, --format and --camera. SEQUENCE, which is returned, is optional unless the
/// caller requires it.
CLI::Option* AddSequenceArguments(CLI::App* command, SequenceArguments* arguments);

/// Declares --format and --camera only, for commands with several sequences.
void AddLayoutArguments(CLI::App* command, SequenceArguments* arguments);

/// Opens the sequence. Throws std::runtime_error naming file, line and fix.
RgbdDecoder OpenDecoder(const SequenceArguments& arguments, const Configuration& configuration);

/// Name of a sequence in the results: the last component of its path.
std::string SequenceName(const std::string& directory);

}  // namespace msc_vo
