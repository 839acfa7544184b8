// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/odometry/option.h"

#include <sstream>
#include <type_traits>

#include "msc_vo/odometry/option_lister.h"

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

// Ten digits are enough to tell any int and every limit.
std::string FormatValue(double value) {
  std::ostringstream text;
  text.precision(10);
  text << value;
  return text.str();
}

}  // namespace

std::string ToString(const Range& range) {
  return "from " + FormatValue(range.min) + " to " + FormatValue(range.max);
}

std::optional<double> NumberOf(const Option& option) {
  return std::visit(NumberReader{}, option.value);
}

bool AreInRange(const std::vector<Option>& options, std::string* error) {
  for (const Option& option : options) {
    const std::optional<double> value = NumberOf(option);
    if (!option.range || !value || option.range->Contains(*value)) continue;
    *error = option.path + " = " + FormatValue(*value) + " must be " + ToString(*option.range) +
             " (" + option.help + ")";
    return false;
  }
  return true;
}

std::vector<Option> ListOptions(OdometryOptions* options) {
  OptionLister list;
  list.AddChoice("mode", &options->mode, {"pl-vo", "pl-vo-depth", "msc-vo"},
                 "what of the method is used; each adds to the one before");
  list.Add("use_points", &options->use_points, "off: lines alone");
  list.Add("use_lines", &options->use_lines, "off: points alone");
  list.Add("align_depth", &options->align_depth,
           "move depth images to the time of their colour image where the two stamps differ");
  list.Add("threads", &options->threads, {1, 256},
           "processors to make use of; the result is the same for any number");
  list.Add("realtime", &options->snapshots.realtime,
           "no frame waits for a map that is late; runs repeat as long as none is");
  list.Section("features", &options->features, ListFeatures);
  list.Section("normals", &options->normals, ListNormals);
  list.Section("tracking", &options->tracking, ListTracking);
  list.Add("mapping.insertion_latency_frames", &options->snapshots.insertion_latency_frames,
           {0, 1000}, "frames from a keyframe to the first that sees its new landmarks");
  list.Add("mapping.latency_frames", &options->snapshots.latency_frames, {0, 1000},
           "frames from a keyframe to the first that sees the map refined with it");
  list.Section("mapping", &options->mapping, ListMapping);
  return list.Take();
}

}  // namespace msc_vo
