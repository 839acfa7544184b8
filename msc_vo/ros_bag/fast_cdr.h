// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <cstdint>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

namespace msc_vo::fast_cdr {

using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;

// What Fast CDR 2 names otherwise than Fast CDR 1.
#if FASTCDR_VERSION_MAJOR >= 2
constexpr auto kPlainCdr = eprosima::fastcdr::CdrVersion::DDS_CDR;
inline size_t PositionOf(const Cdr& cdr) { return cdr.get_serialized_data_length(); }
inline void AddArray(const uint8_t* bytes, size_t size, Cdr* cdr) {
  cdr->serialize_array(bytes, size);
}
#else
constexpr auto kPlainCdr = Cdr::DDS_CDR;
inline size_t PositionOf(const Cdr& cdr) { return cdr.getSerializedDataLength(); }
inline void AddArray(const uint8_t* bytes, size_t size, Cdr* cdr) {
  cdr->serializeArray(bytes, size);
}
#endif

}  // namespace msc_vo::fast_cdr
