// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option.h"

#include "msc_vo/odometry/option_lister.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

struct NumberReader {
  std::optional<double> operator()(int* value) const { return *value; }
  std::optional<double> operator()(double* value) const { return *value; }
  std::optional<double> operator()(std::optional<int>* value) const { return *value; }
  std::optional<double> operator()(std::optional<double>* value) const { return *value; }
  template <typename T>
  std::optional<double> operator()(const T& /* no number */) const {
    return std::nullopt;
  }
};

// Ten digits represent every int and every limit of a range exactly.
std::string FormatValue(double value) { return FormatText("%.10g", value); }

void ListGeneral(OdometryOptions* options, OptionLister* list) {
  list->AddChoice("mode", &options->mode,
                  {ToString(Mode::kPlVo), ToString(Mode::kPlVoDepth), ToString(Mode::kMscVo)},
                  "Parts of the method. pl-vo: points and lines. pl-vo-depth: also robust depth of "
                  "lines. msc-vo: also structural constraints, and planes.")
      .MakeBasic("Choose a simpler mode for comparison.");
  list->Add("use_points", &options->use_points, "Use point features.")
      .MakeBasic("Disable to estimate the motion from lines only.");
  list->Add("use_lines", &options->use_lines, "Use line features.")
      .MakeBasic("Disable to estimate the motion from points only.");
  list->Add("use_planes", &options->features.extract_planes,
            "In mode msc-vo, use planes of the depth images as landmarks.");
  list->Add("close_loops", &options->tracking.find_loops,
            "Recognise places that were left, and correct the map when the camera returns.");
  list->Add("align_depth", &options->align_depth,
            "Warp each depth image to the time of its colour image if their time stamps differ.")
      .MakeBasic("Disable if the time stamps of the depth images are wrong.");
  list->Add("threads", &options->threads, {1, 256, "threads"},
            "1: all stages in sequence. 2 or more: mapping in parallel with tracking, and "
            "that many threads for the features of an image, ten at most. The result does not "
            "depend on it.")
      .MakeBasic("Set to 1 if the process may use one processor only.");
  list->Add("external_mapping", &options->external_mapping,
            "Local mapping runs when the program that embeds the odometry calls RunMapping(), and "
            "when a frame needs its map. The result does not depend on it.");
  list->Add("realtime", &options->snapshots.realtime,
            "Process images at the pace of their time stamps, drop late images, and never wait for "
            "a late map. A run is repeatable as long as no map is late.")
      .MakeBasic("Enable to measure latency as with a live camera.");
}

}  // namespace

std::string ToString(const Range& range) {
  if (!range.IsBounded()) return range.unit;
  return FormatValue(range.min) + " to " + FormatValue(range.max) +
         (range.unit.empty() ? "" : " " + range.unit);
}

std::optional<double> NumberOf(const Option& option) {
  return std::visit(NumberReader{}, option.value);
}

bool AreInRange(const std::vector<Option>& options, std::string* error) {
  for (const Option& option : options) {
    const std::optional<double> value = NumberOf(option);
    if (!option.range || !value || option.range->Contains(*value)) continue;
    *error = option.path + " = " + FormatValue(*value) + " must be from " + ToString(*option.range);
    return false;
  }
  return true;
}

std::vector<Option> ListOptions(OdometryOptions* options) {
  OptionLister list;
  ListGeneral(options, &list);
  list.Section("features", &options->features, ListFeatures);
  list.Add(
      "tracking.pose_refinement_delay", &options->pose_refinement_delay, {0, 60, "seconds"},
      "Time after which the pose of a frame is estimated again, in the map as optimised since, "
      "for the final trajectory; 0: never.");
  list.Section("tracking", &options->tracking, ListTracking);
  list.Section("mapping", &options->snapshots, ListSnapshots);
  list.Section("mapping", &options->mapping, ListMapping);
  return list.Take();
}

}  // namespace msc_vo
