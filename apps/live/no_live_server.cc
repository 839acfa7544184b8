// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Stands in for live_server.cc in programs that are built without cpp-httplib.

#include <stdexcept>

#include "apps/live/live_server.h"

namespace msc_vo {

bool HasLiveServer() { return false; }

struct LiveServer::State {};

LiveServer::LiveServer(const std::string& /*address*/, int /*port*/, std::string /*page*/,
                       LiveRun* /*run*/) {
  throw std::runtime_error("this msc_vo was built without a server for the live view");
}

LiveServer::~LiveServer() = default;

int LiveServer::port() const { return 0; }

}  // namespace msc_vo
