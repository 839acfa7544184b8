// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/topic_choice.h"

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

std::vector<std::string> NamesOf(const std::vector<ImageTopic>& topics) {
  std::vector<std::string> names;
  for (const ImageTopic& topic : topics) names.push_back(topic.name);
  return names;
}

TEST(TopicChoice, RanksTopics) {
  const std::vector<ImageTopic> topics = {
      {"/camera/depth/image", RosImageKind::kDepth, false},
      {"/camera/depth_registered/image", RosImageKind::kDepth, false},
      {"/camera/ir/image", RosImageKind::kGray, false},
      {"/camera/rgb/image_color", RosImageKind::kColor, false},
      {"/camera/rgb/image_color/compressed", RosImageKind::kColor, true},
      {"/camera/rgb/image_mono", RosImageKind::kGray, false},
      {"/other", RosImageKind::kOther, false}};
  EXPECT_THAT(NamesOf(RankColorTopics(topics, "/camera/depth_registered/image")),
              testing::ElementsAre("/camera/rgb/image_color", "/camera/rgb/image_color/compressed",
                                   "/camera/rgb/image_mono"));
  EXPECT_THAT(NamesOf(RankDepthTopics(topics)),
              testing::ElementsAre("/camera/depth_registered/image", "/camera/depth/image"));
}

TEST(TopicChoice, SplitsNamesIntoWords) {
  EXPECT_THAT(TopicWords("/iris/camera_2/irImage-rect"),
              testing::ElementsAre("iris", "camera", "ir", "image", "rect"));
  EXPECT_THAT(TopicWords("IRImage1"), testing::ElementsAre("ir", "image"));
  EXPECT_THAT(TopicWords("//7/_"), testing::IsEmpty());
}

TEST(TopicChoice, InfraredIsAWholeWord) {
  const auto is_color = [](const std::string& name) {
    return !RankColorTopics({{name, RosImageKind::kGray, false}}, "").empty();
  };
  for (const char* name : {"/iris/camera/rgb/image_raw", "/first/image", "/director/image",
                           "/fire_camera/image", "/infrastructure/image", "/cam/firmware_image"}) {
    EXPECT_TRUE(is_color(name)) << name;
  }
  for (const char* name : {"/camera/ir/image", "/camera/infra1/image_rect_raw", "/nir/image",
                           "/device_0/sensor_0/Infrared_1/image/data", "/camera/irImage",
                           "/ir_2/image", "/cam/IR/image"}) {
    EXPECT_FALSE(is_color(name)) << name;
  }
}

TEST(TopicChoice, RegisteredAndRectifiedAreWholeWords) {
  const auto prefers = [](const std::string& name) {
    const std::vector<ImageTopic> topics = {{"/a/depth", RosImageKind::kDepth, false},
                                            {name, RosImageKind::kDepth, false}};
    return RankDepthTopics(topics).front().name == name;
  };
  EXPECT_TRUE(prefers("/camera/aligned_depth_to_color/image_raw"));
  EXPECT_TRUE(prefers("/camera/depthRegistered/image"));
  EXPECT_FALSE(prefers("/camera/unregistered_depth/image"));
  EXPECT_FALSE(prefers("/camera/depth_not_registered/image"));
  EXPECT_FALSE(prefers("/camera/misaligned_depth/image"));
  const auto is_rectified = [](const std::string& name) {
    return IsRectified({name, RosImageKind::kColor, false});
  };
  EXPECT_TRUE(is_rectified("/camera/rgb/image_rect_color"));
  EXPECT_TRUE(is_rectified("/stereo/left/imageRect"));
  EXPECT_TRUE(is_rectified("/cam/rectified"));
  EXPECT_FALSE(is_rectified("/director/camera/image_raw"));
  EXPECT_FALSE(is_rectified("/direct/rectangle_detector/unrectified"));
}

TEST(TopicChoice, TakesTheColourOfTheCameraWithDepth) {
  const std::vector<ImageTopic> topics = {{"/cam_1/color/image_raw", RosImageKind::kColor, false},
                                          {"/cam_2/color/image_raw", RosImageKind::kColor, false},
                                          {"/cam_2/depth/preview", RosImageKind::kColor, false}};
  const std::vector<ImageTopic> ranked = RankColorTopics(topics, "/cam_2/depth/image_raw");
  EXPECT_EQ(ranked.front().name, "/cam_2/color/image_raw");
  EXPECT_EQ(ranked.back().name, "/cam_2/depth/preview");
  EXPECT_EQ(DescribeTopic(ranked.back()), "/cam_2/depth/preview (colour, named as depth)");
  EXPECT_EQ(DescribeTopic({"/c", RosImageKind::kOther, false, "nv24"}),
            "/c (neither colour nor depth: nv24)");
}

TEST(TopicChoice, NamesTheCameraInfo) {
  EXPECT_EQ(CameraInfoTopicOf("/camera/rgb/image_color"), "/camera/rgb/camera_info");
  EXPECT_EQ(CameraInfoTopicOf("/camera/rgb/image_color/compressed"), "/camera/rgb/camera_info");
  EXPECT_EQ(CameraInfoTopicOf("/image"), "/camera_info");
}

}  // namespace
}  // namespace msc_vo
