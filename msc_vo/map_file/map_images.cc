// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/map_file/map_images.h"

#include "msc_vo/map_file/internal/image_rows.h"
#include "msc_vo/map_file/internal/map_schema.h"
#include "msc_vo/map_file/internal/sqlite_database.h"

namespace msc_vo {

struct MapImages::State {
  explicit State(const std::string& path) : database(path, SqliteDatabase::Access::kRead) {}

  SqliteDatabase database;
};

MapImages::MapImages(const std::string& path) : state_(std::make_unique<State>(path)) {
  CheckSchema(state_->database);
}

MapImages::MapImages(MapImages&&) noexcept = default;
MapImages& MapImages::operator=(MapImages&&) noexcept = default;
MapImages::~MapImages() = default;

std::vector<KeyframeId> MapImages::Keyframes() const { return ListImages(state_->database); }

std::string MapImages::Read(KeyframeId id) const { return ReadImage(state_->database, id); }

}  // namespace msc_vo
