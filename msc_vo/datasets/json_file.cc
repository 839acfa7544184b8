// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/datasets/json_file.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {

namespace {

nlohmann::json Parse(const std::string& path) {
  constexpr std::uintmax_t kMaxBytes = std::uintmax_t{16} << 20;
  nlohmann::json json =
      nlohmann::json::parse(ReadFile(path, kMaxBytes), nullptr, /*allow_exceptions=*/false);
  if (json.is_object()) return json;
  throw std::runtime_error(path + ": is damaged or no JSON object; export the recording again");
}

}  // namespace

JsonFile::JsonFile(const std::string& path) : JsonFile(path, Parse(path)) {}

JsonFile::JsonFile(const std::string& path, nlohmann::json object)
    : path_(path), json_(std::make_unique<nlohmann::json>(std::move(object))) {}

JsonFile::JsonFile(JsonFile&&) = default;
JsonFile::~JsonFile() = default;

void JsonFile::Fail(const std::string& key, const std::string& problem) const {
  throw std::runtime_error(path_ + ": \"" + key + "\" " + problem + "; export the recording again");
}

bool JsonFile::Has(const std::string& key) const { return json_->contains(key); }

double JsonFile::Number(const std::string& key) const {
  if (!Has(key)) Fail(key, "is missing");
  const nlohmann::json& value = (*json_)[key];
  if (!value.is_number() || !std::isfinite(value.get<double>())) Fail(key, "is no finite number");
  return value.get<double>();
}

std::optional<JsonFile> JsonFile::Object(const std::string& key) const {
  const auto found = json_->find(key);
  if (found == json_->end() || !found->is_object()) return std::nullopt;
  return JsonFile(path_, *found);
}

std::vector<double> JsonFile::Numbers(const std::string& key, size_t count) const {
  if (!Has(key)) Fail(key, "is missing");
  std::vector<double> numbers;
  const nlohmann::json& values = (*json_)[key];
  if (values.is_array() && values.size() == count) {
    for (const nlohmann::json& value : values) {
      if (value.is_number() && std::isfinite(value.get<double>())) {
        numbers.push_back(value.get<double>());
      }
    }
  }
  if (numbers.size() != count) {
    Fail(key, "is no array of " + std::to_string(count) + " finite numbers");
  }
  return numbers;
}

}  // namespace msc_vo
