// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/driving_state.hpp"

#include "common/messages/checks.hpp"

namespace adit {
namespace {

using Kind = DrivingState::Kind;

static_assert(static_cast<int>(Kind::kIdle) == driving_state_t::STATE_IDLE);
static_assert(static_cast<int>(Kind::kDriving) == driving_state_t::STATE_DRIVING);
static_assert(static_cast<int>(Kind::kWaiting) == driving_state_t::STATE_WAITING);
static_assert(static_cast<int>(Kind::kArrived) == driving_state_t::STATE_ARRIVED);
static_assert(static_cast<int>(Kind::kFailed) == driving_state_t::STATE_FAILED);

std::string_view reason_to_refuse(const driving_state_t& message) {
  const auto kind = Kind(message.state);
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.path_id < 0) return "negative id";
  if (kind < Kind::kIdle || kind > Kind::kFailed) return "unknown state";
  if (!is_way(message.progress_m) || !is_way(message.remaining_m)) return "way that is none";
  if (!std::isfinite(message.lateral_error_m)) return "lateral error is not finite";
  if (!std::isfinite(message.heading_error_rad)) return "heading error is not finite";
  return {};
}

}  // namespace

driving_state_t to_message(const DrivingState& state) {
  driving_state_t message;
  message.utime = state.utime;
  message.path_id = state.path_id;
  message.state = static_cast<std::int8_t>(state.kind);
  message.reason = state.reason;
  message.progress_m = state.progress_m;
  message.remaining_m = state.remaining_m;
  message.lateral_error_m = state.error.lateral_m;
  message.heading_error_rad = state.error.heading_rad;
  return message;
}

Result<DrivingState> from_message(const driving_state_t& message) {
  if (const auto reason = reason_to_refuse(message); !reason.empty()) return Refused{reason};
  return DrivingState{message.utime,
                      message.path_id,
                      Kind(message.state),
                      message.reason,
                      message.progress_m,
                      message.remaining_m,
                      {message.lateral_error_m, message.heading_error_rad}};
}

}  // namespace adit
