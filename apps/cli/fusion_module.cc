// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/cli/fusion_module.h"

#include <filesystem>
#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace msc_vo {

namespace {

constexpr char kFile[] = "msc_vo_fusion.so";

// The module in the build folder or where it is installed, both relative to the program; empty if
// there is none.
std::string FindModule() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  for (const char* folder : {".", MSC_VO_MODULE_FOLDER}) {
    const std::filesystem::path path = program.parent_path() / folder / kFile;
    if (std::filesystem::exists(path, error)) return path.string();
  }
  return "";
}

}  // namespace

std::unique_ptr<SurfaceFusion> LoadSurfaceFusion(const SurfaceFusionOptions& options) {
  const std::string path = FindModule();
  if (path.empty()) {
    throw std::runtime_error(
        std::string("the module ") + kFile +
        " is not installed: install the package msc-vo-fusion, or libopen3d-dev and build again");
  }
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // stays loaded
  if (module == nullptr) throw std::runtime_error(path + ": " + dlerror());
  const auto make = reinterpret_cast<MakeSurfaceFusion>(dlsym(module, kMakeSurfaceFusion));
  if (make == nullptr) throw std::runtime_error(path + ": is not the module of this msc_vo");
  return std::unique_ptr<SurfaceFusion>(make(options));
}

}  // namespace msc_vo
