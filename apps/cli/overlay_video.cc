// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/overlay_video.h"

#include <array>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <opencv2/imgproc.hpp>

#include "apps/cli/modules.h"
#include "msc_vo/results/tracked_features.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

// Blue, green, red; in the order of LineColor, as in web/report.css and web/viewer.css.
const std::array<cv::Scalar, 5> kLineColors = {cv::Scalar(79, 83, 235), cv::Scalar(110, 190, 70),
                                               cv::Scalar(240, 150, 70), cv::Scalar(60, 200, 240),
                                               cv::Scalar(50, 130, 240)};
const cv::Scalar kPointColor(210, 216, 79);
constexpr int kFractionBits = 3;  // of the coordinates that cv::line takes
constexpr double kImageBrightness = 0.8;

cv::Point ToFixed(const Eigen::Vector2f& pixel) {
  constexpr float kScale = 1 << kFractionBits;
  return {cvRound(kScale * pixel.x()), cvRound(kScale * pixel.y())};
}

void DrawLabel(const FrameResult& frame, cv::Mat* image) {
  const std::string text =
      FormatText("frame %d  %s  %d points  %d lines", static_cast<int>(frame.id),
                 ToString(frame.status), frame.num_inlier_points, frame.num_inlier_lines);
  const double scale = image->cols / 1280.0;
  const cv::Point at(cvRound(16 * scale), image->rows - cvRound(18 * scale));
  for (const auto& [color, width] : {std::pair(cv::Scalar::all(0), 3), {cv::Scalar::all(255), 1}}) {
    cv::putText(*image, text, at, cv::FONT_HERSHEY_SIMPLEX, std::max(0.35, scale), color, width,
                cv::LINE_AA);
  }
}

}  // namespace

cv::Mat DrawFeatures(const cv::Mat& gray, const ViewedFeatures& features) {
  cv::Mat image;
  cv::cvtColor(gray, image, cv::COLOR_GRAY2BGR);
  image.convertTo(image, -1, kImageBrightness);
  for (const ViewedPoint& point : features.points) {
    const cv::Scalar& color =
        point.has_depth ? kPointColor : kLineColors[static_cast<size_t>(LineColor::kWithoutDepth)];
    cv::circle(image, ToFixed(point.pixel), 2 << kFractionBits, color, 1, cv::LINE_AA,
               kFractionBits);
  }
  for (const ViewedLine& line : features.lines) {
    cv::line(image, ToFixed(line.start), ToFixed(line.end),
             kLineColors[static_cast<size_t>(line.color)], 2, cv::LINE_AA, kFractionBits);
  }
  return image;
}

OverlayVideo::OverlayVideo(const std::string& path, double frame_rate, int width, int height,
                           const LensDistortion& distortion)
    : path_(path),
      partial_(path + ".partial.mp4"),  // the encoder chooses the format by the extension
      covered_(0, 0, width / 2 * 2, height / 2 * 2),
      distortion_(distortion) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty()) MakeFolder(folder.string());
  CheckWritable(path);
  video_ = LoadVideoFile();
  if (video_->Open(partial_, frame_rate, covered_.size())) return;
  RemovePartial();
  throw std::runtime_error(
      path +
      ": cannot be written as a video; check that the folder can be written, "
      "and that OpenCV has FFmpeg with an encoder for H.264 or MPEG-4, as that of Debian has");
}

void OverlayVideo::Add(const TrackedImage& tracked) {
  cv::Mat image = DrawFeatures(tracked.image.gray, TrackedFeatures(tracked, distortion_))(covered_);
  DrawLabel(tracked.result, &image);
  video_->Write(image);
  ++num_images_;
}

OverlayVideo::~OverlayVideo() {
  video_->Close();
  RemovePartial();
}

void OverlayVideo::RemovePartial() const {
  std::error_code ignored;
  std::filesystem::remove(partial_, ignored);
}

void OverlayVideo::Finish() {
  video_->Close();
  // The encoder does not say that it could not write.
  const bool is_whole = num_images_ == video_->CountImages(partial_);
  std::error_code error;
  if (is_whole) std::filesystem::rename(partial_, path_, error);
  if (is_whole && !error) return;
  throw std::runtime_error(path_ + ": the video could not be written; is the disk full?");
}

}  // namespace msc_vo
