// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/internal/feature_blob.h"

#include <algorithm>
#include <cmath>

#include "msc_vo/geometry/angles.h"
#include "msc_vo/map_file/internal/blob.h"

namespace msc_vo {

namespace {

constexpr uint8_t kDynamic =
    0x80;  // in the byte of the level of a point and of the flags of a line
constexpr uint8_t kLevelBits = 0x7f;  // in the byte of the level of a point: two's complement
constexpr int kLevels = kLevelBits + 1;
constexpr uint8_t kHasDepth = 0x01;
constexpr double kTurn = 256.0;  // units of an angle in the image
constexpr double kCorrelationUnits = 32767.0;
// Largest correlation, in its units: a covariance must not become singular by rounding. Maps of
// versions before this limit have larger ones.
constexpr double kMaxCorrelation = kCorrelationUnits - 1.0;
// Smallest positive number of 16 bits: a sigma must not become zero.
constexpr double kSmallest = 6e-8;

void PutSigma(double sigma, BlobWriter* blob) { blob->F16(std::max(sigma, kSmallest)); }

void PutPixel(const Eigen::Vector2d& pixel, BlobWriter* blob) {
  blob->Pixel(pixel.x());
  blob->Pixel(pixel.y());
}

void Put(const PointFeature& point, BlobWriter* blob) {
  PutPixel(point.pixel, blob);
  PutSigma(point.sigma, blob);
  const auto level = static_cast<uint8_t>(std::clamp(point.level, -kLevels / 2, kLevels / 2 - 1));
  blob->U8((level & kLevelBits) | (point.dynamic ? kDynamic : 0));
  blob->U8(static_cast<uint8_t>(std::lround(point.angle / (2.0 * kPi) * kTurn)));
  blob->F32(point.inverse_depth);
  if (point.HasDepth()) {
    PutSigma(point.inverse_depth_sigma, blob);
  } else {
    blob->F16(0.0);
  }
  blob->Bytes(point.descriptor);
}

int16_t LimitCorrelation(double units) {
  return static_cast<int16_t>(std::clamp(units, -kMaxCorrelation, kMaxCorrelation));
}

void Put(const LineDepth& depth, BlobWriter* blob) {
  const Eigen::Vector2d sigma = depth.covariance.diagonal().cwiseSqrt();
  const double product = sigma.prod();
  const double correlation = product > 0.0 ? depth.covariance(0, 1) / product : 0.0;
  blob->F32(depth.start);
  blob->F32(depth.end);
  PutSigma(sigma.x(), blob);
  PutSigma(sigma.y(), blob);
  blob->U16(static_cast<uint16_t>(LimitCorrelation(std::round(correlation * kCorrelationUnits))));
  blob->U16(static_cast<uint16_t>(std::clamp(depth.num_inliers, 0, 0xffff)));
  blob->F16(depth.inlier_ratio);
}

void Put(const LineFeature& line, BlobWriter* blob) {
  PutPixel(line.segment.start, blob);
  PutPixel(line.segment.end, blob);
  PutSigma(line.sigma, blob);
  blob->U8((line.dynamic ? kDynamic : 0) | (line.depth ? kHasDepth : 0));
  if (line.depth) Put(*line.depth, blob);
  blob->Bytes(line.descriptor);
}

double GetSigma(BlobReader* blob) {
  const double sigma = blob->F16();
  Require(sigma > 0.0, "a sigma that is not positive");
  return sigma;
}

Eigen::Vector2d GetPixel(BlobReader* blob) {
  const double x = blob->Pixel();
  return {x, blob->Pixel()};
}

PointFeature GetPoint(BlobReader* blob) {
  PointFeature point;
  point.pixel = GetPixel(blob);
  point.sigma = GetSigma(blob);
  const uint8_t level = blob->U8();
  point.level =
      (level & kLevelBits) < kLevels / 2 ? level & kLevelBits : (level & kLevelBits) - kLevels;
  point.dynamic = (level & kDynamic) != 0;
  point.angle = blob->U8() / kTurn * 2.0 * kPi;
  point.inverse_depth = blob->F32();
  point.inverse_depth_sigma = blob->F16();
  Require(point.inverse_depth >= 0.0, "a depth that is negative");
  Require((point.inverse_depth_sigma > 0.0) == point.HasDepth(), "a depth without its sigma");
  blob->Bytes(&point.descriptor);
  return point;
}

LineDepth GetLineDepth(BlobReader* blob) {
  LineDepth depth;
  depth.start = blob->F32();
  depth.end = blob->F32();
  Require(depth.start > 0.0 && depth.end > 0.0, "a depth of a line that is not positive");
  const double start = GetSigma(blob);
  const double end = GetSigma(blob);
  const auto units = static_cast<int16_t>(blob->U16());
  Require(std::abs(units) <= kCorrelationUnits, "a correlation beyond one");
  const double correlation = LimitCorrelation(units) / kCorrelationUnits;
  const double covariance = correlation * start * end;
  depth.covariance << start * start, covariance, covariance, end * end;
  depth.num_inliers = blob->U16();
  depth.inlier_ratio = blob->F16();
  return depth;
}

LineFeature GetLine(BlobReader* blob) {
  LineFeature line;
  line.segment.start = GetPixel(blob);
  line.segment.end = GetPixel(blob);
  Require(line.segment.Length() > 0.0, "a line without a length");
  line.sigma = GetSigma(blob);
  const uint8_t flags = blob->U8();
  Require((flags & ~(kDynamic | kHasDepth)) == 0, "unknown flags of a line");
  line.dynamic = (flags & kDynamic) != 0;
  if ((flags & kHasDepth) != 0) line.depth = GetLineDepth(blob);
  blob->Bytes(&line.descriptor);
  return line;
}

}  // namespace

FeatureBlobs EncodeFeatures(const Keyframe& keyframe) {
  FeatureBlobs blobs;
  ForEachLandmarkKind([&](auto kind) {
    using L = typename decltype(kind)::Landmark;
    const std::vector<LandmarkId>& slots = SlotsOf<L>(keyframe);
    BlobWriter features, landmarks;
    LandmarkId last = 0;
    for (size_t i = 0; i < slots.size(); ++i) {
      if (slots[i] == kNoId) continue;
      Put(FeaturesOf<L>(*keyframe.frame)[i], &features);
      landmarks.Varint(slots[i] - last);
      last = slots[i];
    }
    blobs.features.Of<L>() = features.bytes();
    blobs.landmarks.Of<L>() = landmarks.bytes();
  });
  BlobWriter ranges;
  for (const DepthRanges::Cell& cell : keyframe.frame->depth_ranges.cells) {
    ranges.F16(cell.min_inverse_depth);
    ranges.F16(cell.max_inverse_depth);
  }
  blobs.depth_ranges = ranges.bytes();
  return blobs;
}

void DecodeFeatures(std::string_view bytes, std::vector<PointFeature>* points) {
  for (BlobReader blob(bytes); !blob.AtEnd();) points->push_back(GetPoint(&blob));
}

void DecodeFeatures(std::string_view bytes, std::vector<LineFeature>* lines) {
  for (BlobReader blob(bytes); !blob.AtEnd();) lines->push_back(GetLine(&blob));
}

void DecodeLandmarks(std::string_view bytes, std::vector<LandmarkId>* landmarks) {
  // Unsigned, because a sum of hostile numbers may overflow.
  uint64_t last = 0;
  for (BlobReader blob(bytes); !blob.AtEnd();) {
    last += static_cast<uint64_t>(blob.Varint());
    landmarks->push_back(static_cast<LandmarkId>(last));
    Require(landmarks->back() >= 0, "a negative id of a landmark");
  }
}

DepthRanges DecodeDepthRanges(std::string_view bytes) {
  DepthRanges ranges;
  for (BlobReader blob(bytes); !blob.AtEnd();) {
    DepthRanges::Cell cell;
    cell.min_inverse_depth = static_cast<float>(blob.F16());
    cell.max_inverse_depth = static_cast<float>(blob.F16());
    Require(cell.min_inverse_depth >= 0.0f && cell.max_inverse_depth >= cell.min_inverse_depth,
            "a depth range that is not one");
    ranges.cells.push_back(cell);
  }
  const size_t num_cells = DepthRanges::kColumns * DepthRanges::kRows;
  Require(ranges.cells.empty() || ranges.cells.size() == num_cells,
          "another number of depth ranges");
  return ranges;
}

}  // namespace msc_vo
