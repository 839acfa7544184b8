// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/modules.h"

#include <filesystem>
#include <string>
#include <system_error>

#include "apps/modules/module_function.h"

namespace msc_vo {

namespace {

constexpr char kInstallVideo[] =
    "install the package msc-vo completely, or libopencv-videoio-dev and build again";

// Modules are in the build folder or where they are installed, both relative to the program.
void* LoadFunction(const std::string& file, const char* function, const std::string& fix) {
  std::error_code ignored;
  const std::filesystem::path folder =
      std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  return LoadModuleFunction({folder, folder / MSC_VO_MODULE_FOLDER}, file, function, fix);
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
