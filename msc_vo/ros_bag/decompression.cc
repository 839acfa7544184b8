// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/decompression.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include <lz4frame.h>
#include <unistd.h>
#include <zstd.h>

namespace msc_vo {

namespace {

constexpr size_t kBlockBytes = size_t{1} << 17;
constexpr char kDamaged[] = "the compressed data are damaged or cut off";

// Unpacks frames of zstd piece by piece.
class ZstdStream {
 public:
  ZstdStream() : stream_(ZSTD_createDStream()), block_(kBlockBytes) {
    if (stream_ == nullptr) throw std::bad_alloc();
    // A frame may ask for a window of up to 2 GB; 128 MB is what the levels of zstd make.
    ZSTD_DCtx_setParameter(stream_.get(), ZSTD_d_windowLogMax, 27);
  }

  // Calls `write` with the unpacked pieces.
  template <typename Write>
  void Unpack(std::string_view packed, const Write& write) {
    ZSTD_inBuffer input = {packed.data(), packed.size(), 0};
    for (bool is_full = false; input.pos < input.size || is_full;) {
      ZSTD_outBuffer output = {block_.data(), block_.size(), 0};
      const size_t result = ZSTD_decompressStream(stream_.get(), &output, &input);
      if (ZSTD_isError(result)) throw std::runtime_error(kDamaged);
      is_at_end_ = result == 0;
      is_full = output.pos == output.size && !is_at_end_;
      write(std::string_view(block_.data(), output.pos));
    }
  }
  // Throws if the last frame is not whole.
  void Finish() const {
    if (!is_at_end_) throw std::runtime_error(kDamaged);
  }

 private:
  struct Free {
    void operator()(ZSTD_DStream* stream) const { ZSTD_freeDStream(stream); }
  };
  std::unique_ptr<ZSTD_DStream, Free> stream_;
  std::vector<char> block_;
  bool is_at_end_ = false;
};

void Append(std::string_view piece, size_t max_bytes, std::string* bytes) {
  if (piece.size() > max_bytes - bytes->size()) {
    throw std::runtime_error("the compressed data hold more than they say");
  }
  bytes->append(piece);
}

}  // namespace

bool IsZstd(std::string_view bytes) { return bytes.substr(0, 4) == "\x28\xb5\x2f\xfd"; }

std::string UnpackZstd(std::string_view bytes, size_t max_bytes) {
  std::string unpacked;
  ZstdStream stream;
  stream.Unpack(bytes, [&](std::string_view piece) { Append(piece, max_bytes, &unpacked); });
  stream.Finish();
  return unpacked;
}

std::string UnpackLz4(std::string_view bytes, size_t max_bytes) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION))) throw std::bad_alloc();
  const auto free = [](LZ4F_dctx* c) { LZ4F_freeDecompressionContext(c); };
  const std::unique_ptr<LZ4F_dctx, decltype(free)> guard(context, free);
  std::string unpacked;
  std::vector<char> block(kBlockBytes);
  bool is_at_end = bytes.empty();
  for (bool is_full = false; !bytes.empty() || is_full;) {
    size_t num_written = block.size(), num_read = bytes.size();
    const size_t result =
        LZ4F_decompress(context, block.data(), &num_written, bytes.data(), &num_read, nullptr);
    if (LZ4F_isError(result)) throw std::runtime_error(kDamaged);
    bytes.remove_prefix(num_read);
    Append({block.data(), num_written}, max_bytes, &unpacked);
    is_at_end = result == 0;
    is_full = num_written == block.size() && !is_at_end;
  }
  if (!is_at_end) throw std::runtime_error(kDamaged);
  return unpacked;
}

std::string UnpackMessage(std::string bytes) { return IsZstd(bytes) ? UnpackZstd(bytes) : bytes; }

TemporaryFile::TemporaryFile()
    : path_((std::filesystem::temp_directory_path() / "msc_vo_bag_XXXXXX").string()) {
  const int file = mkstemp(path_.data());
  if (file < 0) {
    throw std::runtime_error(path_ +
                             ": no temporary file can be made; TMPDIR names another folder");
  }
  close(file);
}

TemporaryFile::~TemporaryFile() {
  std::error_code error;  // an open file stays readable
  std::filesystem::remove(path_, error);
}

std::unique_ptr<TemporaryFile> UnpackZstdFile(const std::string& path) {
  auto unpacked = std::make_unique<TemporaryFile>();
  std::ifstream input(path, std::ios::binary);
  std::ofstream output(unpacked->path(), std::ios::binary);
  ZstdStream stream;
  std::vector<char> block(kBlockBytes);
  try {
    while (input.read(block.data(), static_cast<std::streamsize>(block.size())),
           input.gcount() > 0) {
      stream.Unpack({block.data(), static_cast<size_t>(input.gcount())},
                    [&](std::string_view piece) {
                      output.write(piece.data(), static_cast<std::streamsize>(piece.size()));
                    });
      if (!output) break;
    }
    if (output) stream.Finish();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path + ": " + error.what() + "; restore a copy");
  }
  if (!output.flush()) {
    throw std::runtime_error(path + ": cannot be unpacked to " + unpacked->path() +
                             "; make room there, or name another folder by TMPDIR");
  }
  return unpacked;
}

}  // namespace msc_vo
