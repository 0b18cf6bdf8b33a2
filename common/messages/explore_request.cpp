// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/explore_request.hpp"

#include "common/messages/checks.hpp"

namespace adit {
namespace {

std::string_view reason_to_refuse(const explore_request_t& message) {
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (message.id <= 0) return "id that is not positive";
  if (!is_way(message.remaining_m)) return "way that is none";
  if (message.blocked == 0) return {};
  if (!is_plausible_utime(message.blocked_utime)) return kImplausibleTime;
  if (message.blocked_stub < -1) return "target with a negative id";
  return is_way(message.reached_m) ? std::string_view{} : "way that is none";
}

}  // namespace

explore_request_t to_message(const ExploreRequest& request) {
  explore_request_t message;
  const BlockedVerdict verdict = request.blocked.value_or(BlockedVerdict{});
  message.utime = request.utime;
  message.id = request.id;
  message.remaining_m = request.remaining_m;
  message.homeward = static_cast<std::int8_t>(request.homeward);
  message.blocked = static_cast<std::int8_t>(request.blocked.has_value());
  message.blocked_utime = verdict.utime;
  message.blocked_stub = verdict.stub;
  message.reached_m = verdict.reached_m;
  message.evidence = verdict.evidence;
  message.doubtful = static_cast<std::int8_t>(verdict.doubtful);
  return message;
}

Result<ExploreRequest> from_message(const explore_request_t& message) {
  if (const auto reason = reason_to_refuse(message); !reason.empty()) return Refused{reason};
  ExploreRequest request{message.utime, message.id, message.remaining_m, message.homeward != 0, {}};
  if (message.blocked != 0) {
    request.blocked = {message.blocked_utime, message.blocked_stub, message.reached_m,
                       message.evidence, message.doubtful != 0};
  }
  return request;
}

}  // namespace adit
