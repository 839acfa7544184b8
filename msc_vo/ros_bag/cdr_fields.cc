// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include <stdexcept>

#include "msc_vo/ros_bag/fast_cdr.h"
#include "msc_vo/ros_bag/ros_fields.h"

namespace msc_vo {

namespace {

using namespace fast_cdr;

// Calls what reads from a message; an error of the library becomes ours.
template <typename Read>
auto Guarded(const Read& read) {
  try {
    return read();
  } catch (const eprosima::fastcdr::exception::Exception&) {
    throw std::runtime_error("the message ends too early, or is no CDR");
  }
}

class CdrFields : public RosFields {
 public:
  explicit CdrFields(std::string_view message)
      : message_(message),
        buffer_(const_cast<char*>(message.data()), message.size()),
        cdr_(buffer_, Cdr::DEFAULT_ENDIAN, kPlainCdr) {
    Guarded([&] { cdr_.read_encapsulation(); });
  }

  bool IsAtEnd() const override { return PositionOf(cdr_) >= message_.size(); }
  uint8_t ReadByte() override { return Read<uint8_t>(); }
  uint32_t ReadWord() override { return Read<uint32_t>(); }
  float ReadFloat() override { return Read<float>(); }
  double ReadDouble() override { return Read<double>(); }
  std::string ReadString() override {
    std::string text(ReadBytes());
    if (!text.empty() && text.back() == '\0') text.pop_back();
    return text;
  }
  std::string_view ReadBytes() override {
    const uint32_t size = ReadWord();
    const size_t begin = PositionOf(cdr_);
    if (size > message_.size() - begin) throw std::runtime_error("the message ends too early");
    // The last byte is read, because the next value is aligned by the size of the last one.
    if (size > 0) {
      cdr_.jump(size - 1);
      ReadByte();
    }
    return message_.substr(begin, size);
  }

 private:
  template <typename Number>
  Number Read() {
    return Guarded([&] {
      Number value;
      cdr_ >> value;
      return value;
    });
  }

  std::string_view message_;
  FastBuffer buffer_;
  Cdr cdr_;
};

}  // namespace

std::unique_ptr<RosFields> OpenCdrFields(std::string_view message) {
  return std::make_unique<CdrFields>(message);
}

}  // namespace msc_vo
