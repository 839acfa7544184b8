// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/base64.h"

#include <cstdint>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

std::string Encode(const std::string& text) { return EncodeBase64(text.data(), text.size()); }

TEST(Base64, EncodesTheExamplesOfRfc4648) {
  EXPECT_EQ(Encode(""), "");
  EXPECT_EQ(Encode("f"), "Zg==");
  EXPECT_EQ(Encode("fo"), "Zm8=");
  EXPECT_EQ(Encode("foo"), "Zm9v");
  EXPECT_EQ(Encode("foob"), "Zm9vYg==");
  EXPECT_EQ(Encode("fooba"), "Zm9vYmE=");
  EXPECT_EQ(Encode("foobar"), "Zm9vYmFy");
}

TEST(Base64, EncodesAllBytesAndNumbers) {
  EXPECT_EQ(Encode("\xfb\xff\xfe"), "+//+");
  EXPECT_EQ(EncodeBase64(std::vector<uint16_t>{1, 0x0203}), "AQADAg==");
  EXPECT_EQ(EncodeBase64(std::vector<float>{1.0F}), "AACAPw==");
}

}  // namespace
}  // namespace msc_vo
