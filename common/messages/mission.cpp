// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mission.hpp"

#include "common/messages/fields/navigation_fields.hpp"
#include "common/messages/sensing.hpp"

namespace adit {
namespace {

using Kind = MissionOrder::Kind;

static_assert(static_cast<int>(Phase::kWaiting) == phase_t::PHASE_WAITING);
static_assert(static_cast<int>(Phase::kExplore) == phase_t::PHASE_EXPLORE);
static_assert(static_cast<int>(Phase::kScan) == phase_t::PHASE_SCAN);
static_assert(static_cast<int>(Phase::kPlan) == phase_t::PHASE_PLAN);
static_assert(static_cast<int>(Phase::kExecute) == phase_t::PHASE_EXECUTE);
static_assert(static_cast<int>(Phase::kPaused) == phase_t::PHASE_PAUSED);
static_assert(static_cast<int>(Phase::kEnded) == phase_t::PHASE_ENDED);
static_assert(static_cast<int>(MissionOutcome::kInProgress) == phase_t::OUTCOME_IN_PROGRESS);
static_assert(static_cast<int>(MissionOutcome::kHome) == phase_t::OUTCOME_HOME);
static_assert(static_cast<int>(MissionOutcome::kStopped) == phase_t::OUTCOME_STOPPED);
static_assert(static_cast<int>(MissionOutcome::kStranded) == phase_t::OUTCOME_STRANDED);
static_assert(static_cast<int>(MissionOutcome::kHomeUncertain) == phase_t::OUTCOME_HOME_UNCERTAIN);
static_assert(static_cast<int>(Kind::kPause) == mission_order_t::KIND_PAUSE);
static_assert(static_cast<int>(Kind::kResume) == mission_order_t::KIND_RESUME);
static_assert(static_cast<int>(Kind::kReturnHome) == mission_order_t::KIND_RETURN_HOME);
static_assert(static_cast<int>(Kind::kStop) == mission_order_t::KIND_STOP);

constexpr std::int32_t kNoFrontier = -1;
constexpr double kUnknownDistance = -1.0;

}  // namespace

phase_t to_message(const MissionPhase& phase) {
  phase_t message;
  message.utime = phase.utime;
  message.sequence = phase.sequence;
  message.phase = static_cast<std::int8_t>(phase.phase);
  message.reason = phase.reason;
  message.returning_home = static_cast<std::int8_t>(phase.returning_home);
  message.return_home_reason = phase.return_home_reason;
  message.laser = laser_channel(phase.laser);
  message.goal_id = phase.goal_id;
  message.frontier = phase.frontier.value_or(kNoFrontier);
  message.scans = phase.scans;
  message.distance_travelled_m = phase.distance_travelled_m;
  message.remaining_m = phase.remaining_m;
  message.outcome = static_cast<std::int8_t>(phase.outcome);
  message.complete = static_cast<std::int8_t>(phase.complete);
  message.home_within_m = phase.home_within_m.value_or(kUnknownDistance);
  return message;
}

Result<MissionPhase> from_message(const phase_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  const auto laser = laser_from_channel(message.laser);
  if (!laser) return Rejected{kUnknownLaser};
  MissionPhase phase;
  phase.utime = message.utime;
  phase.sequence = message.sequence;
  phase.phase = Phase(message.phase);
  phase.reason = message.reason;
  phase.returning_home = message.returning_home != 0;
  phase.return_home_reason = message.return_home_reason;
  phase.laser = *laser;
  phase.goal_id = message.goal_id;
  if (message.frontier != kNoFrontier) phase.frontier = message.frontier;
  phase.scans = message.scans;
  phase.distance_travelled_m = message.distance_travelled_m;
  phase.remaining_m = message.remaining_m;
  phase.outcome = MissionOutcome(message.outcome);
  phase.complete = message.complete != 0;
  if (message.home_within_m != kUnknownDistance) phase.home_within_m = message.home_within_m;
  return phase;
}

mission_order_t to_message(const MissionOrder& order) {
  mission_order_t message;
  message.utime = order.utime;
  message.kind = static_cast<std::int8_t>(order.kind);
  return message;
}

Result<MissionOrder> from_message(const mission_order_t& message) {
  if (const auto reason = implausible_field(message); !reason.empty()) return Rejected{reason};
  return MissionOrder{message.utime, Kind(message.kind)};
}

}  // namespace adit
