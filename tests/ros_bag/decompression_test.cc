// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/decompression.h"

#include <vector>

#include "tests/ros_bag/bag_writer.h"
#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <lz4frame.h>

namespace msc_vo {
namespace {

std::string Lz4(const std::string& bytes) {
  std::string packed(LZ4F_compressFrameBound(bytes.size(), nullptr), '\0');
  packed.resize(
      LZ4F_compressFrame(packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr));
  return packed;
}

std::string Text(size_t size) {
  std::string text;
  for (size_t i = 0; i < size; ++i) text += static_cast<char>(i * i % 251);
  return text;
}

// Sizes around those of the blocks in which it is unpacked.
TEST(Decompression, UnpacksAllSizes) {
  for (const size_t size : {0, 1, 1000, 131071, 131072, 131073, 1000000}) {
    EXPECT_EQ(UnpackZstd(Zstd(Text(size))), Text(size)) << size;
    EXPECT_EQ(UnpackLz4(Lz4(Text(size))), Text(size)) << size;
  }
}

TEST(Decompression, RefusesCutAndDamagedData) {
  const std::string text = Text(300000);
  for (const bool is_zstd : {true, false}) {
    const std::string packed = is_zstd ? Zstd(text) : Lz4(text);
    const auto unpack = [&](const std::string& bytes) {
      return is_zstd ? UnpackZstd(bytes) : UnpackLz4(bytes);
    };
    for (const size_t size : {size_t{1}, size_t{10}, packed.size() / 2, packed.size() - 1}) {
      EXPECT_THROW(unpack(packed.substr(0, size)), std::runtime_error) << size;
    }
    EXPECT_THROW(unpack("neither of them"), std::runtime_error);
  }
}

TEST(Decompression, StopsAtTheLimit) {
  const std::string zeros(1000000, '\0');
  EXPECT_EQ(UnpackZstd(Zstd(zeros), zeros.size()), zeros);
  EXPECT_EQ(UnpackLz4(Lz4(zeros), zeros.size()), zeros);
  EXPECT_THAT(MessageOf([&] { UnpackZstd(Zstd(zeros), zeros.size() - 1); }), Names("more"));
  EXPECT_THAT(MessageOf([&] { UnpackLz4(Lz4(zeros), zeros.size() - 1); }), Names("more"));
}

class DecompressionTest : public TemporaryFolder {};

TEST_F(DecompressionTest, RemovesTheFileThatItUnpacks) {
  WriteText("x.zstd", Zstd(Text(400000)));
  std::string path;
  {
    const std::unique_ptr<TemporaryFile> file = UnpackZstdFile(Path("x.zstd"));
    path = file->path();
    EXPECT_EQ(std::filesystem::file_size(path), 400000u);
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  WriteText("cut.zstd", Zstd(Text(400000)).substr(0, 300));
  EXPECT_THAT(MessageOf([&] { UnpackZstdFile(Path("cut.zstd")); }), Names("cut.zstd", "cut off"));
}

}  // namespace
}  // namespace msc_vo
