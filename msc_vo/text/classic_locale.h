// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <locale.h>

namespace msc_vo {

/// While it lives, the functions of the C library that this thread calls format numbers and
/// describe errors as in the "C" locale, whatever the program has given to setlocale().
class ClassicLocale {
 public:
  ClassicLocale() : previous_(uselocale(Classic())) {}
  ~ClassicLocale() { uselocale(previous_); }
  ClassicLocale(const ClassicLocale&) = delete;
  ClassicLocale& operator=(const ClassicLocale&) = delete;

 private:
  static locale_t Classic() {
    static const locale_t classic = newlocale(LC_ALL_MASK, "C", nullptr);
    return classic;
  }

  locale_t previous_;
};

}  // namespace msc_vo
