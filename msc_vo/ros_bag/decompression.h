// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace msc_vo {

/// Largest message or chunk that is unpacked, bytes.
constexpr size_t kMaxUnpackedBytes = size_t{1} << 30;

/// Tests whether bytes begin a frame of zstd.
bool IsZstd(std::string_view bytes);

/// Unpack frames of zstd and of LZ4. Memory grows with what is unpacked, whatever a frame says of
/// its size. Both throw std::runtime_error if the bytes are damaged or cut off, or unpack to more
/// than `max_bytes`.
std::string UnpackZstd(std::string_view bytes, size_t max_bytes = kMaxUnpackedBytes);
std::string UnpackLz4(std::string_view bytes, size_t max_bytes = kMaxUnpackedBytes);

/// Unpacks a message if its recorder has compressed it (rosbag2 --compression-mode message).
std::string UnpackMessage(std::string bytes);

/// A file in the folder of temporary files, removed with this object.
class TemporaryFile {
 public:
  /// Throws std::runtime_error if it cannot be made.
  TemporaryFile();
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Unpacks a file of zstd in constant memory. Throws std::runtime_error, naming the file and the
/// fix, if it is damaged or the temporary file cannot be written.
std::unique_ptr<TemporaryFile> UnpackZstdFile(const std::string& path);

}  // namespace msc_vo
