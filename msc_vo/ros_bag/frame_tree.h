// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "msc_vo/ros_bag/bag_file.h"
#include "msc_vo/ros_bag/ros_message.h"

namespace msc_vo {

/// Coordinate frames that are fixed to their parents, as tf publishes them.
class FrameTree {
 public:
  /// A frame that is added again with another parent or transform is no longer fixed.
  void Add(const RosFrameTransform& transform);

  /// Returns target_from_source, metres; none if no chain of fixed transforms connects the frames.
  std::optional<Rigid3> Find(const std::string& target, const std::string& source) const;

 private:
  struct Edge {
    std::string parent;
    Rigid3 parent_from_child;
    bool is_fixed = true;
  };

  // The frame and those above it that it is fixed to, each with the transform to it.
  std::vector<std::pair<std::string, Rigid3>> Ancestors(const std::string& frame) const;

  std::map<std::string, Edge> edges_;  // by child
};

/// Returns target_from_source, metres, from the transforms of the topics tf_static or, if these do
/// not connect the frames, from those too that all messages of other topics of tf agree on. None if
/// the bag does not connect the frames. Throws std::runtime_error, naming the message, if one is
/// damaged.
std::optional<Rigid3> FindFixedTransform(const BagFile& bag, const std::string& target,
                                         const std::string& source);

}  // namespace msc_vo
