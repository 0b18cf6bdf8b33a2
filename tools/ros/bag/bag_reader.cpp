// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/bag/bag_reader.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace adit {

BagDamage& BagDamage::operator+=(const BagDamage& part) {
  corrupt_regions += part.corrupt_regions;
  corrupt_bytes += part.corrupt_bytes;
  truncated_bytes += part.truncated_bytes;
  lost_messages += part.lost_messages;
  return *this;
}

std::vector<std::string> texts_of(const BagDamage& damage) {
  std::vector<std::string> texts;
  if (damage.corrupt_regions > 0) {
    texts.push_back(fmt::format("{} corrupt bytes in {} region{}", damage.corrupt_bytes,
                                damage.corrupt_regions, damage.corrupt_regions == 1 ? "" : "s"));
  }
  if (damage.truncated_bytes > 0)
    texts.push_back(fmt::format("{} bytes of a truncated end", damage.truncated_bytes));
  if (damage.lost_messages > 0)
    texts.push_back(fmt::format("{} unreadable messages", damage.lost_messages));
  return texts;
}

std::size_t BagTopics::index_of(const BagTopic& topic) {
  const auto found = std::ranges::find(topics_, topic);
  const auto index = static_cast<std::size_t>(found - topics_.begin());
  if (found == topics_.end()) topics_.push_back(topic);
  return index;
}

std::string plain_type(std::string_view type) {
  constexpr std::string_view kMessages = "/msg/";
  const std::size_t at = type.find(kMessages);
  if (at == std::string_view::npos) return std::string(type);
  return fmt::format("{}/{}", type.substr(0, at), type.substr(at + kMessages.size()));
}

}  // namespace adit
