// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "tests/fuzz/byte_reader.h"

#include "msc_vo/bundle_adjustment/local_bundle_adjustment.h"
#include "msc_vo/recording/window_record.h"

namespace msc_vo {

/// Collects pointers to the fields of window records.
struct FieldPointers {
  std::vector<double*> numbers;
  std::vector<int64_t*> ids;
  std::vector<int*> counts;
  std::vector<bool*> flags;

  void Number(const char* /*name*/, double& value) { numbers.push_back(&value); }
  void OptionalNumber(const char* /*name*/, double& value) { numbers.push_back(&value); }
  void Integer(const char* /*name*/, int64_t& value) { ids.push_back(&value); }
  void Integer(const char* /*name*/, int& value) { counts.push_back(&value); }
  void Flag(const char* /*if_false*/, const char* /*if_true*/, bool& value) {
    flags.push_back(&value);
  }
  void OptionalFlag(const char* /*if_true*/, bool& value) { flags.push_back(&value); }
};

/// Changes a window and the options of its bundle adjustment as the bytes of an input say: numbers,
/// ids, counts, flags and options are replaced, and items removed or repeated.
class WindowChanges {
 public:
  WindowChanges(const uint8_t* data, size_t size) : bytes_(data, size) {}

  void Apply(BundleAdjustmentOptions* options, WindowData* data) {
    constexpr int kMaxChanges = 24;
    for (int i = 0; i < kMaxChanges && !bytes_.AtEnd(); ++i) ApplyOne(options, data);
  }

 private:
  void ApplyOne(BundleAdjustmentOptions* options, WindowData* data) {
    FieldPointers fields = PointersTo(data);
    switch (bytes_.Below(8)) {
      case 0:
        ChangeOption(options);
        break;
      case 1:
        if (int64_t* id = Choose(fields.ids)) *id = NewId(fields.ids);
        break;
      case 2:
        if (int* count = Choose(fields.counts)) *count = static_cast<int>(bytes_.Integer());
        break;
      case 3:
        if (bool* flag = Choose(fields.flags)) *flag = !*flag;
        break;
      case 4:
        ChangeItems(data);
        break;
      default:
        if (double* number = Choose(fields.numbers)) *number = bytes_.NumberFor(*number);
    }
  }

  static FieldPointers PointersTo(WindowData* data) {
    FieldPointers fields;
    CameraRecord::Visit(data->camera, fields);
    ForEachWindowRecord([&](auto record) {
      using Record = decltype(record);
      for (auto& item : data->*Record::kItems) Record::Visit(item, fields);
    });
    return fields;
  }

  template <typename T>
  T* Choose(const std::vector<T*>& fields) {
    return fields.empty() ? nullptr : fields[bytes_.Below(fields.size())];
  }

  // The id of another item, mostly; an unknown one otherwise.
  int64_t NewId(const std::vector<int64_t*>& ids) {
    return bytes_.Below(4) == 0 ? bytes_.Integer() : *Choose(ids);
  }

  void ChangeItems(WindowData* data) {
    const size_t chosen = bytes_.Below(9);
    size_t kind = 0;
    ForEachWindowRecord([&](auto record) {
      using Record = decltype(record);
      auto& items = data->*Record::kItems;
      if (kind++ != chosen || items.empty()) return;
      const size_t action = bytes_.Below(4);
      const auto at = items.begin() + static_cast<std::ptrdiff_t>(bytes_.Below(items.size()));
      constexpr size_t kMaxItems = 64;
      if (action == 0) {
        items.clear();
      } else if (action == 1) {
        items.erase(at);
      } else if (items.size() < kMaxItems) {
        items.push_back(typename std::decay_t<decltype(items)>::value_type(*at));
      }
    });
  }

  void ChangeOption(BundleAdjustmentOptions* options) {
    TermOptions* const terms[] = {&options->point_reprojection, &options->point_depth,
                                  &options->line_reprojection,  &options->line_depth,
                                  &options->parallel,           &options->perpendicular,
                                  &options->manhattan};
    std::vector<double*> numbers = {&options->line_endpoint_prior_sigma, &options->reject_chi2_1,
                                    &options->reject_chi2_2, &options->reject_chi2_3,
                                    &options->reject_chi2_4};
    std::vector<bool*> flags = {&options->landmark_noise.enabled, &options->consensus.enabled,
                                &options->line_endpoint_prior};
    for (TermOptions* term : terms) {
      numbers.push_back(&term->huber);
      flags.push_back(&term->enabled);
    }
    switch (bytes_.Below(4)) {
      case 0: {
        bool* const flag = Choose(flags);
        *flag = !*flag;
        break;
      }
      case 1: {
        int* const count =
            bytes_.Below(2) == 0 ? &options->first_iterations : &options->second_iterations;
        constexpr size_t kMaxIterations = 20;  // more would only take longer
        *count = static_cast<int>(bytes_.Below(kMaxIterations + 2)) - 1;
        break;
      }
      case 2:
        options->solver = static_cast<BundleAdjustmentSolver>(bytes_.Below(4));
        break;
      default: {
        double* const number = Choose(numbers);
        *number = bytes_.NumberFor(*number);
      }
    }
  }

  ByteReader bytes_;
};

}  // namespace msc_vo
