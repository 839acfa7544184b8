// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/export_folder.h"

#include <filesystem>
#include <set>
#include <stdexcept>
#include <system_error>

#include <nlohmann/json.hpp>

#include "apps/cli/output_file.h"
#include "apps/cli/unfinished_folder.h"
#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

namespace fs = std::filesystem;
using FileNames = std::set<std::string>;  // "SUBFOLDER/FILE"

constexpr char kListName[] = "export.json";
constexpr char kListMark[] = "msc_vo map export";
constexpr char kUnfinishedName[] = "export.json.files";  // folder of the files that are written

// Whether a name is that of a file in a subfolder.
bool IsInSubfolder(const std::string& name) {
  const fs::path path(name);
  const fs::path subfolder = path.parent_path(), file = path.filename();
  return !subfolder.empty() && subfolder == subfolder.filename() && subfolder != "." &&
         subfolder != ".." && !file.empty() && file != "." && file != "..";
}

// The files that an earlier export has listed.
FileNames ReadList(const fs::path& folder) {
  const std::string path = (folder / kListName).string();
  if (!HasEntry(path)) return {};
  const nlohmann::json list = nlohmann::json::parse(ReadFile(path), nullptr, false);
  try {
    FileNames names = list.at("files").get<FileNames>();
    bool is_list = list.at("written_by") == kListMark;
    for (const std::string& name : names) is_list = is_list && IsInSubfolder(name);
    if (is_list) return names;
  } catch (const nlohmann::json::exception&) {
  }
  throw std::runtime_error(path + ": is no list of the files of an export; give another folder");
}

void WriteList(const fs::path& folder, const FileNames& names) {
  const nlohmann::ordered_json list = {{"written_by", kListMark}, {"files", names}};
  WriteFile((folder / kListName).string(), list.dump(2) + "\n");
}

FileNames FilesBelow(const fs::path& folder) {
  FileNames names;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (!entry.is_directory() && name != UnfinishedFolder::kMark) names.insert(name);
  }
  return names;
}

// Throws std::runtime_error if a file that is in no list, or the input, would be lost.
void RefuseToLose(const fs::path& folder, const FileNames& earlier, const FileNames& names,
                  const std::string& input) {
  for (const std::string& name : names) {
    const std::string path = (folder / name).string();
    if (!HasEntry(path) || earlier.count(name) > 0) continue;
    throw std::runtime_error(path + ": exists, and is not in the list of an earlier export, " +
                             kListName + "; remove it, or give another folder");
  }
  for (const std::string& name : earlier) {
    const std::string path = (folder / name).string();
    if (!AreSameFile(path, input)) continue;
    throw std::runtime_error(input + ": is in " + folder.string() +
                             ", where the export would replace it; give another folder");
  }
}

// Moves the files of an export to their places, and removes those of the earlier one. The list
// names all of them until that is done.
void MoveFiles(const fs::path& from, const fs::path& folder, const FileNames& earlier,
               const FileNames& names) {
  FileNames all = earlier;
  all.insert(names.begin(), names.end());
  WriteList(folder, all);
  for (const std::string& name : names) {
    MakeFolder((folder / name).parent_path().string());
    fs::rename(from / name, folder / name);
  }
  for (const std::string& name : earlier) {
    if (names.count(name) > 0) continue;
    std::error_code ignored;
    fs::remove(folder / name, ignored);
    fs::remove((folder / name).parent_path(), ignored);  // fails unless it is empty
  }
  WriteList(folder, names);
}

}  // namespace

void ReplaceExport(const std::string& folder, const std::string& input,
                   const std::function<void(const std::string&)>& write) {
  const FileNames earlier = ReadList(folder);
  const bool is_new = !HasEntry(folder);
  MakeFolder(folder);
  try {
    const UnfinishedFolder unfinished(PathIn(folder, kUnfinishedName));
    write(unfinished.path());
    const FileNames names = FilesBelow(unfinished.path());
    RefuseToLose(folder, earlier, names, input);
    MoveFiles(unfinished.path(), folder, earlier, names);
  } catch (...) {
    std::error_code ignored;
    if (is_new) fs::remove(folder, ignored);
    throw;
  }
}

}  // namespace msc_vo
