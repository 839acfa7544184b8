// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/logging/logger.h"

#include <memory>
#include <sstream>

#include <gmock/gmock.h>
#include <spdlog/sinks/ostream_sink.h>

namespace msc_vo {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Log, IsSilentByDefault) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  EXPECT_FALSE(Log().should_log(spdlog::level::critical));
  Log().critical("nobody configured a sink");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Log, WritesToTheSinksOfTheEmbeddingProgram) {
  std::ostringstream text;
  const std::vector<spdlog::sink_ptr> silent = Log().sinks();
  Log().sinks() = {std::make_shared<spdlog::sinks::ostream_sink_mt>(text)};
  Log().set_level(spdlog::level::warn);
  Log().info("two keyframes");
  Log().warn("frame {} is lost", 17);
  Log().sinks() = silent;
  Log().set_level(spdlog::level::off);
  EXPECT_THAT(text.str(), HasSubstr("[msc_vo] [warning] frame 17 is lost"));
  EXPECT_THAT(text.str(), Not(HasSubstr("keyframes")));
}

}  // namespace
}  // namespace msc_vo
