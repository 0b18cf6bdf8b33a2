// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace adit::test {

/// The mission inside of a mission.html, read as the page does.
struct EmbeddedMission {
  struct Message {
    std::string topic;
    double time_s = 0.0;
    std::string bytes;
  };
  nlohmann::json header;
  std::vector<Message> messages;

  [[nodiscard]] std::vector<Message> of(const std::string& topic) const;
};

/// Throws std::runtime_error if there is none, or if it is damaged.
EmbeddedMission embedded_mission(const std::string& html);

}  // namespace adit::test
