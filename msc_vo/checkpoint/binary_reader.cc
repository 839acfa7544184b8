// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/checkpoint/binary_reader.h"

#include <cstring>
#include <stdexcept>

namespace msc_vo {

void BinaryReader::Fail() {
  throw std::runtime_error("its contents are not those of a checkpoint");
}

void BinaryReader::GetBytes(void* data, size_t size) {
  if (size > bytes_.size()) Fail();
  if (size > 0) std::memcpy(data, bytes_.data(), size);
  bytes_.remove_prefix(size);
}

size_t BinaryReader::GetSize() {
  uint64_t size = 0;
  Get(size);
  if (size > bytes_.size()) Fail();
  return static_cast<size_t>(size);
}

void BinaryReader::Finish() const {
  if (!bytes_.empty()) Fail();
}

}  // namespace msc_vo
