// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "apps/live/live_server.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <httplib.h>
#include <netinet/in.h>
#include <nlohmann/json.hpp>
#include <sys/socket.h>
#include <unistd.h>

namespace msc_vo {
namespace {

using std::chrono::seconds;
using std::chrono::steady_clock;
using testing::HasSubstr;

// A client that sends `request`, which need not be complete, and reads nothing.
class MuteClient {
 public:
  MuteClient(int port, const std::string& request)
      : socket_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int few_bytes = 4096;
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &few_bytes, sizeof(few_bytes));
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const int connected = connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof(address));
    EXPECT_EQ(connected, 0);
    EXPECT_EQ(send(socket_, request.data(), request.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(request.size()));
  }
  ~MuteClient() { close(socket_); }
  MuteClient(const MuteClient&) = delete;
  MuteClient& operator=(const MuteClient&) = delete;

  // Sends one more byte of an endless request. Returns false if the server has gone.
  bool Drip() { return send(socket_, "x", 1, MSG_NOSIGNAL) == 1; }

 private:
  int socket_;
};

class LiveServerTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!HasLiveServer()) GTEST_SKIP() << "built without three.js";
    server_.emplace("127.0.0.1", 0, "<html>page</html>", &run_);
    client_.emplace("127.0.0.1", server_->port());
  }
  int StatusOf(const std::string& path) {
    const httplib::Result result = client_->Get(path);
    return result ? result->status : -1;
  }

  LiveRun run_{LiveRunOptions()};
  std::optional<LiveServer> server_;
  std::optional<httplib::Client> client_;
};

TEST_F(LiveServerTest, ServesThePageAndData) {
  const httplib::Result page = client_->Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_EQ(page->body, "<html>page</html>");
  const httplib::Result data = client_->Get("/data?frames=0&map=-1&view=-1");
  ASSERT_TRUE(data);
  EXPECT_EQ(nlohmann::json::parse(data->body)["run"], run_.id());
  EXPECT_EQ(data->get_header_value("Cache-Control"), "no-store");
  for (const char* nonsense : {"/data", "/data?frames=x", "/data?frames=-7&map=1e99&view=nan"}) {
    EXPECT_EQ(StatusOf(nonsense), 200) << nonsense;
  }
}

TEST_F(LiveServerTest, DoesNotCompress) {
  for (const char* path : {"/", "/data"}) {
    const httplib::Result result = client_->Get(path, {{"Accept-Encoding", "gzip, deflate, br"}});
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->has_header("Content-Encoding")) << path;
    EXPECT_EQ(result->get_header_value("Content-Length"), std::to_string(result->body.size()));
  }
}

TEST_F(LiveServerTest, ServesTheReportOnceItIsThere) {
  EXPECT_EQ(StatusOf("/report"), 404);
  run_.Finish("<html>report</html>");
  const httplib::Result report = client_->Get("/report");
  ASSERT_TRUE(report);
  EXPECT_EQ(report->body, "<html>report</html>");
}

TEST_F(LiveServerTest, ServesNothingElse) {
  for (const char* path : {"/etc/passwd", "/../etc/passwd", "/%2e%2e/etc/passwd", "/report.html",
                           "/control", "/favicon.ico"}) {
    EXPECT_EQ(StatusOf(path), 404) << path;
  }
}

TEST_F(LiveServerTest, IsControlledOnlyByItsOwnPage) {
  const httplib::Headers own = {{"X-Msc-Vo", "control"}};
  const auto post = [&](const std::string& path, const httplib::Headers& headers) {
    const httplib::Result result = client_->Post(path, headers, "", "text/plain");
    return result ? result->status : -1;
  };
  // A form on another site can send no such header.
  EXPECT_EQ(post("/control?action=pause", {}), 400);
  EXPECT_EQ(post("/control?action=pause", own), 204);
  EXPECT_THAT(client_->Get("/data")->body, HasSubstr("\"paused\""));
  EXPECT_EQ(post("/control?action=explode", own), 400);
}

TEST_F(LiveServerTest, RefusesOtherHostNames) {
  const auto status_for = [&](const std::string& host) {
    const httplib::Result result = client_->Get("/data", {{"Host", host}});
    return result ? result->status : -1;
  };
  EXPECT_EQ(status_for("evil.example:80"), 403);
  EXPECT_EQ(status_for("127.evil.example"), 403);
  EXPECT_EQ(status_for("localhost:1234"), 200);  // forwarded by SSH
  EXPECT_EQ(status_for("[::1]:1234"), 200);
}

TEST_F(LiveServerTest, RefusesLongRequests) {
  const httplib::Result result =
      client_->Post("/control?action=pause", std::string(100'000, 'x'), "text/plain");
  EXPECT_TRUE(!result || result->status >= 400);
  EXPECT_EQ(StatusOf("/data"), 200);
}

TEST_F(LiveServerTest, NamesAPortThatIsInUse) {
  try {
    const LiveServer second("127.0.0.1", server_->port(), "", &run_);
    FAIL() << "two servers share a port";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("port " + std::to_string(server_->port())));
    EXPECT_THAT(error.what(), HasSubstr("--view PORT"));
  }
}

TEST_F(LiveServerTest, NamesAnAddressThatIsNotOfThisMachine) {
  EXPECT_THROW(LiveServer("192.0.2.1", 0, "", &run_), std::runtime_error);
}

TEST_F(LiveServerTest, SurvivesSilentClients) {
  std::vector<std::unique_ptr<httplib::Client>> silent;
  for (int i = 0; i < 3; ++i) {
    silent.push_back(std::make_unique<httplib::Client>("127.0.0.1", server_->port()));
    silent.back()->set_keep_alive(true);
    ASSERT_TRUE(silent.back()->Get("/data"));  // the connection stays open
  }
  EXPECT_EQ(StatusOf("/data"), 200);
  const auto start = steady_clock::now();
  server_.reset();
  EXPECT_LT(steady_clock::now() - start, seconds(8));
}

// Silent clients that occupy every thread of the server are dropped when their time is over.
TEST_F(LiveServerTest, DropsClientsThatDoNotEndTheirRequest) {
  std::vector<std::unique_ptr<MuteClient>> slow;
  for (size_t i = 0; i < LiveServer::kNumThreads; ++i) {
    slow.push_back(std::make_unique<MuteClient>(server_->port(), "GET /data HTTP/1.1\r\nHost: lo"));
  }
  client_->set_read_timeout(seconds(30));
  EXPECT_EQ(StatusOf("/data"), 200);
}

TEST_F(LiveServerTest, DropsClientsThatDoNotReadTheAnswer) {
  run_.Finish(std::string(64 << 20, 'x'));  // more than sockets hold
  std::vector<std::unique_ptr<MuteClient>> slow;
  for (size_t i = 0; i < LiveServer::kNumThreads; ++i) {
    slow.push_back(std::make_unique<MuteClient>(server_->port(),
                                                "GET /report HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  }
  client_->set_read_timeout(seconds(30));
  EXPECT_EQ(StatusOf("/data"), 200);
}

TEST_F(LiveServerTest, EndsBesideAClientThatSendsByteByByte) {
  constexpr int kNumBytes = 300;  // of 0.1 s each, far more than the test takes
  std::thread client([port = server_->port()] {
    MuteClient slow(port, "GET /data HTTP/1.1\r\nHost: lo");
    for (int i = 0; i < kNumBytes && slow.Drip(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
  });
  std::this_thread::sleep_for(seconds(1));
  const auto start = steady_clock::now();
  server_.reset();
  EXPECT_LT(steady_clock::now() - start, seconds(8));
  client.join();
}

TEST_F(LiveServerTest, SendsAReportToItsEnd) {
  constexpr size_t kSize = size_t{64} << 20;  // more than sockets hold
  run_.Finish(std::string(kSize, 'x'));
  size_t num_received = 0;
  std::thread client([&num_received, port = server_->port()] {
    httplib::Client slow("127.0.0.1", port);
    slow.Get("/report", [&num_received](const char*, size_t size) {
      const bool is_half = num_received < kSize / 2 && num_received + size >= kSize / 2;
      if (num_received == 0 || is_half) std::this_thread::sleep_for(seconds(2));
      num_received += size;
      return true;
    });
  });
  std::this_thread::sleep_for(seconds(1));
  server_.reset();
  client.join();
  EXPECT_EQ(num_received, kSize);
}

TEST_F(LiveServerTest, GoesOnWhenClientsVanish) {
  run_.Finish(std::string(64 << 20, 'x'));
  for (int i = 0; i < 20; ++i) {
    const MuteClient vanishes(server_->port(), "GET /report HTTP/1.1\r\nHost: localhost\r\n\r\n");
  }
  client_->set_read_timeout(seconds(30));
  EXPECT_EQ(StatusOf("/data"), 200);
}

}  // namespace
}  // namespace msc_vo
