// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/frame_tree.h"

#include <cmath>

#include <gtest/gtest.h>

namespace msc_vo {
namespace {

const Eigen::Quaterniond kQuarterTurn(std::sqrt(0.5), 0.0, 0.0, std::sqrt(0.5));  // about z

Rigid3 Shift(double x, double y, double z) {
  return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(x, y, z)};
}

TEST(FrameTree, ChainsTransformsThroughTheCommonFrame) {
  FrameTree tree;
  tree.Add({"link", "depth", {kQuarterTurn, Eigen::Vector3d(1.0, 0.0, 0.0)}});
  tree.Add({"link", "color", Shift(0.0, 2.0, 0.0)});
  tree.Add({"map", "link", Shift(7.0, 8.0, 9.0)});
  // The origin of colour is at (0, 2, 0) in the link, (-1, 2, 0) from depth, whose x axis is y.
  const std::optional<Rigid3> transform = tree.Find("depth", "color");
  ASSERT_TRUE(transform);
  EXPECT_TRUE(
      (*transform * Eigen::Vector3d::Zero()).isApprox(Eigen::Vector3d(2.0, 1.0, 0.0), 1e-12));
  EXPECT_TRUE((*tree.Find("map", "color") * Eigen::Vector3d::Zero())
                  .isApprox(Eigen::Vector3d(7.0, 10.0, 9.0), 1e-12));
  EXPECT_FALSE(tree.Find("depth", "infrared"));
}

TEST(FrameTree, KeepsOnlyFramesThatStayFixed) {
  FrameTree tree;
  for (int i = 0; i < 3; ++i) {
    tree.Add({"link", "color", Shift(0.1, 0.0, 0.0)});
    tree.Add({"link", "gripper", Shift(0.1 * i, 0.0, 0.0)});
    tree.Add({i == 2 ? "left" : "right", "tool", Shift(0.1, 0.0, 0.0)});
  }
  EXPECT_TRUE(tree.Find("link", "color"));
  EXPECT_FALSE(tree.Find("link", "gripper"));
  EXPECT_FALSE(tree.Find("right", "tool"));
}

TEST(FrameTree, EndsInCycles) {
  FrameTree tree;
  tree.Add({"a", "b", Shift(1.0, 0.0, 0.0)});
  tree.Add({"b", "a", Shift(1.0, 0.0, 0.0)});
  tree.Add({"c", "c", Shift(1.0, 0.0, 0.0)});
  EXPECT_FALSE(tree.Find("a", "c"));
}

}  // namespace
}  // namespace msc_vo
