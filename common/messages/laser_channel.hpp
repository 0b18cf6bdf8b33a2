// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string_view>

#include "common/sensing/laser_id.hpp"

namespace adit {

/// The channel of a laser, which names it in messages.
inline std::string_view laser_channel(LaserId laser) {
  return laser == LaserId::kFront ? "LASER_FRONT" : "LASER_REAR";
}

/// Nothing for a channel that is no laser's.
inline std::optional<LaserId> laser_of(std::string_view channel) {
  if (channel == laser_channel(LaserId::kFront)) return LaserId::kFront;
  if (channel == laser_channel(LaserId::kRear)) return LaserId::kRear;
  return std::nullopt;
}

constexpr const char* kUnknownLaser = "unknown laser";

}  // namespace adit
