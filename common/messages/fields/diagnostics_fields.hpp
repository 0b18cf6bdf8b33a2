// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "adit/config_t.hpp"
#include "adit/heartbeat_t.hpp"
#include "adit/run_state_t.hpp"
#include "adit/seal_nonce_t.hpp"
#include "adit/sim_time_done_t.hpp"
#include "adit/sim_time_t.hpp"
#include "adit/stage_stats_t.hpp"

#include "common/messages/fields/fields.hpp"

/// The fields of the messages of stages about themselves and of a simulator, see Fields.
namespace adit {

constexpr const char* kNoStage = "no stage";

template <>
struct Fields<heartbeat_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("stage", m.stage, required(kName, kNoStage));
    field("health", m.health, code(heartbeat_t::HEALTH_FAULT, "unknown health"));
    field("reason", m.reason, kSentence);
    field("handled", m.handled, kCount);
    field("rejected", m.rejected, kCount);
    field("dropped", m.dropped, kCount);
  }
};

template <>
struct Fields<config_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("stage", m.stage, required(kName, kNoStage));
    field("version", m.version, kName);
    field("yaml", m.yaml, kLongText);
  }
};

template <>
struct Fields<stage_stats_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("stage", m.stage, required(kName, kNoStage));
    field("interval_s", m.interval_s, kDuration);
    field("n_subscriptions", m.n_subscriptions, kCount);
    field("channels", m.channels, kName);
    field("handled", m.handled, kCount);
    field("rejected", m.rejected, kCount);
    field("dropped", m.dropped, kCount);
    field("handler_mean_ms", m.handler_mean_ms, kMilliseconds.or_exactly(-1.0));
    field("handler_max_ms", m.handler_max_ms, kMilliseconds.or_exactly(-1.0));
  }
};

template <>
struct Fields<sim_time_t> {
  static void visit(auto& m, auto& field) { field("utime", m.utime, kTime); }
};

template <>
struct Fields<sim_time_done_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("stage", m.stage, required(kName, kNoStage));
  }
};

template <>
struct Fields<run_state_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("distance_travelled_m", m.distance_travelled_m, kDistance);
    field("failure", m.failure, kSentence);
  }
};

template <>
struct Fields<seal_nonce_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("nonce", m.nonce, kAny);
  }
};

}  // namespace adit
