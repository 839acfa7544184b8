// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/ros_image.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <stdexcept>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "msc_vo/datasets/image_size_fit.h"
#include "msc_vo/image_files/image_file.h"
#include "msc_vo/ros_bag/rvl.h"

namespace msc_vo {

namespace {

constexpr int kNoConversion = -1;
constexpr char kMetres[] = "32FC1";             // the encoding of depth in metres
constexpr char kEquidistant[] = "equidistant";  // the fisheye model in a CameraInfo

struct Encoding {
  RosImageKind kind;
  int type;        // of OpenCV
  int conversion;  // to BGR
};

const std::map<std::string, Encoding>& Encodings() {
  static const std::map<std::string, Encoding> encodings = {
      {"mono8", {RosImageKind::kGray, CV_8UC1, kNoConversion}},
      {"8UC1", {RosImageKind::kGray, CV_8UC1, kNoConversion}},
      {"bgr8", {RosImageKind::kColor, CV_8UC3, kNoConversion}},
      {"8UC3", {RosImageKind::kColor, CV_8UC3, kNoConversion}},
      {"bgra8", {RosImageKind::kColor, CV_8UC4, cv::COLOR_BGRA2BGR}},
      {"rgb8", {RosImageKind::kColor, CV_8UC3, cv::COLOR_RGB2BGR}},
      {"rgba8", {RosImageKind::kColor, CV_8UC4, cv::COLOR_RGBA2BGR}},
      // OpenCV names a pattern by its second row.
      {"bayer_rggb8", {RosImageKind::kColor, CV_8UC1, cv::COLOR_BayerBG2BGR}},
      {"bayer_bggr8", {RosImageKind::kColor, CV_8UC1, cv::COLOR_BayerRG2BGR}},
      {"bayer_gbrg8", {RosImageKind::kColor, CV_8UC1, cv::COLOR_BayerGR2BGR}},
      {"bayer_grbg8", {RosImageKind::kColor, CV_8UC1, cv::COLOR_BayerGB2BGR}},
      // Two pixels share their colour.
      {"yuv422", {RosImageKind::kColor, CV_8UC2, cv::COLOR_YUV2BGR_UYVY}},
      {"uyvy", {RosImageKind::kColor, CV_8UC2, cv::COLOR_YUV2BGR_UYVY}},
      {"yuv422_yuy2", {RosImageKind::kColor, CV_8UC2, cv::COLOR_YUV2BGR_YUY2}},
      {"yuyv", {RosImageKind::kColor, CV_8UC2, cv::COLOR_YUV2BGR_YUY2}},
      {"16UC1", {RosImageKind::kDepth, CV_16UC1, kNoConversion}},
      {"mono16", {RosImageKind::kDepth, CV_16UC1, kNoConversion}},
      {kMetres, {RosImageKind::kDepth, CV_32FC1, kNoConversion}}};
  return encodings;
}

bool IsCompressedDepth(const std::string& format) {
  return format.find("compressedDepth") != std::string::npos;
}

// The encoding in front of the compression in the format of a compressed image.
std::string EncodingIn(const std::string& format) { return format.substr(0, format.find(';')); }

// Tests whether an image is a PNG with one channel of 16 bits.
bool IsGray16Png(std::string_view data) {
  constexpr size_t kBitsAt = 24, kColorTypeAt = 25;  // in the header
  return data.size() > kColorTypeAt && data.substr(1, 3) == "PNG" && data[kBitsAt] == 16 &&
         data[kColorTypeAt] == 0;
}

// The header in front of the PNG of compressedDepth: an enumeration and the parameters of the
// quantisation of depths in metres.
struct DepthHeader {
  int32_t format;
  float a;
  float b;
};
static_assert(sizeof(DepthHeader) == 12);

// Depth in metres from the quantised inverse depth: a / (value - b).
cv::Mat Dequantise(const cv::Mat& raw, const DepthHeader& header) {
  cv::Mat metres(raw.size(), CV_32FC1);
  for (int y = 0; y < raw.rows; ++y) {
    for (int x = 0; x < raw.cols; ++x) {
      const uint16_t value = raw.at<uint16_t>(y, x);
      metres.at<float>(y, x) =
          value == 0 ? 0.0f : header.a / (static_cast<float>(value) - header.b);
    }
  }
  return metres;
}

// Reverses the order of the bytes of each value.
void ReverseBytes(cv::Mat* image) {
  const size_t size = image->elemSize1();
  for (uint8_t* value = image->data; value < image->dataend; value += size) {
    std::reverse(value, value + size);
  }
}

StoredImage DecodeCompressedDepth(const RosCompressedImage& image) {
  DepthHeader header;
  if (image.data.size() <= sizeof(header)) {
    throw std::runtime_error("compressed depth image without data");
  }
  std::memcpy(&header, image.data.data(), sizeof(header));
  const std::string_view encoded = image.data.substr(sizeof(header));
  const bool is_metres = EncodingIn(image.format) == kMetres;
  const bool is_rvl = image.format.find("rvl") != std::string::npos;
  const cv::Mat raw =
      is_rvl ? DecodeRvl(encoded) : DecodeImage(std::string(encoded), cv::IMREAD_UNCHANGED);
  if (raw.type() != CV_16UC1) throw std::runtime_error("damaged compressed depth image");
  if (is_metres) return {"", Dequantise(raw, header)};
  return is_rvl ? StoredImage{"", raw} : StoredImage{std::string(encoded), {}};
}

// The model in the words of ROS. Recordings of the RealSense viewer have those of its library,
// which projects with all three of Brown and Conrady alike.
std::string ModelOf(const RosCameraInfo& info) {
  const std::string& model = info.distortion_model;
  if (model == "Kannala Brandt4") return kEquidistant;
  return model.find("Brown Conrady") == std::string::npos ? model : "plumb_bob";
}

// Lens of a CameraInfo; none if its model is unknown or has other coefficients.
std::optional<LensDistortion> RosLens(const RosCameraInfo& info) {
  const std::string model = ModelOf(info);
  LensDistortion lens;
  size_t size = 5;
  const auto has_beyond = [&info](size_t count) {
    return std::any_of(info.d.begin() + static_cast<long>(std::min(count, info.d.size())),
                       info.d.end(), [](double k) { return k != 0.0; });
  };
  if (model == kEquidistant) {
    lens.model = LensModel::kFisheye;
    size = 4;
    if (info.d.size() < size) return std::nullopt;
  } else if (model == "rational_polynomial" && has_beyond(size)) {
    lens.model = LensModel::kRational;
    size = 8;
  } else if (model != "plumb_bob" && model != "rational_polynomial") {
    return std::nullopt;
  }
  if (has_beyond(size)) return std::nullopt;
  for (size_t i = 0; i < std::min(size, info.d.size()); ++i) lens.k[i] = info.d[i];
  return lens;
}

// The camera of the region and the binned pixels of a CameraInfo.
PinholeCamera PublishedCamera(PinholeCamera camera, const RosCameraInfo& info) {
  if (info.roi_width > 0 && info.roi_height > 0) {
    camera.cx -= info.roi_x;
    camera.cy -= info.roi_y;
    camera.width = static_cast<int>(info.roi_width);
    camera.height = static_cast<int>(info.roi_height);
  }
  const auto binning = [](uint32_t pixels, int size) {  // of a damaged file, at most the image
    return static_cast<int>(std::clamp(pixels, 1u, static_cast<uint32_t>(std::max(size, 1))));
  };
  const int x = binning(info.binning_x, camera.width), y = binning(info.binning_y, camera.height);
  return x == 1 && y == 1 ? camera : ScaledCamera(camera, {camera.width / x, camera.height / y});
}

}  // namespace

RosImageKind KindOfEncoding(const std::string& encoding) {
  const auto found = Encodings().find(encoding);
  return found == Encodings().end() ? RosImageKind::kOther : found->second.kind;
}

RosImageKind KindOfCompressed(const RosCompressedImage& image) {
  if (IsCompressedDepth(image.format) || IsGray16Png(image.data)) return RosImageKind::kDepth;
  // "ENCODING; jpeg compressed ENCODING", or only "jpeg".
  switch (KindOfEncoding(EncodingIn(image.format))) {
    case RosImageKind::kGray:
      return RosImageKind::kGray;
    case RosImageKind::kDepth:
      return image.format.find("jpeg") == std::string::npos ? RosImageKind::kDepth
                                                            : RosImageKind::kOther;
    default:
      return RosImageKind::kColor;
  }
}

StoredImage ConvertRosImage(const RosImage& image) {
  const auto found = Encodings().find(image.encoding);
  if (found == Encodings().end()) {
    throw std::runtime_error("images of the encoding " + image.encoding + " cannot be read");
  }
  const Encoding& encoding = found->second;
  const size_t row_bytes = static_cast<size_t>(image.width) * CV_ELEM_SIZE(encoding.type);
  if (image.width == 0 || image.height == 0 || image.step < row_bytes ||
      image.step % CV_ELEM_SIZE1(encoding.type) != 0 ||
      (encoding.type == CV_8UC2 && image.width % 2 != 0) ||
      image.data.size() / image.step < image.height) {
    throw std::runtime_error("damaged image: its size does not fit its data");
  }
  const cv::Mat view(static_cast<int>(image.height), static_cast<int>(image.width), encoding.type,
                     const_cast<char*>(image.data.data()), image.step);
  cv::Mat pixels;
  if (encoding.conversion == kNoConversion) {
    pixels = view.clone();
    if (image.is_big_endian) ReverseBytes(&pixels);
  } else {
    cv::cvtColor(view, pixels, encoding.conversion);
  }
  return {"", pixels};
}

StoredImage ConvertRosImage(const RosCompressedImage& image) {
  if (IsCompressedDepth(image.format)) return DecodeCompressedDepth(image);
  if (EncodingIn(image.format) == kMetres) {  // TIFF
    return {"", DecodeImage(std::string(image.data), cv::IMREAD_UNCHANGED)};
  }
  return {std::string(image.data), {}};
}

std::optional<Calibration> CalibrationFrom(const RosCameraInfo& info, bool is_rectified,
                                           std::string* problem) {
  Calibration calibration;
  PinholeCamera& camera = calibration.camera;
  camera = {info.k[0],
            info.k[4],
            info.k[2],
            info.k[5],
            static_cast<int>(info.width),
            static_cast<int>(info.height)};
  if (is_rectified) {
    camera.fx = info.p[0];
    camera.fy = info.p[5];
    camera.cx = info.p[2];
    camera.cy = info.p[6];
  }
  if (camera.fx == 0.0 || camera.fy == 0.0) {
    *problem = "the camera is not calibrated";
    return std::nullopt;
  }
  camera = PublishedCamera(camera, info);
  const bool is_zero = std::all_of(info.d.begin(), info.d.end(), [](double k) { return k == 0.0; });
  if (is_rectified || (is_zero && ModelOf(info) != kEquidistant)) return calibration;
  const std::optional<LensDistortion> lens = RosLens(info);
  if (!lens) {
    *problem = "the lens model " + info.distortion_model + " with " +
               std::to_string(info.d.size()) +
               " coefficients is none of plumb_bob (at most 5 coefficients that are not 0), "
               "rational_polynomial (8) and equidistant (4)";
    return std::nullopt;
  }
  calibration.distortion = *lens;
  calibration.SetUndistorted();
  return calibration;
}

}  // namespace msc_vo
