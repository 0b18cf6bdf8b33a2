// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mission_order.hpp"

#include "common/messages/checks.hpp"

namespace adit {
namespace {

using Kind = MissionOrder::Kind;

static_assert(static_cast<int>(Kind::kPause) == mission_order_t::KIND_PAUSE);
static_assert(static_cast<int>(Kind::kGoOn) == mission_order_t::KIND_GO_ON);
static_assert(static_cast<int>(Kind::kComeHome) == mission_order_t::KIND_COME_HOME);
static_assert(static_cast<int>(Kind::kStop) == mission_order_t::KIND_STOP);

}  // namespace

mission_order_t to_message(const MissionOrder& order) {
  mission_order_t message;
  message.utime = order.utime;
  message.kind = static_cast<std::int8_t>(order.kind);
  return message;
}

Result<MissionOrder> from_message(const mission_order_t& message) {
  if (!is_plausible_utime(message.utime)) return Refused{kImplausibleTime};
  const auto kind = Kind(message.kind);
  if (kind < Kind::kPause || kind > Kind::kStop) return Refused{"unknown order"};
  return MissionOrder{message.utime, kind};
}

}  // namespace adit
