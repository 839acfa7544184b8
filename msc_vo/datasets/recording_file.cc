// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/recording_file.h"

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr char kExport[] =
    "export its colour and depth images to rgb/ and depth/, as files named by their times, and "
    "give "
    "the folder that holds both";
constexpr char kUnpack[] = "unpack it and give the folder of the sequence";
constexpr char kCommandReads[] =
    "the command msc_vo reads it if its name ends with .bag, .db3, .mcap or .oni; msc_vo record "
    "makes a folder of it";
constexpr char kGiveFolder[] = "give the folder of the sequence";

// A kind of file: its first bytes, or the endings of its name if they are empty.
struct FileKind {
  std::string_view magic;
  size_t magic_at;
  std::string_view endings;  // each between blanks
  const char* what;
  const char* fix;
};

using std::string_view_literals::operator""sv;

// Endings precede the bytes of a container format that several kinds of files have in common.
constexpr FileKind kKinds[] = {
    {"", 0, " .svo .svo2 ", "a recording of a ZED camera", kExport},
    {"", 0, " .sens ", "a recording of ScanNet",
     "export its colour and depth images, poses and intrinsics with ScanNet's SensReader, and give "
     "the folder"},
    {"", 0, " .r3d ", "a recording of Record3D",
     "its depth has a format of its own: export it in Record3D as RGBD with depth images (EXR + "
     "JPG), and give the folder that holds them as rgb/ and depth/"},
    {"", 0, " .klg ", "a log of Kintinuous or ElasticFusion", kExport},
    {"", 0, " .npz .npy .pkl .mat ", "a file of arrays", kExport},
    {"SQLite format 3\0"sv, 0, "", "an SQLite database, as a bag of ROS 2", kCommandReads},
    {"\x89MCAP"sv, 0, "", "an MCAP recording, as of ROS 2", kCommandReads},
    {"", 0, " .db3 .mcap ", "a bag of ROS 2", kCommandReads},
    {"#ROSBAG V"sv, 0, "", "a bag of ROS 1", kCommandReads},
    {"", 0, " .oni ", "a recording of OpenNI2", kCommandReads},
    {"ftyp"sv, 4, "", "a video", kExport},
    {"\x1a\x45\xdf\xa3"sv, 0, "", "a Matroska video, as of Azure Kinect", kExport},
    {"AVI "sv, 8, "", "a video", kExport},
    {"", 0, " .mp4 .m4v .mov .mkv .webm .avi .mpg .mpeg .wmv .h264 .hevc ", "a video", kExport},
    {"\x89HDF"sv, 0, "", "an HDF5 file", kExport},
    {"PK\x03\x04"sv, 0, "", "a zip archive", kUnpack},
    {"\x1f\x8b"sv, 0, "", "an archive or a file that is compressed with gzip", kUnpack},
    {"BZh"sv, 0, "", "an archive or a file that is compressed with bzip2", kUnpack},
    {"\xfd"
     "7zXZ"sv,
     0, "", "an archive or a file that is compressed with xz", kUnpack},
    {"\x28\xb5\x2f\xfd"sv, 0, "", "an archive or a file that is compressed with zstd", kUnpack},
    {"7z\xbc\xaf\x27\x1c"sv, 0, "", "a 7z archive", kUnpack},
    {"Rar!"sv, 0, "", "a rar archive", kUnpack},
    {"ustar"sv, 257, "", "a tar archive", kUnpack},
    {"", 0, " .zip .tar .tgz .tbz2 .txz .gz .bz2 .xz .zst .7z .rar ", "an archive", kUnpack},
    {"ply\n"sv, 0, "", "a point cloud or a mesh", kGiveFolder},
    {"# .PCD"sv, 0, "", "a point cloud", kGiveFolder},
    {"\x89PNG"sv, 0, "", "an image", kGiveFolder},
    {"\xff\xd8\xff"sv, 0, "", "an image", kGiveFolder}};

bool IsKind(const FileKind& kind, const std::string& bytes, const std::string& ending) {
  if (!kind.magic.empty()) {
    return bytes.size() >= kind.magic_at &&
           bytes.compare(kind.magic_at, kind.magic.size(), kind.magic) == 0;
  }
  return !ending.empty() && kind.endings.find(" " + ending + " ") != std::string_view::npos;
}

// Returns the kind of a file; null if it is unknown or cannot be read.
const FileKind* FindKind(const std::string& path) {
  if (!FileProblem(path, UINTMAX_MAX).empty()) return nullptr;
  constexpr size_t kBeginning = 512;  // in which all magic bytes lie
  const std::string bytes = ReadBeginning(path, kBeginning);
  const std::string ending = Lowercase(std::filesystem::path(path).extension().string());
  for (const FileKind& kind : kKinds) {
    if (IsKind(kind, bytes, ending)) return &kind;
  }
  return nullptr;
}

}  // namespace

bool IsSequenceFile(const std::string& path) {
  const FileKind* kind = FindKind(path);
  return kind != nullptr && kind->fix != kGiveFolder;
}

std::string DescribeFile(const std::string& path) {
  const FileKind* kind = FindKind(path);
  return kind == nullptr ? "" : std::string("is ") + kind->what + "; " + kind->fix;
}

}  // namespace msc_vo
