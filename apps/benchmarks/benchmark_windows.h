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

// A window by name, made or read when it is first asked for.
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

// A made window: so many free keyframes (three fixed ones behind them), per free keyframe 150
// points and, unless there are only points, 15 lines of a furnished room, fewer if it has no more;
// with structure, every line is bound to the next four that are parallel and the next four that are
// perpendicular to it. That is harder than what a map gives, where pairs lead to a few well-known
// lines.
WindowPtr MadeWindow(WindowContent content, int num_keyframes);

// The window files that the environment variable MSC_VO_WINDOWS names, with colons between. Throws
// std::runtime_error, naming the file, on one that cannot be read.
std::vector<WindowPtr> RecordedWindows();

}  // namespace msc_vo
