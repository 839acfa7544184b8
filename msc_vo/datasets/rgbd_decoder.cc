// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/rgbd_decoder.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/datasets/clipped_depth_search.h"
#include "msc_vo/datasets/image_masks.h"
#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/geometry/quantile.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/sensor/depth_units.h"
#include "msc_vo/sensor/image_mask.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

// Throws "PATH (named in rgb.txt:12): PROBLEM".
[[noreturn]] void Fail(const std::string& path, const SequenceEntry& entry,
                       const std::string& problem) {
  const std::string origin = entry.origin.empty() ? "" : " (named in " + entry.origin + ")";
  throw std::runtime_error(path + origin + ": " + problem);
}

std::string SizeText(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

bool IsJpeg(const std::string& bytes) { return bytes.compare(0, 2, "\xFF\xD8") == 0; }

bool IsPng(const std::string& bytes) { return bytes.compare(0, 4, "\x89PNG") == 0; }

std::string ReadImageBytes(const std::string& path, const SequenceEntry& entry) {
  const std::string problem = FileProblem(path, kMaxImageBytes);
  if (!problem.empty()) {
    Fail(path, entry, problem + "; restore the file, or correct or remove its line");
  }
  return ReadFile(path, kMaxImageBytes);
}

cv::Mat DecodeStored(const StoredImage& stored, const std::string& path,
                     const SequenceEntry& entry) {
  if (stored.bytes.empty() && !stored.pixels.empty()) return stored.pixels;
  // A JPEG stores luminance in a separate channel of 8 bits; decoding colours and converting them
  // to grey would take longer and round twice.
  const int mode = IsJpeg(stored.bytes) ? cv::IMREAD_GRAYSCALE : cv::IMREAD_UNCHANGED;
  cv::Mat image;
  try {
    image = DecodeImage(stored.bytes, mode | cv::IMREAD_IGNORE_ORIENTATION);
  } catch (const std::runtime_error& error) {  // a format that is not read
    Fail(path, entry, error.what());
  }
  if (image.empty()) {
    Fail(path, entry,
         "is damaged, truncated or not an image (" + std::to_string(stored.bytes.size()) +
             " bytes); restore the file");
  }
  return image;
}

std::string TypeText(const cv::Mat& image) {
  const int bits = static_cast<int>(8 * image.elemSize1());
  const bool is_signed =
      image.depth() == CV_8S || image.depth() == CV_16S || image.depth() == CV_32S;
  return std::to_string(image.channels()) + " channel" + (image.channels() == 1 ? "" : "s") +
         " of " + (is_signed ? "signed " : "") + std::to_string(bits) + " bits";
}

cv::Mat ToGray(const cv::Mat& image) {
  cv::Mat gray;
  switch (image.channels()) {
    case 1:
      return image;
    case 3:
      cv::cvtColor(image, gray, cv::COLOR_BGR2GRAY);
      return gray;
    default:
      cv::cvtColor(image, gray, cv::COLOR_BGRA2GRAY);
      return gray;
  }
}

// The largest value of 16 bits: a mark for no measurement, or the end of the range.
constexpr int kSaturated = std::numeric_limits<uint16_t>::max();

cv::Mat ToMetres(const cv::Mat& raw, double depth_scale, const DepthLimits& limits) {
  cv::Mat metres;
  if (raw.type() == CV_32FC1) {
    metres = raw.clone();
    metres.setTo(0.0f, ~((raw > 0.0f) & (raw <= std::numeric_limits<float>::max())));
  } else {
    raw.convertTo(metres, CV_32F, 1.0 / depth_scale);
    metres.setTo(0.0f, raw == kSaturated);
  }
  if (limits.HasNearest()) metres.setTo(0.0f, raw <= limits.nearest);
  if (limits.HasFarthest()) metres.setTo(0.0f, raw >= limits.farthest);
  return metres;
}

// The median of the pixels that are measured, of every 7th in both directions; 0: there is none.
double MedianMeasured(const cv::Mat& metres) {
  constexpr int kStep = 7;
  std::vector<float> values;
  for (int y = 0; y < metres.rows; y += kStep) {
    for (int x = 0; x < metres.cols; x += kStep) {
      const float z = metres.at<float>(y, x);
      if (z > 0.0f) values.push_back(z);
    }
  }
  return values.empty() ? 0.0 : UpperMedian(std::move(values));
}

void CheckFloatDepth(const cv::Mat& metres, const SequenceEntry& entry) {
  // The largest median depth that is taken for metres, as in the finding depth.scale.
  constexpr double kMaxMedianDepth = 40.0;
  const double median = MedianMeasured(metres);
  if (median <= kMaxMedianDepth) return;
  Fail(entry.depth_path, entry,
       "has floating-point numbers with a median of " + FormatNumber(median) +
           " metres, beyond any RGB-D camera; give their units per metre, "
           "--set camera.float_depth_scale=1000 for millimetres");
}

constexpr char kRegisterDepth[] =
    "register the depth to the colour image first, or describe the depth camera by a line "
    "depth_camera in camera.txt or the file of --camera-file, or by --set camera.depth_camera.NAME";

}  // namespace

RgbdDecoder::RgbdDecoder(SequenceIndex index, Calibration calibration)
    : index_(std::move(index)), calibration_(std::move(calibration)) {
  std::string error;
  if (!IsValidDepthScale(calibration_.depth_scale, &error)) throw std::invalid_argument(error);
  if (!calibration_.depth_camera) return;
  registration_ = std::make_shared<DepthRegistration>(*calibration_.depth_camera,
                                                      calibration_.camera, calibration_.distortion);
}

std::vector<std::string> RgbdDecoder::Warnings() const {
  std::vector<std::string> warnings = index_.warnings;
  for (const ClippingReport& report :
       DescribeClippedDepth(index_.clipped_depth, calibration_.depth_scale)) {
    warnings.push_back(report.text);
  }
  return warnings;
}

RgbdImage RgbdDecoder::Decode(int i) const {
  try {
    return DecodePair(i, ReadStored(i));
  } catch (const UnreadableImage&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw UnreadableImage(i, error.what());
  }
}

StoredImage RgbdDecoder::ReadStoredDepth(int i) const {
  const SequenceEntry& entry = index_.entries.at(i);
  if (index_.container) return index_.container->ReadDepth(entry.depth_index);
  return {ReadImageBytes(entry.depth_path, entry), {}};
}

StoredRgbd RgbdDecoder::ReadStored(int i) const {
  const SequenceEntry& entry = index_.entries.at(i);
  try {
    const StoredImage color = index_.container
                                  ? index_.container->ReadColor(entry.color_index)
                                  : StoredImage{ReadImageBytes(entry.color_path, entry), {}};
    return {color, ReadStoredDepth(i)};
  } catch (const std::runtime_error& error) {
    throw UnreadableImage(i, error.what());
  }
}

cv::Mat RgbdDecoder::DecodeRawDepth(int i) const {
  const SequenceEntry& entry = index_.entries.at(i);
  try {
    cv::Mat depth = DecodeDepth(ReadStoredDepth(i), entry).clone();
    CheckDepthType(depth, entry);
    if (index_.invalid_depth != 0) depth.setTo(0, depth == index_.invalid_depth);
    return depth;
  } catch (const std::runtime_error& error) {
    throw UnreadableImage(i, error.what());
  }
}

StoredRgbd RgbdDecoder::ReadForExport(int i) const {
  const SequenceEntry& entry = index_.entries.at(i);
  StoredRgbd stored = ReadStored(i);
  try {
    stored.mask = DecodePair(i, stored).mask;  // an image that cannot be decoded is not copied
    if (index_.scale_color) {
      cv::Mat color =
          stored.color.bytes.empty()
              ? stored.color.pixels
              : DecodeImage(stored.color.bytes, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
      const cv::Size size(calibration_.camera.width, calibration_.camera.height);
      cv::resize(color, color, size, 0.0, 0.0, cv::INTER_AREA);
      stored.color = {"", color};
    } else if (!IsPng(stored.color.bytes) && !IsJpeg(stored.color.bytes)) {
      stored.color = {"", DecodeStored(stored.color, entry.color_path, entry)};
    }
    const DepthLimits& limits = index_.clipped_depth.limits;
    const bool is_changed =
        index_.invalid_depth != 0 || limits.HasNearest() || limits.HasFarthest();
    if (is_changed || !IsPng(stored.depth.bytes)) {
      cv::Mat depth = DecodeDepth(stored.depth, entry).clone();
      if (index_.invalid_depth != 0) depth.setTo(0, depth == index_.invalid_depth);
      if (is_changed) limits.Apply(&depth);
      stored.depth = {"", depth};
    }
  } catch (const UnreadableImage&) {
    throw;
  } catch (const std::runtime_error& error) {
    throw UnreadableImage(i, error.what());
  }
  return stored;
}

RgbdImage RgbdDecoder::Convert(const CameraImage& image, int id) const {
  SequenceEntry entry;
  entry.timestamp = image.timestamp;
  entry.depth_delay = image.depth_delay;
  entry.color_path = index_.directory + " colour";
  entry.depth_path = index_.directory + " depth";
  return MakeImage(id, entry, image.color, image.depth);
}

RgbdImage RgbdDecoder::DecodePair(int i, const StoredRgbd& stored) const {
  const SequenceEntry& entry = index_.entries.at(i);
  const cv::Mat color = DecodeStored(stored.color, entry.color_path, entry);
  return MakeImage(i, entry, color, DecodeDepth(stored.depth, entry));
}

RgbdImage RgbdDecoder::MakeImage(int i, const SequenceEntry& entry, cv::Mat color,
                                 const cv::Mat& depth) const {
  if (color.type() == CV_16UC1 && depth.depth() == CV_8U) {
    Fail(entry.color_path, entry,
         "is a depth image and its partner is a colour image; swap the two columns or folders");
  }
  if (color.depth() != CV_8U || color.channels() == 2) {
    Fail(entry.color_path, entry,
         "has " + TypeText(color) + "; colour images need 8 bits and 1, 3 or 4 channels");
  }
  CheckDepthType(depth, entry);
  const cv::Size size(calibration_.camera.width, calibration_.camera.height);
  const ImageSize recorded_size{color.cols, color.rows};
  CheckDepthSize(depth, recorded_size, entry);
  if (index_.scale_color && color.cols > size.width && color.rows > size.height &&
      HaveSimilarShape(recorded_size, {size.width, size.height})) {
    cv::resize(color, color, size, 0.0, 0.0, cv::INTER_AREA);
  }
  CheckColorSize(color, depth, entry);
  RgbdImage image;
  image.id = i;
  image.timestamp = entry.timestamp;
  image.depth_delay = entry.depth_delay;
  image.gray = ToGray(color);
  image.depth = ToMetres(depth, calibration_.depth_scale, index_.clipped_depth.limits);
  if (depth.type() == CV_32FC1) CheckFloatDepth(image.depth, entry);
  if (registration_) {
    image.recorded_depth = image.depth;
    const std::string error = DepthUnitsError(image.recorded_depth);
    if (!error.empty()) Fail(entry.depth_path, entry, error + "; correct camera.depth_scale");
    image.depth = registration_->Register(image.recorded_depth);
  }
  if (index_.masks) {
    cv::Mat mask = index_.masks->Read(entry.color_path, recorded_size);
    if (index_.container) mask = index_.container->AlignMask(entry.color_index, mask);
    image.mask = ScaledMask(mask, image.gray.size());
    RemoveMaskedDepth(&image);
  }
  return image;
}

cv::Mat RgbdDecoder::DecodeDepth(const StoredImage& stored, const SequenceEntry& entry) const {
  cv::Mat depth = DecodeStored(stored, entry.depth_path, entry);
  if (depth.depth() != CV_32F && depth.depth() != CV_64F) return depth;
  cv::Mat metres;  // `depth` may be the stored pixels
  depth.convertTo(metres, CV_32F, 1.0 / index_.float_depth_scale);
  return metres;
}

void RgbdDecoder::CheckDepthType(const cv::Mat& depth, const SequenceEntry& entry) const {
  if (depth.type() == CV_16UC1 || depth.type() == CV_32FC1) return;
  const bool may_be_measured = depth.channels() == 1 && depth.elemSize1() > 1;
  Fail(entry.depth_path, entry,
       "has " + TypeText(depth) +
           "; depth images need 1 channel of unsigned 16 bits or of floating-point numbers" +
           (may_be_measured ? "; convert them"
                            : " (a visualisation of the depth does not contain the measurements)"));
}

void RgbdDecoder::CheckDepthSize(const cv::Mat& depth, const ImageSize& color,
                                 const SequenceEntry& entry) const {
  const bool has_depth_camera = calibration_.depth_camera.has_value();
  const PinholeCamera& camera =
      has_depth_camera ? calibration_.depth_camera->camera : calibration_.camera;
  if (depth.cols == camera.width && depth.rows == camera.height) return;
  const bool is_of_color =
      !has_depth_camera && color.width == camera.width && color.height == camera.height;
  Fail(entry.depth_path, entry,
       "is " + SizeText(depth.cols, depth.rows) + ", but the " +
           (has_depth_camera ? "depth camera" : "camera") + " is " +
           SizeText(camera.width, camera.height) + " (" + calibration_.origin + "); " +
           (is_of_color ? kRegisterDepth : "give the calibration of these images"));
}

void RgbdDecoder::CheckColorSize(const cv::Mat& color, const cv::Mat& depth,
                                 const SequenceEntry& entry) const {
  const PinholeCamera& camera = calibration_.camera;
  if (color.cols == camera.width && color.rows == camera.height) return;
  const std::string size = "is " + SizeText(color.cols, color.rows);
  if (calibration_.depth_camera) {
    Fail(entry.color_path, entry,
         size + ", but the camera is " + SizeText(camera.width, camera.height) + " (" +
             calibration_.origin + "); give the calibration of these images");
  }
  Fail(entry.color_path, entry,
       size + ", but its depth image " + entry.depth_path + " is " +
           SizeText(depth.cols, depth.rows) + "; " + kRegisterDepth);
}

}  // namespace msc_vo
