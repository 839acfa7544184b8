// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/checkpoint/growing_binary.h"

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

std::string LastError() { return ErrorText({errno, std::generic_category()}); }

}  // namespace

GrowingBinary::GrowingBinary(const std::string& path)
    : path_(path), descriptor_(open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) Fail("opened");
}

GrowingBinary::~GrowingBinary() { close(descriptor_); }

void GrowingBinary::Fail(const char* action) const {
  throw std::runtime_error(path_ + ": cannot be " + action + ": " + LastError() +
                           " (check the folder and the free space)");
}

void GrowingBinary::Resize(uint64_t size) {
  if (ftruncate(descriptor_, static_cast<off_t>(size)) != 0) Fail("written");
}

void GrowingBinary::Write(uint64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written =
        pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) Fail("written");
    bytes.remove_prefix(static_cast<size_t>(written));
    offset += static_cast<uint64_t>(written);
  }
}

void GrowingBinary::Sync() {
  if (fdatasync(descriptor_) != 0) Fail("written");
}

void GrowingBinary::Rename(const std::string& path) {
  if (std::rename(path_.c_str(), path.c_str()) != 0) Fail("renamed");
  path_ = path;
}

}  // namespace msc_vo
