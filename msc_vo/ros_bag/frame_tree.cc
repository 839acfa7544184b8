// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/ros_bag/frame_tree.h"

#include <stdexcept>

#include "msc_vo/text/ending.h"

namespace msc_vo {

namespace {

bool AreEqual(const Rigid3& a, const Rigid3& b) {
  constexpr double kTolerance = 1e-6;  // metres and radians
  return (a.translation() - b.translation()).norm() <= kTolerance &&
         a.rotation().angularDistance(b.rotation()) <= kTolerance;
}

// Adds the transforms of all messages. `error` gets that of the first damaged one.
void AddTopics(const BagFile& bag, bool are_static, FrameTree* tree, std::string* error) {
  for (const BagTopic& topic : bag.topics()) {
    if (topic.type != "tf2_msgs/TFMessage" && topic.type != "tf/tfMessage") continue;
    if (HasEnding(topic.name, "tf_static") != are_static) continue;
    const int count = bag.NumMessages(topic.name);
    for (int i = 0; i < count; ++i) {
      try {
        const auto transforms = bag.Parse(topic.name, i, ParseRosFrameTransforms);
        for (const RosFrameTransform& transform : transforms) tree->Add(transform);
      } catch (const std::runtime_error& damage) {
        if (error->empty()) *error = damage.what();
      }
    }
  }
}

}  // namespace

void FrameTree::Add(const RosFrameTransform& transform) {
  const auto [found, is_new] =
      edges_.try_emplace(transform.child, Edge{transform.parent, transform.parent_from_child});
  Edge& edge = found->second;
  edge.is_fixed = edge.is_fixed && edge.parent == transform.parent &&
                  AreEqual(edge.parent_from_child, transform.parent_from_child);
}

std::vector<std::pair<std::string, Rigid3>> FrameTree::Ancestors(const std::string& frame) const {
  std::vector<std::pair<std::string, Rigid3>> ancestors = {{frame, Rigid3()}};
  while (ancestors.size() <= edges_.size()) {  // a damaged tree may have a cycle
    const auto edge = edges_.find(ancestors.back().first);
    if (edge == edges_.end() || !edge->second.is_fixed) break;
    ancestors.emplace_back(edge->second.parent,
                           edge->second.parent_from_child * ancestors.back().second);
  }
  return ancestors;
}

std::optional<Rigid3> FrameTree::Find(const std::string& target, const std::string& source) const {
  const auto of_source = Ancestors(source);
  for (const auto& [frame, frame_from_target] : Ancestors(target)) {
    for (const auto& [other, frame_from_source] : of_source) {
      if (other == frame) return frame_from_target.Inverse() * frame_from_source;
    }
  }
  return std::nullopt;
}

std::optional<Rigid3> FindFixedTransform(const BagFile& bag, const std::string& target,
                                         const std::string& source) {
  FrameTree tree;
  std::string error;
  for (const bool are_static : {true, false}) {
    AddTopics(bag, are_static, &tree, &error);
    const std::optional<Rigid3> transform = tree.Find(target, source);
    if (transform) return transform;
  }
  if (!error.empty()) throw std::runtime_error(error);
  return std::nullopt;
}

}  // namespace msc_vo
