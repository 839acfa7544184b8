// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/modules/module_function.h"

#include <stdexcept>
#include <system_error>

#include <dlfcn.h>

namespace msc_vo {

namespace {

// Empty if there is none.
std::string FindModule(const std::vector<std::filesystem::path>& folders, const std::string& file) {
  std::error_code ignored;
  for (const std::filesystem::path& folder : folders) {
    if (std::filesystem::exists(folder / file, ignored)) return (folder / file).string();
  }
  return "";
}

}  // namespace

void* LoadModuleFunction(const std::vector<std::filesystem::path>& folders, const std::string& file,
                         const std::string& function, const std::string& fix) {
  const std::string path = FindModule(folders, file);
  if (path.empty()) throw std::runtime_error("the module " + file + " is not installed: " + fix);
  void* const module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) throw std::runtime_error(path + ": " + dlerror());
  void* const found = dlsym(module, function.c_str());
  if (found == nullptr) throw std::runtime_error(path + ": is not the module of this msc_vo");
  return found;
}

}  // namespace msc_vo
