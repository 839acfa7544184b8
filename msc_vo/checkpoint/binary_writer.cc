// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/checkpoint/binary_writer.h"

namespace msc_vo {

void BinaryWriter::PutBytes(const void* data, size_t size) {
  bytes_.append(static_cast<const char*>(data), size);
}

}  // namespace msc_vo
