// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/topic_choice.h"

#include <algorithm>
#include <utility>

#include <gmock/gmock.h>

namespace msc_vo {
namespace {

using std::string_literals::operator""s;

ImageTopic ColorTopic(const std::string& name, const std::string& frame = "",
                      bool is_calibrated = true) {
  return {name, RosImageKind::kColor, false, "", frame, {}, is_calibrated};
}

ImageTopic DepthTopic(const std::string& name, const std::string& frame = "") {
  return {name, RosImageKind::kDepth, false, "", frame};
}

// The names of the best pair of topics, in whichever order they are given.
std::pair<std::string, std::string> Best(std::vector<ImageTopic> topics) {
  const auto names = [&] {
    const TopicPair pair = BestPair(ColorTopics(topics), DepthTopics(topics));
    return std::pair(pair.color.name, pair.depth.name);
  };
  const auto best = names();
  std::reverse(topics.begin(), topics.end());
  EXPECT_EQ(names(), best);
  return best;
}

TEST(TopicChoice, PrefersRegisteredDepthAndColourOfTheSameCamera) {
  EXPECT_EQ(Best({{"/camera/depth/image", RosImageKind::kDepth, false},
                  {"/camera/depth_registered/image", RosImageKind::kDepth, false},
                  {"/camera/ir/image", RosImageKind::kGray, false},
                  {"/camera/rgb/image_color", RosImageKind::kColor, false},
                  {"/camera/rgb/image_color/compressed", RosImageKind::kColor, true},
                  {"/camera/rgb/image_mono", RosImageKind::kGray, false},
                  {"/other", RosImageKind::kOther, false}}),
            std::pair("/camera/rgb/image_color"s, "/camera/depth_registered/image"s));
  EXPECT_EQ(Best({ColorTopic("/cam_1/color/image_raw"), ColorTopic("/cam_2/color/image_raw"),
                  ColorTopic("/cam_2/depth/preview"), DepthTopic("/cam_2/depth/image_raw")}),
            std::pair("/cam_2/color/image_raw"s, "/cam_2/depth/image_raw"s));
}

TEST(TopicChoice, PrefersDepthInTheFrameOfColour) {
  // As the driver of the Azure Kinect names its topics.
  EXPECT_EQ(Best({ColorTopic("/rgb/image_raw", "rgb"), DepthTopic("/depth/image_raw", "depth"),
                  ColorTopic("/rgb_to_depth/image_raw", "depth"),
                  DepthTopic("/depth_to_rgb/image_raw", "rgb")}),
            std::pair("/rgb/image_raw"s, "/depth_to_rgb/image_raw"s));
  EXPECT_EQ(Best({ColorTopic("/a/color", "a"), DepthTopic("/a/depth", "a_depth"),
                  ColorTopic("/b/color", "b"), DepthTopic("/b/depth", "b")}),
            std::pair("/b/color"s, "/b/depth"s));
}

TEST(TopicChoice, PrefersCalibratedColour) {
  EXPECT_EQ(Best({ColorTopic("/a/color", "a", false), DepthTopic("/a/depth"),
                  ColorTopic("/b/color", "b"), DepthTopic("/b/depth")}),
            std::pair("/b/color"s, "/b/depth"s));
  EXPECT_EQ(Best({ColorTopic("/a/color", "a", false), DepthTopic("/a/depth", "a"),
                  ColorTopic("/b/color", "b"), DepthTopic("/b/depth", "c")}),
            std::pair("/a/color"s, "/a/depth"s));
}

TEST(TopicChoice, SplitsNamesIntoWords) {
  EXPECT_THAT(TopicWords("/iris/camera_2/irImage-rect"),
              testing::ElementsAre("iris", "camera", "ir", "image", "rect"));
  EXPECT_THAT(TopicWords("IRImage1"), testing::ElementsAre("ir", "image"));
  EXPECT_THAT(TopicWords("//7/_"), testing::IsEmpty());
}

TEST(TopicChoice, InfraredIsAWholeWord) {
  const auto is_color = [](const std::string& name) {
    return !ColorTopics({{name, RosImageKind::kGray, false}}).empty();
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
  const auto is_registered = [](const std::string& name) { return IsRegistered(DepthTopic(name)); };
  for (const char* name :
       {"/camera/aligned_depth_to_color/image_raw", "/camera/depthRegistered/image",
        "/depth_to_rgb/image_raw", "/camera/depth_to_color"}) {
    EXPECT_TRUE(is_registered(name)) << name;
  }
  for (const char* name : {"/camera/unregistered_depth/image", "/camera/depth_not_registered/image",
                           "/camera/misaligned_depth/image", "/aligned_depth_to_infra1/image_raw",
                           "/rgb_to_depth/image_raw", "/camera/depth_to"}) {
    EXPECT_FALSE(is_registered(name)) << name;
  }
  const auto is_rectified = [](const std::string& name) {
    return IsRectified({name, RosImageKind::kColor, false});
  };
  EXPECT_TRUE(is_rectified("/camera/rgb/image_rect_color"));
  EXPECT_TRUE(is_rectified("/stereo/left/imageRect"));
  EXPECT_TRUE(is_rectified("/cam/rectified"));
  EXPECT_FALSE(is_rectified("/director/camera/image_raw"));
  EXPECT_FALSE(is_rectified("/direct/rectangle_detector/unrectified"));
}

TEST(TopicChoice, TakesMono16ForDepthOnlyIfItIsNamedSoOrAlone) {
  const ImageTopic color = ColorTopic("/rgb", "rgb");
  const auto mono16 = [](const std::string& name) {
    return ImageTopic{name, RosImageKind::kDepth, false, "mono16", "rgb"};
  };
  EXPECT_EQ(Best({color, mono16("/camera/image_raw"), DepthTopic("/d", "other")}).second, "/d");
  EXPECT_EQ(Best({color, mono16("/camera/depth/image"), DepthTopic("/d", "other")}).second,
            "/camera/depth/image");
  EXPECT_EQ(Best({color, mono16("/camera/image_raw")}).second, "/camera/image_raw");
  EXPECT_EQ(DescribeTopic(mono16("/x")), "/x (grey with 16 bits, or depth)");
}

TEST(TopicChoice, DescribesTopics) {
  EXPECT_EQ(DescribeTopic(ColorTopic("/cam_2/depth/preview")),
            "/cam_2/depth/preview (colour, named as depth)");
  EXPECT_EQ(DescribeTopic(ColorTopic("/c", "", false)), "/c (colour, no CameraInfo)");
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
