// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace msc_vo {

/// Loads a module, a shared object that brings libraries which few runs need, and returns one of
/// its functions. `file` is looked for in `folders`. The module stays loaded. Throws
/// std::runtime_error that names the file and `fix` if it is in none of them, and if it is no
/// module of this program.
void* LoadModuleFunction(const std::vector<std::filesystem::path>& folders, const std::string& file,
                         const std::string& function, const std::string& fix);

}  // namespace msc_vo
