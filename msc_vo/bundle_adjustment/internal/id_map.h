// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace msc_vo {

/// Throws std::invalid_argument for a window that is not valid.
[[noreturn]] inline void ThrowInvalidWindow(const std::string& error) {
  throw std::invalid_argument("LocalBundleAdjustment: " + error);
}

/// Positions of items by their ids.
class IdMap {
 public:
  /// `kind`: of the items, for error messages; must outlive the map. Throws std::invalid_argument
  /// on a repeated id.
  template <typename Item>
  IdMap(const char* kind, const std::vector<Item>& items) : kind_(kind) {
    positions_.reserve(items.size());
    for (size_t i = 0; i < items.size(); ++i) {
      positions_.emplace_back(items[i].id, static_cast<int>(i));
    }
    std::sort(positions_.begin(), positions_.end());
    for (size_t i = 1; i < positions_.size(); ++i) {
      if (positions_[i].first == positions_[i - 1].first) {
        ThrowInvalidWindow(Name(positions_[i].first) + ": the id is given twice");
      }
    }
  }

  /// Throws std::invalid_argument on an unknown id. `role`: use of the id, for the error message.
  int At(int64_t id, const std::string& role = "observed") const {
    const auto it = std::lower_bound(positions_.begin(), positions_.end(), std::make_pair(id, 0));
    if (it == positions_.end() || it->first != id) {
      ThrowInvalidWindow(Name(id) + " is " + role + " but not in the window");
    }
    return it->second;
  }

 private:
  std::string Name(int64_t id) const { return std::string(kind_) + " " + std::to_string(id); }

  const char* kind_;
  std::vector<std::pair<int64_t, int>> positions_;
};

}  // namespace msc_vo
