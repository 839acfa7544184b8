// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Preloaded, this ends a program as soon as Ceres calls SuiteSparse or CXSparse. CHOLMOD, and
// SuiteSparseQR on top of it, cannot be used before one of the first two functions is called; Ceres
// does not use CXSparse without the others.

#include <cstdio>
#include <cstdlib>

namespace {

[[noreturn]] void Refuse(const char* function) {
  std::fprintf(stderr, "%s was called, which a Ceres without SuiteSparse does not have\n",
               function);
  std::_Exit(77);
}

}  // namespace

extern "C" {
int cholmod_start(void*) { Refuse("cholmod_start"); }
int cholmod_l_start(void*) { Refuse("cholmod_l_start"); }
void* cs_di_compress(const void*) { Refuse("cs_di_compress"); }
void* cs_di_schol(int, const void*) { Refuse("cs_di_schol"); }
}
