// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/message_fields.hpp"

namespace adit {

/// A message type with a sample, for tests that iterate over all types.
struct MessageType {
  std::string name;     ///< "pose_t"
  std::string channel;  ///< a channel of the type
  std::int64_t fingerprint = 0;
  std::vector<std::uint8_t> sample;  ///< the encoding of a valid message

  /// Decodes and converts like a stage. Returns the reason for rejection, or nothing.
  std::function<std::string_view(std::span<const std::uint8_t>)> process;

  /// Where its fields are in an encoded message.
  std::function<FieldLayout(std::span<const std::uint8_t>)> layout;

  std::string package = "adit";
};

/// Every type in lcmtypes/.
std::vector<MessageType> message_types();

}  // namespace adit
