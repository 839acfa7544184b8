// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/report/surface_layer.h"

#include <sstream>
#include <stdexcept>

#include "fake_run.h"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "msc_vo/report/base64.h"

namespace msc_vo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A square of 2 m in the plane z = 1, with its corner at (-1, -1).
ColoredMesh Square(uint8_t gray) {
  ColoredMesh mesh;
  mesh.positions = {
      {-1.0f, -1.0f, 1.0f}, {1.0f, -1.0f, 1.0f}, {1.0f, 1.0f, 1.0f}, {-1.0f, 1.0f, 1.0f}};
  mesh.colors.assign(4, {{gray, gray, gray}});
  mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
  return mesh;
}

TimedPose Pose() { return {7.5, {{0.0, 1.0, 0.0, 0.0}, {1.0, 2.0, 3.0}}}; }

std::string Page() {
  std::ostringstream out;
  WriteReport(MakeFakeRun(5), out);
  return out.str();
}

nlohmann::json SurfaceOf(const std::string& page) {
  const std::string opening = "id=\"surface-data\">";
  const size_t begin = page.find(opening) + opening.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(SurfaceLayer, IsStoredInStepsFromItsCorner) {
  if (!HasViewer()) GTEST_SKIP() << "built without three.js";
  const std::string page = Page();
  ASSERT_TRUE(IsInteractiveReport(page));
  EXPECT_THAT(page, Not(HasSubstr("surface-data\">")));
  const nlohmann::json surface = SurfaceOf(AddSurfaceLayer(page, Square(7), Pose()));
  EXPECT_EQ(surface["time"], 7.5);
  EXPECT_EQ(surface["pose"], nlohmann::json({1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0}));
  EXPECT_EQ(surface["corner"], nlohmann::json({-1.0, -1.0, 1.0}));
  EXPECT_NEAR(surface["step"], 2.0 / 65535.0, 1e-9);
  const std::vector<uint16_t> steps = {0, 0, 0, 65535, 0, 0, 65535, 65535, 0, 0, 65535, 0};
  EXPECT_EQ(surface["positions"], EncodeBase64(steps));
  EXPECT_EQ(surface["colors"], EncodeBase64(std::vector<uint8_t>(12, 7)));
  EXPECT_EQ(surface["triangles"], EncodeBase64(std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(SurfaceLayer, ReplacesAnEarlierSurface) {
  if (!HasViewer()) GTEST_SKIP() << "built without three.js";
  const std::string page = Page();
  const std::string once = AddSurfaceLayer(page, Square(7), Pose());
  EXPECT_EQ(AddSurfaceLayer(AddSurfaceLayer(page, Square(9), Pose()), Square(7), Pose()), once);
  EXPECT_EQ(once.substr(once.find("<script type=\"application/json\" id=\"run-data\">")),
            page.substr(page.find("<script type=\"application/json\" id=\"run-data\">")));
}

TEST(SurfaceLayer, NeedsAReportAndTriangles) {
  EXPECT_FALSE(IsInteractiveReport("<html></html>"));
  EXPECT_THROW(AddSurfaceLayer("<html></html>", Square(7), Pose()), std::invalid_argument);
  ColoredMesh points = Square(7);
  points.triangles.clear();
  EXPECT_THROW(AddSurfaceLayer(Page(), points, Pose()), std::invalid_argument);
  ColoredMesh uncolored = Square(7);
  uncolored.colors.pop_back();
  EXPECT_THROW(AddSurfaceLayer(Page(), uncolored, Pose()), std::invalid_argument);
}

}  // namespace
}  // namespace msc_vo
