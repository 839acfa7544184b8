// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace msc_vo {

/// A JSON object in a file with numbers.
class JsonFile {
 public:
  /// With a `key`, the object is that of this key in the object of the file. Throws
  /// std::runtime_error, naming the file, if it cannot be read or is no JSON object.
  explicit JsonFile(const std::string& path, const std::string& key = "");
  ~JsonFile();
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;

  bool Has(const std::string& key) const;
  /// Returns a finite number. Throws std::runtime_error, naming file and key, if there is none.
  double Number(const std::string& key) const;
  /// The same for an array of `count` numbers.
  std::vector<double> Numbers(const std::string& key, size_t count) const;

 private:
  [[noreturn]] void Fail(const std::string& key, const std::string& problem) const;

  std::string path_;
  std::unique_ptr<nlohmann::json> json_;
};

}  // namespace msc_vo
