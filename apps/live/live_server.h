// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "apps/live/live_run.h"

namespace msc_vo {

/// Whether this program was built with a server.
bool HasLiveServer();

/// Serves the page of a run over HTTP, from memory: GET / (the page), GET data, GET report, and
/// POST control, which needs the header X-Msc-Vo. Nothing else exists, no files are read. On a
/// loopback address, requests with another host name are refused, so that pages of other sites
/// cannot read through a name of theirs that resolves to this machine.
class LiveServer {
 public:
  /// Connections that are served at a time.
  static constexpr size_t kNumThreads = 4;

  /// Serves until it is destroyed. `port` 0: any free port. Throws std::runtime_error if the
  /// address cannot be used. `run` must outlive the server.
  LiveServer(const std::string& address, int port, std::string page, LiveRun* run);
  ~LiveServer();
  LiveServer(const LiveServer&) = delete;
  LiveServer& operator=(const LiveServer&) = delete;

  int port() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace msc_vo
