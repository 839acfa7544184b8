// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"

namespace msc_vo {

struct BenchmarkWindow {
  BundleAdjustmentOptions options;
  WindowData data;
};

/// A named window that is created or read at its first use.
class NamedWindow {
 public:
  NamedWindow(std::string name, std::function<BenchmarkWindow()> make)
      : name_(std::move(name)), make_(std::move(make)) {}

  const std::string& name() const { return name_; }
  const BenchmarkWindow& Get() const {
    if (!window_) window_ = make_();
    return *window_;
  }

 private:
  std::string name_;
  std::function<BenchmarkWindow()> make_;
  mutable std::optional<BenchmarkWindow> window_;
};
using WindowPtr = std::shared_ptr<const NamedWindow>;

enum class WindowContent { kPoints, kLines, kStructure };

/// A synthetic window of a furnished room: `num_keyframes` free keyframes and three fixed ones, and
/// per free keyframe 150 points and, unless the content is kPoints, up to 15 lines. With
/// kStructure, every line is paired with the next four parallel and the next four perpendicular
/// lines, which is harder than the windows of a map, where pairs concentrate on a few lines.
WindowPtr SyntheticBenchmarkWindow(WindowContent content, int num_keyframes);

/// The window files listed in the environment variable MSC_VO_WINDOWS, separated by colons. Throws
/// std::runtime_error, naming the file, if one cannot be read.
std::vector<WindowPtr> RecordedWindows();

}  // namespace msc_vo
