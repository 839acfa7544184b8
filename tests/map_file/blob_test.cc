// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/blob.h"

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "msc_vo/bundle_adjustment/validation.h"
#include "msc_vo/map_file/internal/feature_blob.h"

namespace msc_vo {
namespace {

TEST(BlobTest, WritesLeastSignificantByteFirst) {
  BlobWriter writer;
  writer.U16(0x0102);
  writer.F32(1.0);
  writer.Pixel(-1.0);
  EXPECT_EQ(writer.bytes(), std::string("\x02\x01\x00\x00\x80\x3f\x00\xff\xff", 9));
}

TEST(BlobTest, ReadsWhatWasWritten) {
  BlobWriter writer;
  writer.U8(200);
  writer.F64(0.1);
  writer.F16(0.333);
  writer.Pixel(123.4567);
  BlobReader reader(writer.bytes());
  EXPECT_EQ(reader.U8(), 200);
  EXPECT_EQ(reader.F64(), 0.1);
  EXPECT_NEAR(reader.F16(), 0.333, 0.333 / 2048);
  EXPECT_NEAR(reader.Pixel(), 123.4567, 0.5 / 256);
  EXPECT_TRUE(reader.AtEnd());
}

TEST(BlobTest, VarintsHoldAllNumbers) {
  const int64_t values[] = {0,
                            -1,
                            1,
                            63,
                            64,
                            -64,
                            -65,
                            300,
                            int64_t{1} << 40,
                            std::numeric_limits<int64_t>::max(),
                            std::numeric_limits<int64_t>::min()};
  BlobWriter writer;
  for (const int64_t value : values) writer.Varint(value);
  BlobReader reader(writer.bytes());
  for (const int64_t value : values) EXPECT_EQ(reader.Varint(), value);
  EXPECT_TRUE(reader.AtEnd());
}

TEST(BlobTest, RefusesWhatItCannotHold) {
  BlobWriter writer;
  EXPECT_THROW(writer.Pixel(32768.0), std::invalid_argument);
  EXPECT_THROW(writer.Pixel(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
  EXPECT_NO_THROW(writer.Pixel(-32767.0));
}

TEST(BlobTest, RefusesBytesThatAreNotNumbers) {
  EXPECT_THROW(BlobReader("abc").F32(), BlobError);
  EXPECT_THROW(BlobReader(std::string("\x00\x00\x80\x7f", 4)).F32(), BlobError);  // infinity
  EXPECT_THROW(BlobReader(std::string("\x00\x7e", 2)).F16(), BlobError);          // NaN
  EXPECT_THROW(BlobReader(std::string(10, '\xff')).Varint(), BlobError);
  EXPECT_THROW(BlobReader("\x80").Varint(), BlobError);
}

std::string EncodedLine(double correlation) {
  auto frame = std::make_shared<Frame>();
  LineFeature line;
  line.segment = {{100.0, 100.0}, {200.0, 150.0}};
  line.depth = LineDepth();
  line.depth->start = line.depth->end = 0.5;
  line.depth->covariance << 1e-4, correlation * 2e-5, correlation * 2e-5, 4e-6;
  frame->lines = {line};
  Keyframe keyframe;
  keyframe.frame = frame;
  keyframe.landmarks.Of<LineLandmark>() = {LandmarkId{0}};
  return EncodeFeatures(keyframe).features.Of<LineLandmark>();
}

bool HasRegularCovariance(const std::string& bytes) {
  std::vector<LineFeature> lines;
  DecodeFeatures(bytes, &lines);
  return CovarianceError(lines.at(0).depth->covariance) == nullptr;
}

// Bundle adjustment refuses covariances that are singular.
TEST(FeatureBlob, KeepsCovariancesOfLinesRegular) {
  for (const double correlation : {-0.999999, 0.5, 0.999999}) {
    EXPECT_TRUE(HasRegularCovariance(EncodedLine(correlation))) << correlation;
  }
}

TEST(FeatureBlob, MendsSingularCovariancesOfOlderMaps) {
  std::string bytes = EncodedLine(0.999999);
  const std::string limit("\xfe\x7f", 2), one("\xff\x7f", 2);
  const size_t at = bytes.find(limit);
  ASSERT_NE(at, std::string::npos);
  EXPECT_TRUE(HasRegularCovariance(bytes.replace(at, one.size(), one)));
}

}  // namespace
}  // namespace msc_vo
