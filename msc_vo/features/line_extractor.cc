// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/line_extractor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "msc_vo/features/internal/edge_segments.h"
#include "msc_vo/features/internal/line_descriptor_extractor.h"
#include "msc_vo/features/internal/line_merging.h"
#include "msc_vo/features/internal/line_refinement.h"
#include "msc_vo/geometry/cell_index.h"
#include "msc_vo/sensor/standalone_image.h"

namespace msc_vo {

namespace {

using Eigen::Vector2d;

// Shortest segment that is considered for merging, pixels: about the shortest one that passes the
// detectors' validation against chance.
constexpr double kMinPiece = 8.0;
// Distance from the line at which grey values of its two sides are compared, pixels: outside the
// blur of the edge.
constexpr double kSideDistance = 2.0;
// Largest number of samples along a line for this comparison.
constexpr int kMaxSideSamples = 16;

double GrayAt(const cv::Mat& gray, const Vector2d& pixel) {
  const int x = std::clamp(cvRound(pixel.x()), 0, gray.cols - 1);
  const int y = std::clamp(cvRound(pixel.y()), 0, gray.rows - 1);
  return gray.at<uint8_t>(y, x);
}

// Orients the segment so that its brighter side is where ImageLine() is positive.
void OrientToBrighterSide(const cv::Mat& gray, LineSegment2* segment) {
  const Vector2d direction = segment->Direction();
  const Vector2d side = kSideDistance * Vector2d(-direction.y(), direction.x());
  const int samples = std::max(CellIndex(segment->Length() / 2.0, kMaxSideSamples + 1), 1);
  double contrast = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Vector2d x = segment->At((i + 0.5) / samples);
    contrast += GrayAt(gray, x + side) - GrayAt(gray, x - side);
  }
  // The direction of a line without contrast must not depend on the detector's.
  const bool backward =
      segment->start.x() > segment->end.x() ||
      (segment->start.x() == segment->end.x() && segment->start.y() > segment->end.y());
  if (contrast < 0.0 || (contrast == 0.0 && backward)) std::swap(segment->start, segment->end);
}

// Clips the ends of the segment to where the mask is not zero. Returns false if nothing remains.
bool ClipToMask(const cv::Mat& mask, LineSegment2* segment) {
  if (mask.empty()) return true;
  const int steps = static_cast<int>(std::ceil(segment->Length()));
  const auto is_visible = [&](int i) {
    const Vector2d x = segment->At(static_cast<double>(i) / steps);
    const cv::Point pixel(cvRound(x.x()), cvRound(x.y()));
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x < mask.cols && pixel.y < mask.rows &&
           mask.at<uint8_t>(pixel) != 0;
  };
  int first = 0;
  int last = steps;
  while (first <= last && !is_visible(first)) ++first;
  while (last > first && !is_visible(last)) --last;
  if (first >= last) return false;
  const LineSegment2 whole = *segment;
  segment->start = whole.At(static_cast<double>(first) / steps);
  segment->end = whole.At(static_cast<double>(last) / steps);
  return true;
}

// Returns the parts of the segment whose descriptors see no pixel that is left out; the segment
// itself if there are no such pixels.
std::vector<LineSegment2> SplitAtMask(const cv::Mat& distance, const LineSegment2& segment) {
  if (distance.empty()) return {segment};
  constexpr double kHalfWidth = LineDescriptorExtractor::kWidth / 2.0;
  const int steps = std::max(1, static_cast<int>(std::ceil(segment.Length())));
  const auto is_far = [&](int i) {
    const Vector2d x = segment.At(static_cast<double>(i) / steps);
    const int column = std::clamp(cvRound(x.x()), 0, distance.cols - 1);
    const int row = std::clamp(cvRound(x.y()), 0, distance.rows - 1);
    return distance.at<float>(row, column) > kHalfWidth;
  };
  std::vector<LineSegment2> parts;
  int first = -1;  // of the present part; -1: none
  for (int i = 0; i <= steps + 1; ++i) {
    const bool is_part = i <= steps && is_far(i);
    if (is_part && first < 0) first = i;
    if (is_part || first < 0) continue;
    parts.push_back({segment.At(static_cast<double>(first) / steps),
                     segment.At(static_cast<double>(i - 1) / steps)});
    first = -1;
  }
  return parts;
}

}  // namespace

struct LineExtractor::Detectors {
  cv::Ptr<cv::LineSegmentDetector> lsd;
  std::vector<cv::Vec4f> lsd_lines;
  EdgeSegmentDetector edges;
  LineDescriptorExtractor descriptor_extractor;
  std::vector<LineSegment2> pieces;

  // Fills `pieces`.
  void Detect(LineDetector detector, const cv::Mat& gray) {
    if (detector == LineDetector::kEdgeDrawing) {
      pieces = edges.Detect(gray);
      return;
    }
    lsd->detect(gray, lsd_lines);
    pieces.clear();
    for (const cv::Vec4f& line : lsd_lines) {
      pieces.push_back({Vector2d(line[0], line[1]), Vector2d(line[2], line[3])});
    }
  }
};

LineExtractor::LineExtractor(const LineExtractorOptions& options)
    : options_(options), detectors_(std::make_unique<Detectors>()) {
  if (options.detector == LineDetector::kLsd) {
    detectors_->lsd = cv::createLineSegmentDetector(cv::LSD_REFINE_STD);
  }
}

LineExtractor::~LineExtractor() = default;

std::vector<LineFeature> LineExtractor::Extract(const cv::Mat& image, const cv::Mat& mask,
                                                const cv::Mat& distance_to_left_out) {
  if (image.empty() || image.type() != CV_8UC1) {
    throw std::invalid_argument("LineExtractor: the image must be 8-bit grey (CV_8UC1)");
  }
  const cv::Mat gray = StandaloneImage(image);
  detectors_->Detect(options_.detector, gray);
  std::vector<LineSegment2> pieces;
  for (LineSegment2 segment : detectors_->pieces) {
    if (segment.Length() < kMinPiece || !ClipToMask(mask, &segment)) continue;
    for (LineSegment2 part : SplitAtMask(distance_to_left_out, segment)) {
      if (!distance_to_left_out.empty() && part.Length() < kMinPiece) continue;
      OrientToBrighterSide(gray, &part);
      pieces.push_back(part);
    }
  }
  const double min_length = options_.min_length * std::min(gray.cols, gray.rows);
  std::vector<LineFeature> features;
  for (const LineSegment2& segment : MergeCollinear(std::move(pieces))) {
    if (segment.Length() < min_length) break;  // longest first
    if (static_cast<int>(features.size()) == options_.max_lines) break;
    LineFeature feature;
    feature.segment = segment;
    if (options_.detector == LineDetector::kEdgeDrawing) RefineSegment(gray, &feature.segment);
    features.push_back(feature);
  }
  detectors_->descriptor_extractor.SetImage(gray);
  for (LineFeature& feature : features) {
    feature.descriptor = detectors_->descriptor_extractor.Describe(feature.segment);
  }
  return features;
}

}  // namespace msc_vo
