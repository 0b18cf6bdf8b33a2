// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// A type of message, as tests that go over all types need it.
struct MessageType {
  std::string name;     ///< "pose_t"
  std::string channel;  ///< one that it is on
  std::int64_t fingerprint = 0;
  std::vector<std::uint8_t> sample;  ///< the bytes of a good message

  /// What a stage does with the bytes: decodes and converts. The reason of refusal, or nothing.
  std::function<std::string_view(std::span<const std::uint8_t>)> process;

  std::string package = "adit";
};

/// Every type in lcmtypes/.
std::vector<MessageType> message_types();

}  // namespace adit
