// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/text/files.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "msc_vo/text/classic_locale.h"
#include "msc_vo/text/text_file.h"
#include "msc_vo/text/write_error.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// Describes why `path` cannot be resolved; empty if it can. Writes its type to `type`.
std::string ResolveType(const std::string& path, fs::file_type* type) {
  std::error_code error;
  *type = fs::status(path, error).type();
  if (*type == fs::file_type::not_found) {
    const bool is_link = fs::is_symlink(fs::symlink_status(path, error));
    return is_link ? "is a symbolic link to a file that does not exist" : "does not exist";
  }
  if (error == std::errc::too_many_symbolic_link_levels) {
    return "is a symbolic link that leads back to itself";
  }
  if (error) return "cannot be read: " + ErrorText(error) + " (check the permissions)";
  return "";
}

// Names the type of an entry that is neither a regular file nor a folder.
std::string SpecialTypeName(fs::file_type type) {
  switch (type) {
    case fs::file_type::fifo:
      return "pipe";
    case fs::file_type::character:
    case fs::file_type::block:
      return "device";
    case fs::file_type::socket:
      return "socket";
    default:
      return "special file";
  }
}

std::string Megabytes(std::uintmax_t bytes) { return std::to_string(bytes >> 20) + " MiB"; }

// Throws std::runtime_error unless `path` can become a regular file or replace one.
void CheckReplaceable(const std::string& path) {
  fs::file_type type;
  const std::string problem = ResolveType(path, &type);
  if (type == fs::file_type::directory) {
    throw std::runtime_error(path + ": cannot be written: is a folder; give a file");
  }
  if (problem.empty() && type != fs::file_type::regular) {
    throw std::runtime_error(path + ": cannot be written: is a " + SpecialTypeName(type) +
                             "; give a regular file");
  }
}

// Removes the entry from its folder, not the target of a link, so that a file opened under this
// name is a new one.
void RemoveEntry(const std::string& path) {
  std::error_code ignored;  // opening the file for writing reports the error
  fs::remove(path, ignored);
}

// Writes the temporary file that becomes `path`, and returns its name.
std::string WritePartial(const std::string& path, const std::string& content) {
  CheckReplaceable(path);
  const std::string partial = path + ".partial";
  RemoveEntry(partial);
  errno = 0;
  std::ofstream file(partial, std::ios::binary);
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (file) return partial;
  const int cause = errno;
  RemoveEntry(partial);
  throw WriteError(path, cause);
}

}  // namespace

std::string ErrorText(const std::error_code& error) {
  const ClassicLocale locale;
  return error.message();
}

bool HasEntry(const std::string& path) {
  std::error_code error;
  const fs::file_type type = fs::symlink_status(path, error).type();
  return type != fs::file_type::none && type != fs::file_type::not_found;
}

std::string PathIn(const std::string& folder, const std::string& name) {
  return (fs::path(folder) / name).string();
}

std::string ParentFolder(const std::string& folder) {
  std::error_code error;  // set if the working directory was deleted
  return fs::absolute(folder, error).lexically_normal().parent_path().string();
}

std::string FindEntry(const std::string& folder, const std::string& name) {
  return FirstEntry(folder, {name});
}

std::string FirstEntry(const std::string& folder, const std::vector<std::string>& names) {
  std::vector<std::string> entries;
  for (const std::string& name : names) {
    std::string path = PathIn(folder, name);
    if (HasEntry(path)) return path;
    if (entries.empty() && FolderProblem(folder).empty()) {
      entries = ListFolder(folder);
      std::sort(entries.begin(), entries.end());
    }
    const std::string lowercase = Lowercase(name);
    for (const std::string& entry : entries) {
      if (Lowercase(fs::path(entry).filename().string()) == lowercase) return entry;
    }
  }
  return "";
}

bool IsFolder(const std::string& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

std::string FileProblem(const std::string& path, std::uintmax_t max_bytes) {
  fs::file_type type;
  std::string problem = ResolveType(path, &type);
  if (!problem.empty()) return problem;
  if (type == fs::file_type::directory) return "is a folder; a file is needed";
  if (type != fs::file_type::regular) {
    return "is a " + SpecialTypeName(type) +
           ", which may be endless; copy its contents to a regular file";
  }
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (error) return "cannot be read: " + ErrorText(error);
  if (size > max_bytes) {
    return "has " + Megabytes(size) + ", more than the " + Megabytes(max_bytes) +
           " allowed for such a file; check that it is the right file";
  }
  return "";
}

std::string FolderProblem(const std::string& path) {
  fs::file_type type;
  std::string problem = ResolveType(path, &type);
  if (!problem.empty()) return problem;
  if (type == fs::file_type::regular) return "is a file";
  if (type != fs::file_type::directory) return "is a " + SpecialTypeName(type);
  std::error_code error;
  const fs::directory_iterator entries(path, error);
  return error ? "cannot be listed: " + ErrorText(error) + " (check the permissions)" : "";
}

std::string ReadFile(const std::string& path, std::uintmax_t max_bytes) {
  const std::string problem = FileProblem(path, max_bytes);
  if (!problem.empty()) throw std::runtime_error(path + ": " + problem);
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + ": cannot be read (check its permissions)");
  // Reads the size found now, because the file may grow.
  std::string content(static_cast<size_t>(fs::file_size(path)), '\0');
  file.read(content.data(), static_cast<std::streamsize>(content.size()));
  if (file.bad()) throw std::runtime_error(path + ": cannot be read: the disk reports an error");
  content.resize(static_cast<size_t>(file.gcount()));
  return content;
}

std::string ReadBeginning(const std::string& path, size_t count) {
  std::string bytes(count, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<size_t>(file.gcount()));
  return bytes;
}

std::vector<std::string> ListFolder(const std::string& folder) {
  const std::string problem = FolderProblem(folder);
  if (!problem.empty()) throw std::runtime_error(folder + ": " + problem + "; a folder is needed");
  std::vector<std::string> paths;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    paths.push_back(entry.path().string());
  }
  return paths;
}

void WriteFile(const std::string& path, const std::string& content) {
  const std::string partial = WritePartial(path, content);
  std::error_code error;
  fs::rename(partial, path, error);
  if (!error) return;
  RemoveEntry(partial);
  throw WriteError(path, error.value());
}

void CheckWritable(const std::string& path) { RemoveEntry(WritePartial(path, "")); }

GrowingFile::GrowingFile(const std::string& path, const std::string& text) : path_(path) {
  WriteFile(path, text);
  stream_.rdbuf()->pubsetbuf(nullptr, 0);  // what fails is not kept and written later
  stream_.open(path, std::ios::binary | std::ios::app);
  Append("");
}

void GrowingFile::Append(const std::string& text) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path_, error);
  errno = 0;
  stream_ << text << std::flush;
  if (stream_) return;
  const int cause = errno;
  stream_.clear();                                  // a later text may fit
  if (!error) fs::resize_file(path_, size, error);  // takes back a part of the text
  throw WriteError(path_, cause);
}

void MakeFolder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw std::runtime_error(path + ": cannot be created: " + ErrorText(error));
}

void RefuseToOverwrite(const std::vector<std::string>& inputs, const std::string& output) {
  const auto is_output = [&](const std::string& input) {
    std::error_code error;  // set if one of them does not exist
    return fs::equivalent(input, output, error);
  };
  const auto input = std::find_if(inputs.begin(), inputs.end(), is_output);
  if (input == inputs.end()) return;
  throw std::runtime_error(output + ": would be written over the input " + *input +
                           "; give another path for the results");
}

}  // namespace msc_vo
