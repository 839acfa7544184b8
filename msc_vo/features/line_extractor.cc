// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/features/line_extractor.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include <opencv2/imgproc.hpp>
#include <opencv2/line_descriptor.hpp>
#include <opencv2/ximgproc/edge_drawing.hpp>

#include "msc_vo/features/line_refinement.h"

namespace msc_vo {

namespace {

using Eigen::Vector2d;

// Pieces shorter than this are not even merged: both detectors validate segments against chance,
// which nothing below about this many pixels passes.
constexpr double kMinPiece = 8.0;
// The grey values on both sides of a line are compared at this distance from it: outside the blur
// of the edge itself.
constexpr double kSideDistance = 2.0;
// At most so many places along a line are compared.
constexpr int kMaxSideSamples = 16;
// LBD is computed in the image of half the size, with bands of 4 pixels: its region of 9 bands then
// is 72 px of the image wide (63 with the original 7 px in full size), at a quarter of the time
// and, measured, with as many correct nearest neighbours.
constexpr int kBandWidth = 4;

double GrayAt(const cv::Mat& gray, const Vector2d& pixel) {
  const int x = std::clamp(cvRound(pixel.x()), 0, gray.cols - 1);
  const int y = std::clamp(cvRound(pixel.y()), 0, gray.rows - 1);
  return gray.at<uint8_t>(y, x);
}

// Turns the segment so that its brighter side is where ImageLine() is positive.
void OrientToBrighterSide(const cv::Mat& gray, LineSegment2* segment) {
  const Vector2d direction = segment->Direction();
  const Vector2d side = kSideDistance * Vector2d(-direction.y(), direction.x());
  const int samples = std::clamp(static_cast<int>(segment->Length() / 2.0), 1, kMaxSideSamples);
  double contrast = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Vector2d x = segment->At((i + 0.5) / samples);
    contrast += GrayAt(gray, x + side) - GrayAt(gray, x - side);
  }
  // A line without contrast keeps one of its two directions whatever the detector's was.
  const bool backward =
      segment->start.x() > segment->end.x() ||
      (segment->start.x() == segment->end.x() && segment->start.y() > segment->end.y());
  if (contrast < 0.0 || (contrast == 0.0 && backward)) std::swap(segment->start, segment->end);
}

// Cuts the ends of the segment back to where the mask is not zero. Returns false if nothing is
// left.
bool ClipToMask(const cv::Mat& mask, LineSegment2* segment) {
  if (mask.empty()) return true;
  const int steps = static_cast<int>(std::ceil(segment->Length()));
  const auto seen = [&](int i) {
    const Vector2d x = segment->At(static_cast<double>(i) / steps);
    const cv::Point pixel(cvRound(x.x()), cvRound(x.y()));
    return pixel.x >= 0 && pixel.y >= 0 && pixel.x < mask.cols && pixel.y < mask.rows &&
           mask.at<uint8_t>(pixel) != 0;
  };
  int first = 0;
  int last = steps;
  while (first <= last && !seen(first)) ++first;
  while (last > first && !seen(last)) --last;
  if (first >= last) return false;
  const LineSegment2 whole = *segment;
  segment->start = whole.At(static_cast<double>(first) / steps);
  segment->end = whole.At(static_cast<double>(last) / steps);
  return true;
}

// The segment in the half-size image, as OpenCV's descriptor wants it.
cv::line_descriptor::KeyLine ToHalfSizeKeyLine(const LineSegment2& segment, int index) {
  const auto half = [](const Vector2d& x) {
    return cv::Point2f(static_cast<float>(0.5 * x.x() - 0.25),
                       static_cast<float>(0.5 * x.y() - 0.25));
  };
  const cv::Point2f start = half(segment.start);
  const cv::Point2f end = half(segment.end);
  cv::line_descriptor::KeyLine line;
  line.startPointX = line.sPointInOctaveX = start.x;
  line.startPointY = line.sPointInOctaveY = start.y;
  line.endPointX = line.ePointInOctaveX = end.x;
  line.endPointY = line.ePointInOctaveY = end.y;
  line.pt = 0.5f * (start + end);
  line.angle = std::atan2(end.y - start.y, end.x - start.x);
  line.lineLength = static_cast<float>(cv::norm(end - start));
  line.numOfPixels = std::max(1, cvRound(line.lineLength));
  line.response = line.lineLength;
  line.size = std::abs((end.x - start.x) * (end.y - start.y));
  line.octave = 0;
  line.class_id = index;  // also the row of its descriptor
  return line;
}

}  // namespace

struct LineExtractor::Detectors {
  cv::Ptr<cv::LineSegmentDetector> lsd;
  cv::Ptr<cv::ximgproc::EdgeDrawing> edge_drawing;
  cv::Ptr<cv::line_descriptor::BinaryDescriptor> lbd;
  cv::Mat half_size;

  std::vector<cv::Vec4f> Detect(LineDetector detector, const cv::Mat& gray) {
    std::vector<cv::Vec4f> lines;
    if (detector == LineDetector::kLsd) {
      lsd->detect(gray, lines);
    } else {
      edge_drawing->detectEdges(gray);
      edge_drawing->detectLines(lines);
    }
    return lines;
  }

  void Describe(const cv::Mat& gray, std::vector<LineFeature>* features) {
    if (features->empty()) return;  // OpenCV complains on the console
    cv::resize(gray, half_size, cv::Size((gray.cols + 1) / 2, (gray.rows + 1) / 2), 0.0, 0.0,
               cv::INTER_AREA);
    std::vector<cv::line_descriptor::KeyLine> lines;
    for (size_t i = 0; i < features->size(); ++i) {
      lines.push_back(ToHalfSizeKeyLine((*features)[i].segment, static_cast<int>(i)));
    }
    cv::Mat descriptors;
    lbd->compute(half_size, lines, descriptors);
    for (size_t i = 0; i < features->size(); ++i) {
      Descriptor& descriptor = (*features)[i].descriptor;
      std::memcpy(descriptor.data(), descriptors.ptr(static_cast<int>(i)), descriptor.size());
    }
  }
};

bool LineExtractorOptions::IsValid(std::string* error) const {
  if (max_lines < 0) {
    *error = "lines.max_lines must not be negative";
  } else if (!(min_length > 0.0 && min_length <= 1.0)) {
    *error = "lines.min_length must be in (0, 1]: a fraction of the image's shorter side";
  } else {
    return merging.IsValid(error);
  }
  return false;
}

LineExtractor::LineExtractor(const LineExtractorOptions& options)
    : options_(options), detectors_(std::make_unique<Detectors>()) {
  std::string error;
  if (!options.IsValid(&error)) throw std::invalid_argument("LineExtractor: " + error);
  if (options.detector == LineDetector::kLsd) {
    detectors_->lsd = cv::createLineSegmentDetector(cv::LSD_REFINE_STD);
  } else {
    detectors_->edge_drawing = cv::ximgproc::createEdgeDrawing();
  }
  cv::line_descriptor::BinaryDescriptor::Params lbd;
  lbd.widthOfBand_ = kBandWidth;
  detectors_->lbd = cv::line_descriptor::BinaryDescriptor::createBinaryDescriptor(lbd);
}

LineExtractor::~LineExtractor() = default;

std::vector<LineFeature> LineExtractor::Extract(const cv::Mat& gray, const cv::Mat& mask) {
  if (gray.empty() || gray.type() != CV_8UC1) {
    throw std::invalid_argument("LineExtractor: the image must be 8-bit grey (CV_8UC1)");
  }
  std::vector<LineSegment2> pieces;
  for (const cv::Vec4f& line : detectors_->Detect(options_.detector, gray)) {
    LineSegment2 segment{Vector2d(line[0], line[1]), Vector2d(line[2], line[3])};
    if (segment.Length() < kMinPiece || !ClipToMask(mask, &segment)) continue;
    OrientToBrighterSide(gray, &segment);
    pieces.push_back(segment);
  }
  const double min_length = options_.min_length * std::min(gray.cols, gray.rows);
  std::vector<LineFeature> features;
  for (const LineSegment2& segment : MergeCollinear(options_.merging, std::move(pieces))) {
    if (segment.Length() < min_length) break;  // longest first
    if (static_cast<int>(features.size()) == options_.max_lines) break;
    LineFeature feature;
    feature.segment = segment;
    if (options_.detector == LineDetector::kEdgeDrawing) RefineSegment(gray, &feature.segment);
    features.push_back(feature);
  }
  detectors_->Describe(gray, &features);
  return features;
}

}  // namespace msc_vo
