// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/exports/cdr_writer.h"

#include "msc_vo/ros_bag/fast_cdr.h"

namespace msc_vo {

namespace {

using namespace fast_cdr;

}  // namespace

struct CdrWriter::Stream {
  FastBuffer buffer;  // grows
  Cdr cdr = Cdr(buffer, Cdr::LITTLE_ENDIANNESS, kPlainCdr);

  // Adds a value that is aligned to `size` bytes. The padding that Fast CDR adds is not
  // initialised.
  template <typename Value>
  void Add(const Value& value, size_t size = sizeof(Value)) {
    constexpr size_t kEncapsulation = 4;
    while ((PositionOf(cdr) - kEncapsulation) % size != 0) cdr << uint8_t{0};
    cdr << value;
  }
};

CdrWriter::CdrWriter() : stream_(std::make_unique<Stream>()) {
  stream_->cdr.serialize_encapsulation();
}
CdrWriter::~CdrWriter() = default;

CdrWriter& CdrWriter::AddByte(uint8_t value) {
  stream_->Add(value);
  return *this;
}
CdrWriter& CdrWriter::AddWord(uint32_t value) {
  stream_->Add(value);
  return *this;
}
CdrWriter& CdrWriter::AddInt(int32_t value) {
  stream_->Add(value);
  return *this;
}
CdrWriter& CdrWriter::AddFloat(float value) {
  stream_->Add(value);
  return *this;
}
CdrWriter& CdrWriter::AddDouble(double value) {
  stream_->Add(value);
  return *this;
}
CdrWriter& CdrWriter::AddString(const std::string& text) {
  stream_->Add(text, sizeof(uint32_t));  // its length
  return *this;
}
CdrWriter& CdrWriter::AddBytes(std::string_view bytes) {
  AddWord(static_cast<uint32_t>(bytes.size()));
  if (!bytes.empty()) {
    AddArray(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), &stream_->cdr);
  }
  return *this;
}

std::string CdrWriter::Message() const {
  return std::string(stream_->buffer.getBuffer(), PositionOf(stream_->cdr));
}

}  // namespace msc_vo
