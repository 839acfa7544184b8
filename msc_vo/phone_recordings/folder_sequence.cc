// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/phone_recordings/folder_sequence.h"

#include "msc_vo/phone_recordings/phone_formats.h"

namespace msc_vo {

namespace {

std::vector<SequenceFormat> PhoneFormats(const PhoneOptions& options) {
  return {StrayScannerFormat(options), PolycamFormat(options), ScannerAppFormat(options),
          VideoFolderFormat(options)};
}

}  // namespace

SequenceIndex OpenFolder(const std::string& directory, const std::string& format,
                         const PhoneOptions& options) {
  return OpenSequence(directory, format, PhoneFormats(options));
}

std::vector<std::string> FolderFormatNames() {
  std::vector<std::string> names = SequenceFormatNames();
  for (const SequenceFormat& format : PhoneFormats({})) names.push_back(format.name);
  return names;
}

}  // namespace msc_vo
