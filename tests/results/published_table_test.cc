// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// Tables of the literature.

#include "msc_vo/results/published_table.h"

#include "tests/support/message_matchers.h"
#include "tests/support/temporary_folder.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/text/files.h"

namespace msc_vo {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr char kTable[] =
    "title: A table\n"
    "datasets:\n"
    "  - {name: Rooms, url: https://rooms.example}\n"
    "systems:\n"
    "  - {name: A, source: \"paper of A, Table 1\"}\n"
    "  - {name: B, source: paper of B}\n"
    "sequences:\n"
    "  - name: one\n"
    "    dataset: Rooms\n"
    "    folders: [room_1, room_one]\n"
    "    errors: {A: 0.0125, B: failed}\n"
    "  - name: two\n"
    "    dataset: Rooms\n"
    "    camera: kinect-v1\n"
    "    format: tum\n"
    "    folders: [room_2]\n"
    "    errors: {A: 0.02}\n";

class PublishedTableTest : public TemporaryFolder {
 protected:
  PublishedTable Read(const std::string& text) const {
    WriteText("table.yaml", text);
    return ReadPublishedTable(Path("table.yaml"));
  }
  // The message for the table with `from` replaced by `to`.
  std::string ErrorOf(const std::string& from, const std::string& to) const {
    std::string text = kTable;
    text.replace(text.find(from), from.size(), to);
    try {
      Read(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }
  static Benchmark OneRun() {
    Benchmark benchmark;
    benchmark.modes = {"loops-off", "loops-on"};
    BenchmarkRun run;
    run.sequence = "one";
    run.mode = "loops-off";
    run.error.emplace();
    run.error->usable = true;
    run.error->ape.rmse = 0.0071;
    benchmark.runs.push_back(run);
    run.mode = "loops-on";
    run.failure = "it <failed>";
    run.error.reset();
    benchmark.runs.push_back(run);
    return benchmark;
  }
};

TEST_F(PublishedTableTest, IsRead) {
  const PublishedTable table = Read(kTable);
  EXPECT_EQ(table.title, "A table");
  ASSERT_EQ(table.systems.size(), 2u);
  EXPECT_EQ(table.systems[0].source, "paper of A, Table 1");
  ASSERT_EQ(table.sequences.size(), 2u);
  EXPECT_EQ(table.sequences[0].url, "https://rooms.example");
  EXPECT_THAT(table.sequences[0].folders, testing::ElementsAre("room_1", "room_one"));
  EXPECT_EQ(table.sequences[0].errors.at("A"), 0.0125);
  EXPECT_EQ(table.sequences[0].errors.at("B"), std::nullopt);
  EXPECT_EQ(table.sequences[1].errors.count("B"), 0u);
  EXPECT_EQ(table.sequences[1].camera, "kinect-v1");
  EXPECT_EQ(table.sequences[1].format, "tum");
}

TEST_F(PublishedTableTest, NamesFileAndLineOfErrors) {
  EXPECT_THAT(ErrorOf("title: A table", "title: [A"), Names("table.yaml:", "YAML"));
  EXPECT_THAT(ErrorOf("title: A table", "name: A table"), Names("table.yaml:1", "name", "title"));
  EXPECT_THAT(ErrorOf("dataset: Rooms\n    folders", "dataset: Halls\n    folders"),
              Names("table.yaml:9", "Halls", "datasets"));
  EXPECT_THAT(ErrorOf("errors: {A: 0.0125", "errors: {C: 0.0125"),
              Names("table.yaml:11", "'C'", "systems"));
  EXPECT_THAT(ErrorOf("B: failed", "B: lost"), Names("table.yaml:11", "'B'", "failed", "lost"));
  EXPECT_THAT(ErrorOf("A: 0.02}", "A: -0.02}"), Names("table.yaml:17", "-0.02"));
  EXPECT_THAT(ErrorOf("A: 0.02}", "A: 0.02, A: 0.03}"), Names("table.yaml:17", "'A'"));
  EXPECT_THAT(ErrorOf("name: two", "name: one"), Names("table.yaml:12", "one", "twice"));
  EXPECT_THAT(ErrorOf("name: two", "name: ../two"), Names("table.yaml:12", "../two"));
  EXPECT_THAT(ErrorOf("[room_2]", "[]"), Names("table.yaml:16", "folders"));
  EXPECT_THAT(ErrorOf("[room_2]", "[/room_2]"), Names("table.yaml:16", "relative"));
  EXPECT_THAT(ErrorOf("url: https://rooms.example", "page: x"), Names("table.yaml:3", "page"));
  EXPECT_THROW(ReadPublishedTable(Path("none.yaml")), std::runtime_error);
}

TEST_F(PublishedTableTest, ComparesOwnColumnsWithPublishedOnes) {
  const PublishedTable table = Read(kTable);
  const std::string text = FormatPublishedMarkdown(table, OneRun(), "/data");
  EXPECT_THAT(text, HasSubstr("| APE RMSE, mm | msc_vo, loops-off | msc_vo, loops-on | A | B |\n"));
  EXPECT_THAT(text, HasSubstr("\n| one | 7.1 | failed | 12.5 | failed |\n"));
  EXPECT_THAT(text, HasSubstr("\n| two | - | - | 20.0 | - |\n"));
  EXPECT_THAT(text, HasSubstr("- A: paper of A, Table 1\n"));
  EXPECT_THAT(text,
              HasSubstr("- two (Rooms): wanted as the folder room_2 in /data; it can be had from "
                        "https://rooms.example\n"));
  EXPECT_THAT(text, Not(HasSubstr("- one (")));

  const auto json = nlohmann::json::parse(FormatPublishedJson(table, OneRun(), "/data"));
  EXPECT_EQ(json["sequences"][0]["msc_vo"]["loops-off"], 0.0071);
  EXPECT_TRUE(json["sequences"][0]["msc_vo"]["loops-on"].is_null());
  EXPECT_EQ(json["sequences"][0]["published"]["A"], 0.0125);
  EXPECT_FALSE(json["sequences"][1]["is_run"]);

  const std::string html = FormatPublishedHtml(table, OneRun(), "/data");
  EXPECT_THAT(html, HasSubstr("<tr><td>one</td><td>7.1</td><td>failed</td><td>12.5</td>"));
  EXPECT_THAT(html, HasSubstr("https://rooms.example"));
}

// Those that are delivered.
TEST(PublishedTables, AreValid) {
  size_t num_tables = 0;
  for (const std::string& path : ListFolder(MSC_VO_BENCHMARKS_FOLDER)) {
    const PublishedTable table = ReadPublishedTable(path);
    EXPECT_GE(table.sequences.size(), 6u) << path;
    ++num_tables;
  }
  EXPECT_EQ(num_tables, 5u);
  const PublishedTable paper =
      ReadPublishedTable(std::string(MSC_VO_BENCHMARKS_FOLDER) + "/msc_vo_paper.yaml");
  ASSERT_EQ(paper.sequences.size(), 12u);
  EXPECT_EQ(paper.sequences[0].errors.at("MSC-VO"), 0.010);
  EXPECT_EQ(paper.sequences[9].errors.at("MSC-VO"), std::nullopt);  // snot-near
}

}  // namespace
}  // namespace msc_vo
