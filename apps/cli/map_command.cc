// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <cerrno>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/cli/commands.h"
#include "apps/cli/export_folder.h"
#include "apps/cli/interrupt_guard.h"
#include "apps/cli/run_map.h"
#include "apps/cli/sequence_arguments.h"
#include "apps/cli/unfinished_folder.h"
#include "msc_vo/exports/map_export.h"
#include "msc_vo/map_file/map_images.h"
#include "msc_vo/map_file/map_reader.h"
#include "msc_vo/map_file/map_writer.h"
#include "msc_vo/odometry/map_merge.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/write_error.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;

struct MapCommandArguments {
  std::string action;
  std::vector<std::string> files;
  std::string output;
};

void PrintInfo(const std::string& file) {
  const MapFileSummary summary = SummarizeMap(file);
  int64_t num_keyframes = 0;
  for (const MapFileSummary::SubMap& submap : summary.submaps) {
    num_keyframes += submap.num_keyframes;
  }
  std::cout << file << ": version " << summary.version << " of the format, written by "
            << summary.program << "\n"
            << FormatText("%.1f MB, %.1f KB per keyframe\n", 1e-6 * summary.num_bytes,
                          num_keyframes > 0 ? 1e-3 * summary.num_bytes / num_keyframes : 0.0);
  for (const MapFileSummary::Session& session : summary.sessions) {
    std::cout << "session '" << session.name << "': " << session.num_keyframes << " keyframes\n";
  }
  for (const MapFileSummary::SubMap& submap : summary.submaps) {
    std::cout << "submap " << submap.id << ": " << submap.num_keyframes << " keyframes, "
              << submap.num_points << " points, " << submap.num_lines << " lines"
              << (submap.num_planes > 0 ? ", " + std::to_string(submap.num_planes) + " planes" : "")
              << "\n";
  }
  std::cout << summary.num_loop_edges << " loop edges\n"
            << "images of " << summary.num_images << " of " << num_keyframes << " keyframes"
            << std::endl;
}

// Subfolder of an export for the images of keyframes. No dataset format uses this name.
constexpr const char* kImageFolder = "keyframe_images";

// Writes the images of the keyframes, named by their ids. Calls `check` before each of them.
void ExportImages(const std::string& file, const std::string& folder,
                  const std::function<void()>& check) {
  const fs::path path = fs::path(folder) / kImageFolder;
  const MapImages images(file);
  const std::vector<KeyframeId> keyframes = images.Keyframes();
  if (keyframes.empty()) return;
  MakeFolder(path.string());
  for (const KeyframeId id : keyframes) {
    check();
    const std::string name = FormatText("%06lld.jpg", static_cast<long long>(id));  // sorts by name
    WriteFile((path / name).string(), images.Read(id));
  }
}

// Returns a function that throws Interrupted after a signal.
std::function<void()> InterruptCheck(const InterruptGuard& guard, const std::string& output) {
  return [&guard, output] {
    if (guard.IsInterrupted()) throw Interrupted("interrupted; " + output + " is not written");
  };
}

void Export(const std::string& file, const std::string& folder) {
  const InterruptGuard guard;
  const std::function<void()> check = InterruptCheck(guard, folder);
  const MapContents contents = LoadKeyframes(file);
  RefuseToOverwrite({file}, folder);
  RefuseSequenceFolder(folder);
  ReplaceExport(folder, file, [&](const std::string& unfinished) {
    check();
    ExportMap(contents, unfinished);
    ExportImages(file, unfinished, check);
    check();
  });
}

void PrintMerge(const std::string& file, const MapMerge& merge) {
  for (const MapJoin& join : merge.joins) {
    std::cout << FormatText("%s: a submap is joined with submap %d, by %d keyframes\n",
                            file.c_str(), join.kept, join.num_keyframes);
  }
  if (merge.num_loops > 0) {
    std::cout << FormatText("%s: %d loops closed\n", file.c_str(), merge.num_loops);
  }
  if (merge.joins.empty()) {
    std::cout << file
              << ": no common place with the maps before it; its submaps keep their own worlds"
              << std::endl;
  }
}

// Writes a map beside its file and renames it when it is complete: a killed process leaves none.
void SaveCompleteMap(const std::string& file, MapContents contents,
                     const KeyframeImageSource& images, const std::function<void()>& check) {
  const UnfinishedFolder folder(file + ".unfinished");
  const std::string unfinished = folder.File("merged.map");
  try {
    SaveMap(unfinished, std::move(contents), images);
  } catch (const WriteError& error) {
    throw WriteError(file, error.LacksSpace() ? ENOSPC : 0);
  }
  check();
  fs::rename(unfinished, file);
}

void Merge(const std::vector<std::string>& files, const std::string& output) {
  const auto refuse_to_replace = [&output] {
    if (HasEntry(output)) {
      throw std::runtime_error(output + ": exists; give the merged map another name");
    }
    // SQLite would change the merged map by it.
    const std::string journal = output + "-journal";
    if (!HasEntry(journal)) return;
    throw std::runtime_error(journal +
                             ": is left from another map of this name; remove it, or give "
                             "the merged map another name");
  };
  refuse_to_replace();
  CheckWritable(output);
  const InterruptGuard guard;
  const std::function<void()> check = InterruptCheck(guard, output);
  MapContents contents = LoadKeyframes(files.front());
  std::map<KeyframeId, MapImages> images;  // of each file, by what is added to its ids
  images.emplace(0, MapImages(files.front()));
  for (size_t i = 1; i < files.size(); ++i) {
    check();
    MapMerge merge = MergeMaps({}, std::move(contents), LoadKeyframes(files[i]));
    PrintMerge(files[i], merge);
    contents = std::move(merge.contents);
    images.insert_or_assign(merge.keyframe_offset, MapImages(files[i]));
  }
  const auto image_of = [&](KeyframeId id) {
    check();
    const auto& [offset, of_file] = *std::prev(images.upper_bound(id));
    return of_file.Read(id - offset);
  };
  SaveCompleteMap(output, std::move(contents), image_of, [&] {
    check();
    refuse_to_replace();
  });
}

int Run(const MapCommandArguments& arguments) {
  const std::string& file = arguments.files.front();
  if (arguments.action == "info") {
    PrintInfo(file);
    return kExitSuccess;
  }
  if (arguments.action == "check") {
    CheckMap(file);
    std::cout << file << ": no damage" << std::endl;
    return kExitSuccess;
  }
  if (arguments.action == "merge") {
    Merge(arguments.files, arguments.output);
  } else {
    Export(file, arguments.output);
  }
  std::cout << "written to " << arguments.output << std::endl;
  return kExitSuccess;
}

void Check(const MapCommandArguments& arguments) {
  const bool merges = arguments.action == "merge";
  const bool writes = merges || arguments.action == "export";
  if (writes && arguments.output.empty()) throw CLI::RequiredError("--output");
  if (!writes && !arguments.output.empty()) {
    throw CLI::ValidationError("--output", "only map export and map merge write; leave it out");
  }
  if (merges && arguments.files.size() < 2) {
    throw CLI::ValidationError("files", "map merge needs two map files or more");
  }
  for (size_t i = 0; merges && i < arguments.files.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      std::error_code missing;
      if (!fs::equivalent(arguments.files[i], arguments.files[k], missing)) continue;
      throw CLI::ValidationError("files", arguments.files[i] + " is given twice");
    }
  }
  if (!merges && arguments.files.size() > 1) {
    throw CLI::ValidationError("files", "map " + arguments.action + " takes one map file");
  }
}

}  // namespace

Command AddMapCommand(CLI::App* app) {
  const auto arguments = std::make_shared<MapCommandArguments>();
  CLI::App* command =
      app->add_subcommand("map", "Describe, check, export or merge map files of replay --map");
  command
      ->add_option("action", arguments->action,
                   "info: what the file contains; check: read all of it; export: write points and "
                   "lines (PLY), keyframes (TUM), their images (JPEG) and the pose graph (g2o); "
                   "merge: join the maps of several files by the places that they share")
      ->required()
      ->check(CLI::IsMember({"info", "check", "export", "merge"}));
  command->add_option("files", arguments->files, "Map files (docs/map_file.md)")->required();
  command->add_option("--output", arguments->output, "Folder of export, new map file of merge")
      ->type_name("PATH");
  command->callback([arguments] { Check(*arguments); });
  command->footer(HelpFooter("msc_vo map export home.map --output out/home"));
  return {command, [arguments] { return Run(*arguments); }};
}

}  // namespace msc_vo
