// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <string>
#include <vector>

#include "tests/apps/command_process.h"
#include "tests/apps/rendered_sequence.h"
#include "tests/support/temporary_folder.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {

// Replays sequences that are rendered with other cameras.
class RenderedCameraTest : public TemporaryFolder {
 protected:
  // Renders a small sequence and returns the position error of its replay, metres.
  double ErrorOf(const std::string& name, const std::vector<std::string>& more,
                 const std::vector<std::string>& replay_more = {}) {
    std::vector<std::string> arguments = {"--frames", "30", "--width", "240"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    RenderSequence(Path(name), arguments);
    arguments = {"replay", Path(name), "--output", Path(name + "/out"), "--quiet"};
    arguments.insert(arguments.end(), replay_more.begin(), replay_more.end());
    const CommandOutcome outcome = RunCommand(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return Summary(name)["error"]["ape_rmse"];
  }
  nlohmann::json Summary(const std::string& name) {
    return nlohmann::json::parse(ReadFile(Path(name + "/out/summary.json")));
  }
};

}  // namespace msc_vo
