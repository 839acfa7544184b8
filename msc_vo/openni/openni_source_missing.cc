// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The functions of openni_source.h in a build without the library OpenNI2.

#include <stdexcept>

#include "msc_vo/openni/openni_source.h"

namespace msc_vo {

namespace {

[[noreturn]] void Fail(const std::string& source) {
  throw std::runtime_error(
      source +
      ": this msc_vo was built without support for OpenNI2; install the Debian "
      "package libopenni2-dev and build it again");
}

}  // namespace

SequenceIndex OpenOniFile(const std::string& path) { Fail(path); }

SequenceIndex OpenOpenNiCamera(const std::string& uri) { Fail("openni2:" + uri); }

}  // namespace msc_vo
