// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/run_paths.h"

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "apps/cli/checkpoints.h"
#include "apps/cli/command_log.h"
#include "apps/cli/output_file.h"
#include "msc_vo/results/result_files.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

// A file that an option names.
struct NamedFile {
  std::string option;  // as typed
  std::string path;
};

std::vector<NamedFile> FilesOf(const ReplayArguments& arguments) {
  std::vector<NamedFile> files;
  const auto add = [&files](const std::string& option, const std::string& path) {
    if (!path.empty()) files.push_back({option + " " + path, path});
  };
  add("--map", arguments.map.map);
  add("--localize", arguments.map.localize);
  add("--overlay", arguments.view.overlay);
  add("--log-file", LogFile());
  for (const std::string& text : arguments.exports) {
    files.push_back({"--export " + text, text.substr(text.find('=') + 1)});
  }
  return files;
}

// Whether a file and the temporary files beside it are apart from another one and those beside it.
bool AreApart(const std::string& a, const std::string& b) {
  for (const char* ending : {"", ".partial", ".partial.mp4", "-journal"}) {
    if (AreSameFile(a + ending, b) || AreSameFile(a, b + ending)) return false;
  }
  return true;
}

// Whether a path is that of a folder, or lies in it.
bool IsInFolder(const std::string& path, const std::string& folder) {
  for (std::filesystem::path parent = std::filesystem::absolute(path); parent != parent.root_path();
       parent = parent.parent_path()) {
    if (AreSameFile(parent.string(), folder)) return true;
  }
  return false;
}

}  // namespace

void RefuseSharedPaths(const ReplayArguments& arguments, const SequenceIndex& sequence,
                       const std::string& output) {
  const std::vector<NamedFile> files = FilesOf(arguments);
  for (size_t i = 0; i < files.size(); ++i) {
    const auto fail = [&](const std::string& other) {
      throw std::runtime_error(files[i].option + ": is also the path of " + other +
                               "; give another one");
    };
    for (size_t k = 0; k < i; ++k) {
      if (!AreApart(files[i].path, files[k].path)) fail(files[k].option);
    }
    for (const std::string& name : ResultFileNames()) {
      const std::string result = (std::filesystem::path(output) / name).string();
      if (!AreApart(files[i].path, result)) fail(result + ", a result of the run");
    }
    const std::string checkpoint = CheckpointFolder(output);
    if (IsInFolder(files[i].path, checkpoint)) {
      throw std::runtime_error(files[i].option + ": is or lies in " + checkpoint +
                               ", the folder of the checkpoints; give another path");
    }
  }
  if (arguments.view.overlay.empty()) return;
  RefuseToOverwrite(arguments.configuration.InputFiles(), arguments.view.overlay);
  constexpr char kMp4Beginning[] = R"([\s\S]{4}ftyp)";
  RefuseToReplaceInSequence(sequence, arguments.view.overlay, {"", kMp4Beginning},
                            arguments.overwrite);
}

}  // namespace msc_vo
