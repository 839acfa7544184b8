// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Window files (docs/window_file.md).

#include "tests/fuzz/input_folder.h"

#include "msc_vo/recording/window_file.h"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace msc_vo;
  static InputFolder folder;
  const std::string path = folder.Write("window.txt", AsText(data, size));
  RecordedWindow window;
  if (!Accepts(path, [&] { window = ReadWindow(path); })) return 0;
  const std::string text = FormatWindow(window.options, window.data);
  const RecordedWindow again = ReadWindow(folder.Write("copy.txt", text));
  Require(FormatWindow(again.options, again.data) == text, "what is written is read back");
  return 0;
}
