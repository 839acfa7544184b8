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
  EXPECT_THAT(NamesOf(RankColorTopics(topics)),
              testing::ElementsAre("/camera/rgb/image_color", "/camera/rgb/image_color/compressed",
                                   "/camera/rgb/image_mono"));
  EXPECT_THAT(NamesOf(RankDepthTopics(topics)),
              testing::ElementsAre("/camera/depth_registered/image", "/camera/depth/image"));
}

TEST(TopicChoice, NamesTheCameraInfo) {
  EXPECT_EQ(CameraInfoTopicOf("/camera/rgb/image_color"), "/camera/rgb/camera_info");
  EXPECT_EQ(CameraInfoTopicOf("/camera/rgb/image_color/compressed"), "/camera/rgb/camera_info");
  EXPECT_EQ(CameraInfoTopicOf("/image"), "/camera_info");
}

}  // namespace
}  // namespace msc_vo
