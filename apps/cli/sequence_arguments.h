// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>

#include <CLI/CLI.hpp>

#include "msc_vo/config/option_list.h"
#include "msc_vo/datasets/rgbd_decoder.h"

namespace msc_vo {

// How the user says which sequence is meant: the arguments that every command on one shares.
struct SequenceArguments {
  std::string directory;
  std::string format = "auto";
  std::string camera;  // preset; may be empty
};

// Declares SEQUENCE, --format and --camera. The caller makes SEQUENCE required, if it is.
CLI::Option* AddSequenceArguments(CLI::App* command, SequenceArguments* arguments);

// The same without SEQUENCE, for a command that takes several.
void AddLayoutArguments(CLI::App* command, SequenceArguments* arguments);

// The sequence, ready to be decoded. Throws std::runtime_error naming file, line and fix.
RgbdDecoder OpenDecoder(const SequenceArguments& arguments, const Configuration& configuration);

// What the results of the sequence are called: the last part of its path.
std::string SequenceName(const std::string& directory);

}  // namespace msc_vo
