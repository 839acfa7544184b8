// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#pragma once

#include <map>
#include <string>
#include <vector>

namespace msc_vo {

/// The messages of each topic of a bag, in the order of recording.
template <typename Message>
class TopicMessages {
 public:
  void Add(const std::string& topic, const Message& message) {
    messages_[topic].push_back(message);
  }
  int Count(const std::string& topic) const {
    const auto found = messages_.find(topic);
    return found == messages_.end() ? 0 : static_cast<int>(found->second.size());
  }
  /// Throws std::out_of_range if there is no such message.
  const Message& At(const std::string& topic, int i) const {
    return messages_.at(topic).at(static_cast<size_t>(i));
  }

 private:
  std::map<std::string, std::vector<Message>> messages_;
};

}  // namespace msc_vo
