// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "procman_lcm/deputy_info_t.hpp"
#include "procman_lcm/discovery_t.hpp"
#include "procman_lcm/orders_t.hpp"
#include "procman_lcm/output_t.hpp"

#include "common/messages/fields/fields.hpp"

/// The fields of the messages of procman, see Fields.
namespace adit {

inline constexpr Quantity kBytes{0.0, 1e18, "negative size of memory"};
inline constexpr Quantity kLoad{0.0, 1e5, "load is negative or not finite"};
inline constexpr Quantity kSignal{0.0, 64.0, "unknown stop signal"};
inline constexpr Quantity kStopTime{0.0, 86'400.0, "stop time is negative or not finite"};

template <>
struct Fields<procman_lcm::cmd_t> {
  static void visit(auto& m, auto& field) {
    field("command_id", m.command_id, required(kName, "command without a name"));
    field("exec_str", m.exec_str, kLongText);
    field("group", m.group, kName);
    field("auto_respawn", m.auto_respawn, kFlag);
    field("stop_signal", m.stop_signal, kSignal);
    field("stop_time_allowed", m.stop_time_allowed, kStopTime);
  }
};

template <>
struct Fields<procman_lcm::cmd_status_t> {
  static void visit(auto& m, auto& field) {
    field.part(m.cmd);
    field("pid", m.pid, kId.because("negative process id"));
    field("actual_runid", m.actual_runid, kAny);
    field("exit_code", m.exit_code, kAny);
    field("cpu_usage", m.cpu_usage, kLoad.because("processor usage is negative or not finite"));
    field("mem_vsize_bytes", m.mem_vsize_bytes, kBytes);
    field("mem_rss_bytes", m.mem_rss_bytes, kBytes);
  }
};

template <>
struct Fields<procman_lcm::deputy_info_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("deputy_id", m.deputy_id, required(kName, "no deputy"));
    field("cpu_load", m.cpu_load, kLoad);
    field("phys_mem_total_bytes", m.phys_mem_total_bytes, kBytes);
    field("phys_mem_free_bytes", m.phys_mem_free_bytes, kBytes);
    field("swap_total_bytes", m.swap_total_bytes, kBytes);
    field("swap_free_bytes", m.swap_free_bytes, kBytes);
    field("ncmds", m.ncmds, kCount);
    field.parts(m.cmds);
  }
};

template <>
struct Fields<procman_lcm::cmd_desired_t> {
  static void visit(auto& m, auto& field) {
    field.part(m.cmd);
    field("desired_runid", m.desired_runid, kAny);
    field("force_quit", m.force_quit, kFlag);
  }
};

template <>
struct Fields<procman_lcm::orders_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("deputy_id", m.deputy_id, required(kName, "no deputy"));
    field("sheriff_id", m.sheriff_id, required(kName, "no sheriff"));
    field("ncmds", m.ncmds, kCount);
    field.parts(m.cmds);
  }
};

template <>
struct Fields<procman_lcm::output_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("deputy_id", m.deputy_id, required(kName, "no deputy"));
    field("num_commands", m.num_commands, kCount);
    field("command_ids", m.command_ids, required(kName, "command without a name"));
    field("text", m.text, kLongText);
  }
};

template <>
struct Fields<procman_lcm::discovery_t> {
  static void visit(auto& m, auto& field) {
    field("utime", m.utime, kTime);
    field("transmitter_id", m.transmitter_id, kName);
    field("nonce", m.nonce, kAny);
  }
};

}  // namespace adit
