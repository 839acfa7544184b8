// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/diagnosis/texture.h"

#include <string>
#include <vector>

#include "tests/diagnosis/expected_finding.h"
#include "tests/support/message_matchers.h"
#include <Eigen/Core>
#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

// What to do about images with these features.
std::string FixOf(const std::vector<ImageTexture>& images) {
  Findings findings;
  AddTextureFindings(images, &findings);
  return ExpectFinding(findings, Severity::kWarning, "images.texture", Names("median"), "texture")
      .fix;
}

PlaneFeature PlaneWithNormal(const Eigen::Vector3d& normal) {
  PlaneFeature plane;
  plane.inverse_depth = 0.5 * normal;
  return plane;
}

TEST(TextureFindings, CountImagesWithPlanesInThreeDirections) {
  EXPECT_THAT(FixOf({{0, 0, 0, true}, {1, 0, 0, false}, {0, 0, 0, true}}),
              Names("planes in three directions", "2 of 3", "light"));
  EXPECT_THAT(FixOf({{50, 50, 20, true}}), Names("little texture", "planes", "1 of 1"));
  EXPECT_THAT(FixOf({{0, 0, 1, false}}), Not(HasSubstr("planes")));
}

TEST(TextureFindings, DistinguishFewFeaturesFromFeaturesWithoutDepth) {
  const auto few_features = AllOf(HasSubstr("hardly any feature"), Not(HasSubstr("have depth")));
  const auto no_depth = AllOf(Not(HasSubstr("hardly any feature")), HasSubstr("have depth"));
  EXPECT_THAT(FixOf({{40, 40, 3, false}}), few_features);
  EXPECT_THAT(FixOf({{332, 15, 12, false}}), no_depth);
  EXPECT_THAT(FixOf({{575, 69, 48, false}}), AllOf(no_depth, Not(HasSubstr("little texture"))));
}

// Planes continue a map, and begin none in an image without features.
TEST(TextureFindings, AreAnErrorIfNoImageShowsAFeature) {
  Findings findings;
  AddTextureFindings({{0, 0, 0, true}, {0, 0, 0, true}}, &findings);
  ExpectFinding(findings, Severity::kError, "images.texture", Names("2", "map"), "nothing");
}

TEST(MeasureTexture, FindsPlanesInThreeDirections) {
  Frame frame;
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_FALSE(MeasureTexture(frame).planes_determine_pose);
    frame.planes.push_back(PlaneWithNormal(Eigen::Vector3d::Unit(axis)));
  }
  EXPECT_TRUE(MeasureTexture(frame).planes_determine_pose);
}

}  // namespace
}  // namespace msc_vo
