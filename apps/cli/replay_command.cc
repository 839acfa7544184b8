// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <filesystem>
#include <functional>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/cli/checkpoints.h"
#include "apps/cli/command_log.h"
#include "apps/cli/commands.h"
#include "apps/cli/replay_arguments.h"
#include "apps/cli/replay_exports.h"
#include "apps/cli/run_files.h"
#include "apps/cli/run_identity.h"
#include "apps/cli/run_paths.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/sequence_run.h"
#include "msc_vo/checkpoint/checkpoint_file.h"
#include "msc_vo/config/options_file.h"
#include "msc_vo/diagnosis/sequence_check.h"
#include "msc_vo/logging/logger.h"
#include "msc_vo/recording/window_file.h"
#include "msc_vo/results/calibrated_value.h"
#include "msc_vo/results/result_files.h"
#include "msc_vo/results/run_report.h"
#include "msc_vo/results/sequence_identity.h"
#include "msc_vo/results/streamed_pose.h"
#include "msc_vo/results/summary_json.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/shell_word.h"

namespace msc_vo {

namespace {

// Writes every window of local bundle adjustment to `folder`, named by its keyframe. Stops at the
// first one that cannot be written, and writes the reason to `problem`.
WindowObserver WindowRecorder(const std::string& folder, const SequenceIndex& sequence,
                              std::string* problem) {
  if (folder.empty()) return {};
  RefuseToOverwrite(InputFolders(sequence), folder);
  RefuseSequenceFolder(folder);
  MakeFolder(folder);
  return [folder, problem](KeyframeId keyframe, const BundleAdjustmentOptions& options,
                           const WindowData& data) {
    if (!problem->empty()) return;
    const std::string name =
        FormatText("window_%06lld.txt", static_cast<long long>(keyframe));  // sorts by name
    const std::string path = (std::filesystem::path(folder) / name).string();
    try {
      WriteWindow(path, options, data);
      Log().debug("window written to {}", path);
    } catch (const std::exception& error) {
      *problem = error.what() + std::string("; neither this window nor later ones are written");
    }
  };
}

void PrintConfiguration(const ReplayArguments& arguments, const ConfigurationArguments& settings,
                        const Configuration& configuration) {
  const OptionSelection selection = arguments.all ? OptionSelection::kAll : OptionSelection::kBasic;
  if (!arguments.markdown) {
    std::cout << FormatConfiguration(configuration, selection);
    return;
  }
  if (!settings.IsEmpty()) {
    throw UsageError(
        "--markdown describes the defaults; leave out --config, --set and their short forms");
  }
  std::cout << FormatOptionsMarkdown(selection);
}

std::string OutputFolder(const ReplayArguments& arguments) {
  if (!arguments.output.empty()) return arguments.output;
  return (std::filesystem::path("out") / SequenceName(arguments.sequence.directory)).string();
}

// The checkpoint of a run that is resumed, and its identity.
struct Resumed {
  CheckpointFile file;
  RunIdentity identity;
};

// Throws std::runtime_error if the checkpoint is that of another run than `present`.
void RequireSameRun(const Resumed& resumed, const RunIdentity& present) {
  const std::string difference = DescribeDifference(resumed.identity, present);
  if (!difference.empty()) throw std::runtime_error(resumed.file.path() + ": " + difference);
}

// Begins to write checkpoints, or continues those of a run.
std::unique_ptr<Checkpoints> MakeCheckpoints(const RunIdentity& present, const std::string& output,
                                             double interval, Resumed* resumed,
                                             const CheckpointedParts& parts) {
  const std::string folder = CheckpointFolder(output);
  if (resumed != nullptr) {
    return std::make_unique<Checkpoints>(std::move(resumed->file), resumed->identity, interval,
                                         parts);
  }
  if (CheckpointFile::Exists(folder)) {
    PrintWarning(output + ": this run replaces an unfinished one, which --resume would continue");
  }
  return std::make_unique<Checkpoints>(CheckpointFile(folder), present, interval, parts);
}

// The identity of a run. One that is resumed must be the same, and remains the same session of its
// map.
RunIdentity Identify(const ReplayArguments& arguments, const Configuration& configuration,
                     const RgbdDecoder& decoder, const Resumed* resumed) {
  RunIdentity identity = IdentifyRun(decoder, configuration, arguments.gravity, arguments.map);
  identity.session = resumed != nullptr
                         ? resumed->identity.session
                         : NewSessionName(SequenceName(arguments.sequence.directory));
  if (resumed != nullptr) RequireSameRun(*resumed, identity);
  return identity;
}

// Writes and prints the results, and removes the checkpoint of a complete run. `problem`: why a
// file that was asked for could not be written; empty if there is none. Clears `exports` if the
// results that they are made of are not complete. Returns the exit code.
int WriteResults(const ReplayArguments& arguments, const std::string& output,
                 const SequenceRun& run, std::string problem, RunFiles* files, ReplayViews* views,
                 std::vector<RunExport>* exports) {
  const auto add_problem = [&problem](const std::string& another) {
    problem += (problem.empty() || another.empty() ? "" : "\n") + another;
  };
  bool is_complete = run.exit_code == kExitSuccess || run.exit_code == kExitTrackingFailed;
  try {
    add_problem(files->Finish(run.result, run.context));
  } catch (const std::exception& error) {
    is_complete = false;
    add_problem(error.what());
  }
  try {
    views->Complete((std::filesystem::path(output) / "report.html").string());
  } catch (const std::exception& error) {
    add_problem(error.what());
  }
  if (arguments.run.json) {
    std::cout << FormatSummaryJson(run.summary, run.context) << std::flush;
  } else if (!arguments.run.quiet && !arguments.StreamsPoses()) {
    std::cout << FormatRunTable(run.summary, run.context, output) << std::flush;
  }
  if (run.exit_code == kExitError) add_problem(run.context.outcome);
  if (is_complete) {
    RemoveCheckpoint(output);  // possibly of an earlier run
  } else {
    exports->clear();
  }
  const bool is_resumable = CheckpointFile::Exists(CheckpointFolder(output));
  const std::string resume = "msc_vo replay --resume " + ShellWord(output);
  if (!problem.empty()) {
    if (HasEntry((std::filesystem::path(output) / "trajectory.txt").string())) {
      problem += "\n(results so far are in " + output +
                 (is_resumable ? "; to continue: " + resume + ")" : ")");
    }
    PrintError(problem);
    return kExitError;
  }
  if (run.exit_code == kExitTrackingFailed) PrintError(run.context.outcome);
  if (run.exit_code == kExitInterrupted) {
    PrintWarning(is_resumable ? "interrupted; to continue: " + resume
                              : "interrupted; results so far are in " + output +
                                    "; the run cannot be resumed: it has no checkpoint" +
                                    (run.context.realtime ? ", as it was in real time" : ""));
  }
  return run.exit_code;
}

// The decoder, after the checks of the sequence. Adds their warnings to `warnings`.
RgbdDecoder OpenChecked(const ReplayArguments& arguments, const Configuration& configuration,
                        std::vector<std::string>* warnings) {
  RgbdDecoder decoder = OpenDecoder(arguments.sequence, configuration, LiveCameras::kAllowed);
  PrintWarnings(decoder.Warnings());
  if (!arguments.no_check && !decoder.index().camera) {
    *warnings = CheckInput(decoder, "; --no-check runs all the same");
  }
  PrintWarnings(*warnings);
  return decoder;
}

// Throws std::runtime_error if a run would write over its inputs, over a file that it writes
// itself, or over results of another sequence.
void CheckPaths(const ReplayArguments& arguments, const SequenceIndex& index,
                const SequenceIdentity& sequence, const std::string& output, bool is_resumed) {
  RefuseToOverwriteInputs(index, arguments.configuration.InputFiles(), output);
  RefuseSharedPaths(arguments, index, output);
  if (is_resumed) return;
  RefuseSequenceFolder(output);
  if (!arguments.overwrite) RefuseToOverwriteOthers(output, sequence, ResultFileNames());
}

// Adds the warnings of the checks of the sequence, and new ones if depth contradicts the images, or
// if --gravity had no effect.
void AddWarnings(const RgbdDecoder& decoder, const std::vector<std::string>& check_warnings,
                 const GravityFactors* gravity, SequenceRun* run) {
  std::vector<std::string> own;
  const std::string contradiction = DescribeDepthContradiction(run->summary);
  // Distortions of depth, or motion blur, can look like a wrong registration, but not to the edges.
  const auto is_registered = [&] { return !decoder.index().camera && HasRegisteredEdges(decoder); };
  if (!contradiction.empty() && !is_registered()) own.push_back(contradiction);
  const bool is_complete = run->exit_code == kExitSuccess || run->exit_code == kExitTrackingFailed;
  if (gravity != nullptr && !gravity->HasMeasured() && is_complete) {
    own.emplace_back(
        "accelerometer.txt: the vertical was never measured, so that --gravity had no effect: "
        "keyframes must span two seconds or more, and readings must cover 90 % of the time between "
        "them; are they on the clock of the images?");
  }
  PrintWarnings(own);
  std::vector<std::string>& warnings = run->context.sequence.warnings;
  warnings.insert(warnings.end(), check_warnings.begin(), check_warnings.end());
  warnings.insert(warnings.end(), own.begin(), own.end());
}

// Seconds between two saves of the map. In real time, images do not wait for the disk.
double MapInterval(const ReplayArguments& arguments, bool realtime) {
  return realtime ? std::numeric_limits<double>::infinity() : arguments.CheckpointInterval();
}

// Takes the frames that a resumed run had when it was interrupted.
void ContinueWith(std::vector<FrameResult> frames, const RunMap& map, RunFiles* files,
                  ReplayViews* views) {
  views->Continue(frames);
  if (map.place()) views->ShowPlace(*map.place());
  for (FrameResult& frame : frames) frame = map.Reported(frame);
  files->Continue(frames);
}

// Shows a frame before its result is written.
void ShowFrame(const TrackedImage& tracked, RunMap* map, ReplayViews* views) {
  const bool had_place = map->place().has_value();
  map->Add(tracked);
  if (map->place() && !had_place) views->ShowPlace(*map->place());
  views->Show(tracked);
}

// Writes a frame, and prints its pose if that was asked for.
void TakeFrame(const ReplayArguments& arguments, const FrameResult& frame, RunFiles* files) {
  files->Add(frame);
  if (!arguments.StreamsPoses()) return;
  std::cout << FormatStreamedPose(frame, arguments.stdout_poses_json ? StreamedPoseForm::kJson
                                                                     : StreamedPoseForm::kText)
            << std::flush;
}

// Runs the odometry. `resumed`: null for a new run. `exports`: to be written when the map is free.
int Run(const ReplayArguments& arguments, Configuration configuration, Resumed* resumed,
        std::vector<RunExport>* exports) {
  std::vector<std::string> check_warnings;
  const RgbdDecoder decoder = OpenChecked(arguments, configuration, &check_warnings);
  UseDepthSensorOf(decoder.index(), &configuration.odometry);
  const std::string output = OutputFolder(arguments);
  const SequenceIdentity sequence = IdentifySequence(decoder.index());
  CheckPaths(arguments, decoder.index(), sequence, output, resumed != nullptr);
  const RunIdentity identity = Identify(arguments, configuration, decoder, resumed);
  MakeFolder(output);
  CheckWritable((std::filesystem::path(output) / "trajectory.txt").string());
  *exports = PlanExports(arguments, decoder, output, identity.session);
  const std::unique_ptr<GravityFactors> gravity =
      MakeGravityFactors(arguments.gravity, decoder.index());
  const InterruptGuard interrupt;
  RunFiles files(output, sequence);
  ReplayViews views(arguments.view, decoder, configuration, arguments.run.max_frames);
  const bool realtime = configuration.odometry.snapshots.realtime;
  RunMap map(arguments.map, identity.session, MapInterval(arguments, realtime), resumed != nullptr);
  std::unique_ptr<Checkpoints> checkpoints;  // none in real time, which cannot be repeated
  if (!realtime) {
    checkpoints = MakeCheckpoints(identity, output, arguments.CheckpointInterval(), resumed,
                                  {&views, &map, gravity.get()});
  }
  files.AddExpendable(CheckpointFolder(output), [&] {
    checkpoints.reset();  // closes its files
    return RemoveCheckpoint(output);
  });
  files.AddExpendable(views.PartialVideo(), [&] { return views.RemoveVideo(); });
  std::string window_problem;
  RunCallbacks callbacks;
  callbacks.map = &map;
  callbacks.frame = [&](const FrameResult& frame) {
    TakeFrame(arguments, map.Reported(frame), &files);
    views.Add(frame, [&] { return interrupt.IsInterrupted(); });
  };
  callbacks.window = WindowRecorder(arguments.windows, decoder.index(), &window_problem);
  if (gravity) callbacks.window_factors = std::ref(*gravity);
  callbacks.tracking = [&](const TrackedImage& tracked) { ShowFrame(tracked, &map, &views); };
  callbacks.checkpoints = checkpoints.get();
  if (resumed != nullptr) {
    callbacks.resume = [&](const std::vector<FrameResult>& frames) {
      ContinueWith(frames, map, &files, &views);
    };
  }
  SequenceRun run = RunSequence(decoder, configuration, arguments.run, interrupt, callbacks);
  run.context.views = views.TakeViews();
  if (resumed != nullptr) run.context.command_line = resumed->identity.command_line;
  if (!run.HasImages()) {
    if (run.exit_code == kExitError) throw std::runtime_error(run.context.outcome);
    if (run.exit_code == kExitInterrupted) PrintWarning("interrupted before the first image");
    exports->clear();
    return run.exit_code;
  }
  AddWarnings(decoder, check_warnings, gravity.get(), &run);
  return WriteResults(arguments, output, run, window_problem, &files, &views, exports);
}

int Replay(const ReplayArguments& given) {
  ReplayArguments arguments = given;
  std::optional<Resumed> resumed;
  if (!given.resume.empty()) {
    const std::string output = std::filesystem::absolute(given.resume).string();
    resumed = {CheckpointFile::Open(CheckpointFolder(output)), {}};
    resumed->identity = ReadIdentity(&resumed->file);
    if (given.sequence.directory.empty())
      arguments = StoredArguments(resumed->identity.arguments, resumed->identity.folder, given);
    arguments.output = output;
  }
  const ConfigurationArguments settings = WithShortcuts(arguments);
  const Configuration configuration = MakeConfiguration(settings);
  PrintWarnings(DescribeIgnoredOptions(settings, configuration));
  if (arguments.print_config) {
    PrintConfiguration(arguments, settings, configuration);
    return kExitSuccess;
  }
  if (resumed && configuration.odometry.snapshots.realtime) {
    throw UsageError("--resume: a run in real time cannot be continued; start a new one");
  }
  std::vector<RunExport> exports;
  const int exit_code = Run(arguments, configuration, resumed ? &*resumed : nullptr, &exports);
  const bool are_exported = WriteExports(exports);
  return exit_code == kExitSuccess && !are_exported ? kExitError : exit_code;
}

}  // namespace

Command AddReplayCommand(CLI::App* app) {
  const auto arguments = std::make_shared<ReplayArguments>();
  CLI::App* command = AddReplayArguments(app, arguments.get());
  command->callback([arguments, command] { CheckReplayArguments(*command, *arguments); });
  return {command, [arguments] { return Replay(*arguments); }};
}

}  // namespace msc_vo
