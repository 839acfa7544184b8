// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/logging/logger.h"

#include <memory>

#include <spdlog/sinks/null_sink.h>

namespace msc_vo {

namespace {

std::shared_ptr<spdlog::logger> MakeSilentLogger() {
  auto logger =
      std::make_shared<spdlog::logger>("msc_vo", std::make_shared<spdlog::sinks::null_sink_mt>());
  logger->set_level(spdlog::level::off);
  logger->flush_on(spdlog::level::trace);  // a run that is killed keeps its lines
  return logger;
}

}  // namespace

spdlog::logger& Log() {
  static const std::shared_ptr<spdlog::logger> logger = MakeSilentLogger();
  return *logger;
}

}  // namespace msc_vo
