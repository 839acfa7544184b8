// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/image_files/jpeg_image.h"

#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <turbojpeg.h>

#include "msc_vo/image_files/image_header.h"

namespace msc_vo {

namespace {

struct DestroyTurboJpeg {
  void operator()(tjhandle handle) const { tjDestroy(handle); }
};
using TurboJpeg = std::unique_ptr<std::remove_pointer_t<tjhandle>, DestroyTurboJpeg>;

// Whether the last result of a decoder is more than a warning: warnings are of stray bytes and
// unusual numbers, which some cameras write.
bool HasFailed(tjhandle decoder, int result) {
  return result != 0 && tjGetErrorCode(decoder) != TJERR_WARNING;
}

// Whether the last error of a decoder was lack of memory, in the words of libjpeg.
bool HasNoMemory(tjhandle decoder) {
  return std::string(tjGetErrorStr2(decoder)).find("nsufficient memory") != std::string::npos;
}

}  // namespace

cv::Mat DecodeJpeg(const std::string& bytes, JpegChannels channels) {
  const auto* const data = reinterpret_cast<const unsigned char*>(bytes.data());
  const TurboJpeg decoder(tjInitDecompress());
  int width, height, subsampling, colors;
  if (decoder == nullptr) throw std::bad_alloc();
  const int header = tjDecompressHeader3(decoder.get(), data, bytes.size(), &width, &height,
                                         &subsampling, &colors);
  if (HasFailed(decoder.get(), header)) return {};
  if (colors == TJCS_CMYK || colors == TJCS_YCCK) return {};
  if (!IsPlausibleSize({width, height}, bytes.size())) return {};
  const bool is_gray = channels == JpegChannels::kGray || colors == TJCS_GRAY;
  cv::Mat image(height, width, is_gray ? CV_8UC1 : CV_8UC3);
  const int pixels =
      tjDecompress2(decoder.get(), data, bytes.size(), image.data, width,
                    static_cast<int>(image.step), height, is_gray ? TJPF_GRAY : TJPF_BGR, 0);
  if (!HasFailed(decoder.get(), pixels)) return image;
  if (HasNoMemory(decoder.get())) throw std::bad_alloc();
  return {};
}

std::string EncodeJpeg(const cv::Mat& gray, int quality) {
  const TurboJpeg encoder(tjInitCompress());
  unsigned char* data = nullptr;
  unsigned long num_bytes = 0;
  const int failure = tjCompress2(encoder.get(), gray.data, gray.cols, static_cast<int>(gray.step),
                                  gray.rows, TJPF_GRAY, &data, &num_bytes, TJSAMP_GRAY, quality, 0);
  const std::unique_ptr<unsigned char, decltype(&tjFree)> owner(data, &tjFree);
  if (failure != 0) throw std::runtime_error("JPEG: " + std::string(tjGetErrorStr2(encoder.get())));
  return {data, data + num_bytes};
}

}  // namespace msc_vo
