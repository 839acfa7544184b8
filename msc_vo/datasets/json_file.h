// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace msc_vo {

/// A JSON object in a file with numbers.
class JsonFile {
 public:
  /// Throws std::runtime_error, naming the file, if it cannot be read or is no JSON object.
  explicit JsonFile(const std::string& path);
  JsonFile(JsonFile&&);
  ~JsonFile();

  bool Has(const std::string& key) const;
  /// Returns a finite number. Throws std::runtime_error, naming file and key, if there is none.
  double Number(const std::string& key) const;
  /// Returns the object of a key; none if there is no object.
  std::optional<JsonFile> Object(const std::string& key) const;
  /// Number() for an array of `count` numbers.
  std::vector<double> Numbers(const std::string& key, size_t count) const;

 private:
  JsonFile(const std::string& path, nlohmann::json object);
  [[noreturn]] void Fail(const std::string& key, const std::string& problem) const;

  std::string path_;
  std::unique_ptr<nlohmann::json> json_;
};

}  // namespace msc_vo
