// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/tum_writer.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <vector>

#include <opencv2/imgcodecs.hpp>

#include "msc_vo/datasets/camera_file.h"
#include "msc_vo/image_files/opencv_codecs.h"
#include "msc_vo/text/files.h"
#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace fs = std::filesystem;

namespace {

// The folder, created with rgb/ and depth/.
std::string PrepareFolder(const std::string& folder, const Calibration& calibration) {
  std::string error;
  if (!IsValidDepthScale(calibration.depth_scale, &error)) throw std::invalid_argument(error);
  if (HasEntry(folder) && !ListFolder(folder).empty()) {
    throw std::runtime_error(folder + ": is not empty; give another folder for the recording");
  }
  for (const char* images : {"rgb", "depth"}) MakeFolder(PathIn(folder, images));
  return folder;
}

// Raw depth; what is not finite, not positive or too far becomes 0.
cv::Mat ToRawDepth(const cv::Mat& metres, double depth_scale) {
  cv::Mat raw;
  cv::Mat clean = metres.clone();
  clean.setTo(0.0f, ~((metres > 0.0f) & (metres < static_cast<float>(65535.0 / depth_scale))));
  clean.convertTo(raw, CV_16U, depth_scale);  // rounds
  return raw;
}

std::string EncodePng(const cv::Mat& image, const std::string& name) {
  // Level 1, because the camera does not wait.
  std::string bytes;
  if (!image.empty()) bytes = EncodeWithOpenCv(".png", image, {cv::IMWRITE_PNG_COMPRESSION, 1});
  if (bytes.empty()) throw std::runtime_error(name + ": cannot be encoded as PNG");
  return bytes;
}

const char* ExtensionOf(const StoredImage& image) {
  return image.bytes.compare(0, 2, "\xFF\xD8") == 0 ? ".jpg" : ".png";
}

}  // namespace

TumWriter::List::List(const std::string& path, const std::string& header)
    : path_(path), file_(path) {
  Append(header);
}

void TumWriter::List::Append(const std::string& line) {
  try {
    file_.Append(line);
  } catch (const std::runtime_error&) {
    TruncateTo(size_);
    throw;
  }
  size_ += line.size();
}

void TumWriter::List::TruncateTo(size_t size) {
  std::error_code ignored;  // the disk already reports an error
  fs::resize_file(path_, size, ignored);
  size_ = size;
}

TumWriter::TumWriter(const std::string& folder, const Calibration& calibration,
                     const std::string& comment)
    : folder_(PrepareFolder(folder, calibration)),
      depth_scale_(calibration.depth_scale),
      color_list_(PathIn(folder, "rgb.txt"), "# timestamp filename\n"),
      depth_list_(PathIn(folder, "depth.txt"), "# timestamp filename\n"),
      associations_(PathIn(folder, "associations.txt"),
                    "# timestamp filename timestamp filename\n") {
  WriteFile(PathIn(folder, "camera.txt"), FormatCameraFile(calibration, comment));
}

void TumWriter::Add(double color_time, double depth_time, const StoredImage& color,
                    const StoredImage& depth, const cv::Mat& mask) {
  const std::string color_stamp = FormatText("%.6f", color_time);
  const std::string depth_stamp = FormatText("%.6f", depth_time);
  const std::string color_name = "rgb/" + color_stamp + ExtensionOf(color);
  const std::string depth_name = "depth/" + depth_stamp + ".png";
  const cv::Mat raw =
      depth.pixels.type() == CV_32FC1 ? ToRawDepth(depth.pixels, depth_scale_) : depth.pixels;
  WriteFile(PathIn(folder_, color_name),
            color.bytes.empty() ? EncodePng(color.pixels, color_name) : color.bytes);
  WriteFile(PathIn(folder_, depth_name),
            depth.bytes.empty() ? EncodePng(raw, depth_name) : depth.bytes);
  if (!mask.empty()) {
    const std::string mask_name = "mask/" + color_stamp + ".png";
    MakeFolder(PathIn(folder_, "mask"));
    WriteFile(PathIn(folder_, mask_name), EncodePng(mask, mask_name));
  }
  AppendLines(color_stamp + " " + color_name, depth_stamp + " " + depth_name);
  ++num_pairs_;
}

void TumWriter::AppendLines(const std::string& color_line, const std::string& depth_line) {
  List* const lists[] = {&color_list_, &depth_list_, &associations_};
  const std::string lines[] = {color_line + "\n", depth_line + "\n",
                               color_line + " " + depth_line + "\n"};
  const size_t sizes[] = {lists[0]->size(), lists[1]->size(), lists[2]->size()};
  try {
    for (int i = 0; i < 3; ++i) lists[i]->Append(lines[i]);
  } catch (const std::runtime_error&) {
    for (int i = 0; i < 3; ++i) lists[i]->TruncateTo(sizes[i]);
    throw;
  }
}

}  // namespace msc_vo
