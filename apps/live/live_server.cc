// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/live/live_server.h"

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include <arpa/inet.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "msc_vo/text/files.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

constexpr size_t kMaxRequestBytes = 1024;
constexpr size_t kMaxRequestsPerConnection = 1000;
constexpr time_t kTimeoutSeconds = 3;
// At the end of the run, for responses in progress.
constexpr time_t kMaxSendingSeconds = 60;

// A port that another program listens on is an error, unlike with the default options of httplib,
// which share the port.
void SetSocketOptions(socket_t socket) {
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
}

// The name of a Host header without its port.
std::string HostName(const std::string& host) {
  if (!host.empty() && host.front() == '[') return host.substr(0, host.find(']') + 1);
  return host.substr(0, host.find(':'));
}

bool IsLoopback(const std::string& name) {
  const bool is_number = name.find_first_not_of("0123456789.") == std::string::npos;
  return name == "localhost" || name == "::1" || name == "[::1]" ||
         (is_number && name.rfind("127.", 0) == 0);
}

// Port of the local end of a socket; 0 if the descriptor is not an IP socket.
int LocalPort(int descriptor) {
  sockaddr_storage address = {};
  socklen_t size = sizeof(address);
  if (getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size) != 0) return 0;
  if (address.ss_family == AF_INET) {
    return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
  }
  return address.ss_family == AF_INET6
             ? ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port)
             : 0;
}

// Ends all connections of this process at a port. httplib waits for each of its requests, and the
// time limits do not end one that arrives byte by byte. No other sockets of the process have the
// port.
void ShutDownConnections(int port) {
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/dev/fd", error), end; !error && entry != end;
       entry.increment(error)) {
    const int descriptor = std::atoi(entry->path().filename().c_str());
    if (LocalPort(descriptor) == port) shutdown(descriptor, SHUT_RDWR);
  }
}

// Shared by the server and the responses in progress.
using ResponseToken = std::shared_ptr<const char>;

// Answers with a text. A content provider keeps httplib from compressing it, which would take a
// processor away from the run.
void Send(std::shared_ptr<const std::string> text, const char* type, const ResponseToken& token,
          httplib::Response* response) {
  const size_t size = text->size();
  response->set_content_provider(
      size, type,
      [text = std::move(text), token](size_t offset, size_t length, httplib::DataSink& sink) {
        return sink.write(text->data() + offset, length);
      });
}

// An integer parameter of a request, `otherwise` if it is missing or none.
int IntParameter(const httplib::Request& request, const char* name, int otherwise) {
  const std::optional<double> number = ParseNumber(request.get_param_value(name));
  constexpr double kMax = 1e9;
  if (!number || !(*number >= -1.0 && *number <= kMax)) return otherwise;
  return static_cast<int>(*number);
}

}  // namespace

bool HasLiveServer() { return HasViewer(); }

struct LiveServer::State {
  httplib::Server server;
  std::shared_ptr<const std::string> page;
  LiveRun* run = nullptr;
  int port = 0;
  ResponseToken token = std::make_shared<const char>();
  std::future<void> listening;

  void SetLimits();
  void Route(bool only_loopback);
  bool IsSending() const { return token.use_count() > 1; }
  void Stop();
};

void LiveServer::State::SetLimits() {
  server.new_task_queue = [] { return new httplib::ThreadPool(kNumThreads); };
  server.set_socket_options(SetSocketOptions);
  server.set_payload_max_length(kMaxRequestBytes);
  server.set_keep_alive_max_count(kMaxRequestsPerConnection);
  server.set_keep_alive_timeout(1);
  server.set_read_timeout(kTimeoutSeconds);
  server.set_write_timeout(kTimeoutSeconds);
  server.set_tcp_nodelay(true);
}

void LiveServer::State::Route(bool only_loopback) {
  using httplib::Request;
  using httplib::Response;
  server.set_pre_routing_handler([only_loopback](const Request& request, Response& response) {
    response.set_header("Cache-Control", "no-store");
    response.set_header("X-Content-Type-Options", "nosniff");
    if (!only_loopback || IsLoopback(HostName(request.get_header_value("Host")))) {
      return httplib::Server::HandlerResponse::Unhandled;
    }
    response.status = 403;
    response.set_content("the live view is served under the name localhost\n", "text/plain");
    return httplib::Server::HandlerResponse::Handled;
  });
  server.Get("/", [this](const Request&, Response& response) {
    Send(page, "text/html; charset=utf-8", token, &response);
  });
  server.Get("/data", [this](const Request& request, Response& response) {
    const auto update = std::make_shared<const std::string>(
        run->Update(IntParameter(request, "frames", 0), IntParameter(request, "map", -1),
                    IntParameter(request, "view", -1)));
    Send(update, "application/json", token, &response);
  });
  server.Get("/report", [this](const Request&, Response& response) {
    const std::shared_ptr<const std::string> report = run->Report();
    if (report) {
      Send(report, "text/html; charset=utf-8", token, &response);
    } else {
      response.status = 404;
    }
  });
  server.Post("/control", [this](const Request& request, Response& response) {
    const bool is_done =
        request.has_header("X-Msc-Vo") &&
        run->Control(request.get_param_value("action"), request.get_param_value("value"));
    response.status = is_done ? 204 : 400;
  });
}

// Responses in progress may end.
void LiveServer::State::Stop() {
  using std::chrono::steady_clock;
  server.stop();
  const auto start = steady_clock::now();
  while (listening.wait_for(std::chrono::milliseconds(20)) != std::future_status::ready) {
    const auto limit = std::chrono::seconds(IsSending() ? kMaxSendingSeconds : kTimeoutSeconds);
    if (steady_clock::now() - start > limit) ShutDownConnections(port);
  }
}

LiveServer::LiveServer(const std::string& address, int port, std::string page, LiveRun* run)
    : state_(std::make_unique<State>()) {
  state_->page = std::make_shared<const std::string>(std::move(page));
  state_->run = run;
  state_->SetLimits();
  state_->Route(IsLoopback(address));
  errno = 0;
  if (port == 0) {
    state_->port = state_->server.bind_to_any_port(address);
  } else if (state_->server.bind_to_port(address, port)) {
    state_->port = port;
  }
  if (state_->port <= 0) {
    const std::string reason =
        errno != 0 ? std::string(": ") + ErrorText({errno, std::generic_category()}) : "";
    throw std::runtime_error("the live view cannot be served at " + address + ", port " +
                             std::to_string(port) + reason +
                             "; end the program that uses the port, or choose another one with "
                             "--view PORT");
  }
  state_->listening =
      std::async(std::launch::async, [server = &state_->server] { server->listen_after_bind(); });
  // stop() has no effect before the server runs.
  while (!state_->server.is_running()) {
    if (state_->listening.wait_for(std::chrono::milliseconds(1)) == std::future_status::ready) {
      throw std::runtime_error("the live view cannot be served: the server has ended");
    }
  }
}

LiveServer::~LiveServer() { state_->Stop(); }

int LiveServer::port() const { return state_->port; }

}  // namespace msc_vo
