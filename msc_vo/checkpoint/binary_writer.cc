// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/checkpoint/binary_writer.h"

namespace msc_vo {

void BinaryWriter::Collect() {
  bytes_.append(recent_.data(), num_recent_);
  num_recent_ = 0;
  constexpr size_t kMaxBytes = size_t{1} << 22;
  if (!sink_ || bytes_.size() < kMaxBytes) return;
  const size_t size = bytes_.size() / 8 * 8;
  sink_(std::string_view(bytes_).substr(0, size));
  bytes_.erase(0, size);
}

void BinaryWriter::PutManyBytes(const void* data, size_t size) {
  Collect();
  if (size <= recent_.size()) return PutBytes(data, size);
  bytes_.append(static_cast<const char*>(data), size);
}

}  // namespace msc_vo
