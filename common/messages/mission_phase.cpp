// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/messages/mission_phase.hpp"

#include "common/messages/checks.hpp"
#include "common/messages/laser_channel.hpp"

namespace adit {
namespace {

static_assert(static_cast<int>(Phase::kWaiting) == phase_t::PHASE_WAITING);
static_assert(static_cast<int>(Phase::kExplore) == phase_t::PHASE_EXPLORE);
static_assert(static_cast<int>(Phase::kScan) == phase_t::PHASE_SCAN);
static_assert(static_cast<int>(Phase::kPlan) == phase_t::PHASE_PLAN);
static_assert(static_cast<int>(Phase::kExecute) == phase_t::PHASE_EXECUTE);
static_assert(static_cast<int>(Phase::kPaused) == phase_t::PHASE_PAUSED);
static_assert(static_cast<int>(Phase::kEnded) == phase_t::PHASE_ENDED);
static_assert(static_cast<int>(MissionOutcome::kUnderWay) == phase_t::OUTCOME_UNDER_WAY);
static_assert(static_cast<int>(MissionOutcome::kHome) == phase_t::OUTCOME_HOME);
static_assert(static_cast<int>(MissionOutcome::kStopped) == phase_t::OUTCOME_STOPPED);
static_assert(static_cast<int>(MissionOutcome::kStranded) == phase_t::OUTCOME_STRANDED);

std::string_view reason_to_refuse(const phase_t& message) {
  const auto phase = Phase(message.phase);
  const auto outcome = MissionOutcome(message.outcome);
  if (!is_plausible_utime(message.utime)) return kImplausibleTime;
  if (phase < Phase::kWaiting || phase > Phase::kEnded) return "unknown phase";
  if (outcome < MissionOutcome::kUnderWay || outcome > MissionOutcome::kStranded) {
    return "unknown outcome";
  }
  if (message.sequence < 0 || message.goal_id < 0 || message.scans < 0) return "negative count";
  if (message.stub < -1) return "target with a negative id";
  if (!is_way(message.travelled_m) || !is_way(message.remaining_m)) return "way that is none";
  return {};
}

}  // namespace

phase_t to_message(const MissionPhase& phase) {
  phase_t message;
  message.utime = phase.utime;
  message.sequence = phase.sequence;
  message.phase = static_cast<std::int8_t>(phase.phase);
  message.reason = phase.reason;
  message.homeward = static_cast<std::int8_t>(phase.homeward);
  message.homeward_reason = phase.homeward_reason;
  message.laser = laser_channel(phase.laser);
  message.goal_id = phase.goal_id;
  message.stub = phase.stub;
  message.scans = phase.scans;
  message.travelled_m = phase.travelled_m;
  message.remaining_m = phase.remaining_m;
  message.outcome = static_cast<std::int8_t>(phase.outcome);
  message.complete = static_cast<std::int8_t>(phase.complete);
  return message;
}

Result<MissionPhase> from_message(const phase_t& message) {
  if (const auto reason = reason_to_refuse(message); !reason.empty()) return Refused{reason};
  const auto laser = laser_of(message.laser);
  if (!laser) return Refused{kUnknownLaser};
  MissionPhase phase;
  phase.utime = message.utime;
  phase.sequence = message.sequence;
  phase.phase = Phase(message.phase);
  phase.reason = message.reason;
  phase.homeward = message.homeward != 0;
  phase.homeward_reason = message.homeward_reason;
  phase.laser = *laser;
  phase.goal_id = message.goal_id;
  phase.stub = message.stub;
  phase.scans = message.scans;
  phase.travelled_m = message.travelled_m;
  phase.remaining_m = message.remaining_m;
  phase.outcome = MissionOutcome(message.outcome);
  phase.complete = message.complete != 0;
  return phase;
}

}  // namespace adit
