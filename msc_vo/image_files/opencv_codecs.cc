// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/image_files/opencv_codecs.h"

#include <stdexcept>
#include <type_traits>

#include <dlfcn.h>
#include <opencv2/imgcodecs.hpp>

namespace msc_vo {

namespace {

// The functions by their names in the library (Itanium C++ ABI).
using Decode = cv::Mat (*)(cv::InputArray, int);
using Encode = bool (*)(const cv::String&, cv::InputArray, std::vector<uchar>&,
                        const std::vector<int>&);
static_assert(std::is_same_v<decltype(static_cast<Decode>(&cv::imdecode)), Decode>);  // overloaded
static_assert(std::is_same_v<decltype(&cv::imencode), Encode>);
constexpr char kDecode[] = "_ZN2cv8imdecodeERKNS_11_InputArrayEi";
constexpr char kEncode[] =
    "_ZN2cv8imencodeERKNSt7__cxx1112basic_stringIcSt11char_traitsIcESaIcEEERKNS_11_InputArrayE"
    "RSt6vectorIhSaIhEERKSB_IiSaIiEE";

void* FindFunction(const char* name) {
  static void* const library = dlopen(MSC_VO_OPENCV_CODECS, RTLD_LAZY | RTLD_LOCAL);  // stays
  void* const function = library != nullptr ? dlsym(library, name) : nullptr;
  if (function == nullptr) {
    const char* const reason = dlerror();
    throw std::runtime_error(
        std::string("cannot load " MSC_VO_OPENCV_CODECS) +
        (reason != nullptr ? std::string(": ") + reason : "") +
        "; install the image formats of OpenCV (Debian: libopencv-imgcodecs-dev)");
  }
  return function;
}

}  // namespace

cv::Mat DecodeWithOpenCv(const std::string& bytes, int mode) {
  static const auto decode = reinterpret_cast<Decode>(FindFunction(kDecode));
  const cv::Mat buffer(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
  return decode(buffer, mode);
}

std::string EncodeWithOpenCv(const std::string& extension, const cv::Mat& image,
                             const std::vector<int>& parameters) {
  static const auto encode = reinterpret_cast<Encode>(FindFunction(kEncode));
  std::vector<uchar> bytes;
  if (!encode(extension, image, bytes, parameters)) return "";
  return {bytes.begin(), bytes.end()};
}

}  // namespace msc_vo
