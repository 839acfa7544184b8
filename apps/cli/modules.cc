// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/modules.h"

#include <filesystem>
#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace msc_vo {

namespace {

constexpr char kVideoModule[] = "msc_vo_video.so";
constexpr char kInstallVideo[] =
    "install the package msc-vo completely, or libopencv-videoio-dev and build again";

// A module in the build folder or where it is installed, both relative to the program; empty if
// there is none.
std::string FindModule(const std::string& file) {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (const char* folder : {".", MSC_VO_MODULE_FOLDER}) {
    const std::filesystem::path path = program.parent_path() / folder / file;
    if (std::filesystem::exists(path, error)) return path.string();
  }
  return "";
}

// Returns the factory function of a module.
void* LoadFunction(const std::string& file, const char* function, const std::string& fix) {
  const std::string path = FindModule(file);
  if (path.empty()) throw std::runtime_error("the module " + file + " is not installed: " + fix);
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays loaded
  if (module == nullptr) throw std::runtime_error(path + ": " + dlerror());
  void* const make = dlsym(module, function);
  if (make == nullptr) throw std::runtime_error(path + ": is not the module of this msc_vo");
  return make;
}

}  // namespace

std::unique_ptr<SurfaceFusion> LoadSurfaceFusion(const SurfaceFusionOptions& options) {
  const auto make = reinterpret_cast<MakeSurfaceFusion>(
      LoadFunction("msc_vo_fusion.so", kMakeSurfaceFusion,
                   "install the package msc-vo-fusion, or libopen3d-dev and build again"));
  return std::unique_ptr<SurfaceFusion>(make(options));
}

std::unique_ptr<VideoFile> LoadVideoFile() {
  const auto make =
      reinterpret_cast<MakeVideoFile>(LoadFunction(kVideoModule, kMakeVideoFile, kInstallVideo));
  return std::unique_ptr<VideoFile>(make());
}

std::unique_ptr<VideoReader> LoadVideoReader() {
  const auto make = reinterpret_cast<MakeVideoReaderOfModule>(
      LoadFunction(kVideoModule, kMakeVideoReader, kInstallVideo));
  return std::unique_ptr<VideoReader>(make());
}

}  // namespace msc_vo
