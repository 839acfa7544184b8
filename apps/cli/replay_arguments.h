// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/cli/configuration_arguments.h"
#include "apps/cli/gravity_arguments.h"
#include "apps/cli/replay_views.h"
#include "apps/cli/run_map.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"

namespace msc_vo {

/// Arguments of `msc_vo replay`.
struct ReplayArguments {
  SequenceArguments sequence;
  ConfigurationArguments configuration;
  RunArguments run;
  std::string output;
  bool overwrite = false;  ///< also results of another sequence
  std::string resume;      ///< folder of the results of a run to be continued; may be empty
  std::optional<double> checkpoint_interval;  ///< seconds
  std::vector<std::string> exports;           ///< FORMAT=PATH
  std::string windows;                        ///< folder; empty: windows are not recorded
  GravityArguments gravity;
  MapArguments map;
  ViewArguments view;
  std::string mode;
  std::string lines;
  bool no_points = false;
  bool no_planes = false;
  bool no_lines = false;
  bool no_parallel = false;
  bool no_perpendicular = false;
  bool no_manhattan = false;
  bool no_loops = false;
  bool realtime = false;
  bool no_check = false;
  bool stdout_poses = false;
  bool stdout_poses_json = false;
  bool print_config = false;
  bool all = false;       ///< of --print-config
  bool markdown = false;  ///< of --print-config

  double CheckpointInterval() const { return checkpoint_interval.value_or(5.0); }
  /// Whether poses are printed as they become known.
  bool StreamsPoses() const { return stdout_poses || stdout_poses_json; }
};

/// Declares the sub-command with its arguments.
CLI::App* AddReplayArguments(CLI::App* app, ReplayArguments* arguments);

/// Throws CLI::ParseError if the sequence is missing: it is needed except with --print-config and
/// --resume. With --resume alone, options that would make another run are refused.
void CheckReplayArguments(const CLI::App& command, const ReplayArguments& arguments);

/// Converts the short forms of frequent options to settings. --set takes precedence.
ConfigurationArguments WithShortcuts(const ReplayArguments& arguments);

/// The arguments of the command that began a run (`typed`), with those of `given` that do not
/// affect results. Changes to `folder`, in which that command was typed and to which its paths are
/// relative; throws std::runtime_error if that cannot be used.
ReplayArguments StoredArguments(const std::vector<std::string>& typed, const std::string& folder,
                                const ReplayArguments& given);

}  // namespace msc_vo
