// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/types/procman.hpp"
#include "procs/supervisor/control/control_server.hpp"
#include "procs/supervisor/fleet.hpp"
#include "procs/supervisor/fleet_status.hpp"
#include "procs/supervisor/os/daemon.hpp"
#include "procs/supervisor/os/procfs.hpp"
#include "procs/supervisor/procman/local_deputy.hpp"
#include "procs/supervisor/supervisor_setup.hpp"

namespace adit {

/// Keeps the processes of this computer and, where it is in charge, has those of others kept. It
/// obeys the terminals of this computer, its start script and, as far as the configuration allows,
/// orders from the network; whoever orders can only start and stop what is in the list. The list is
/// read again on SIGHUP and for a terminal; where it is wrong, the old one stays.
///
/// Times are those of steady_us(), `utime` that of wall_utime().
class Supervisor {
 public:
  struct Changes {
    bool local = false;   ///< something has changed on this computer
    bool remote = false;  ///< there are new orders for others
    bool list = false;    ///< the process list was read again, for better or worse
  };

  /// Throws ConfigError for what cannot be, std::runtime_error where the socket cannot be had.
  explicit Supervisor(const SupervisorParams& params);

  /// To be called every few hundredths of a second.
  Changes advance(std::int64_t now_us);
  void measure(std::int64_t now_us);

  /// Orders from the network. Returns why one was refused, as a text of static storage; those
  /// beside it are obeyed. Orders for other computers are none of ours.
  std::string_view apply_orders(const ProcmanOrders& orders, std::int64_t now_us);
  void on_message(const ProcmanInfo& info, std::int64_t now_us) {
    fleet_.remotes().on_message(info, now_us);
  }
  void on_message(const ProcmanOutput& output) { fleet_.on_message(output); }
  void on_message(std::string_view channel, std::int64_t now_us) {
    fleet_.on_message(channel, now_us);
  }

  [[nodiscard]] ProcmanInfo info(std::int64_t utime) const;
  /// None where this supervisor is not in charge.
  [[nodiscard]] std::vector<ProcmanOrders> orders(std::int64_t utime);
  /// What processes have printed since, in pieces of less than 60 kB.
  [[nodiscard]] std::vector<ProcmanOutput> take_output(std::int64_t utime) {
    return relay_.take(fleet_.process_manager(), setup_.deputy, utime);
  }

  /// On which processes show that they are alive.
  [[nodiscard]] std::set<std::string> liveness_channels() const;

  /// What is not as it should be; empty where all is well.
  [[nodiscard]] std::string problem() const;
  /// Whether some process was given up.
  [[nodiscard]] bool any_process_failed() const { return any_failed(fleet_.process_manager()); }
  /// Why the process list could not be read again; empty where it could.
  [[nodiscard]] const std::string& list_error() const { return list_error_; }

 private:
  void reload_by_signal(std::int64_t now_us);
  std::string reload(std::int64_t now_us);
  ControlResponse handle_request(const std::vector<std::string>& words);
  void begin_script(const std::string& name);
  void change(const ScriptChange& change, std::int64_t now_us);

  SupervisorParams params_;
  SupervisorSetup setup_;
  OrderPolicy policy_;
  Fleet fleet_;
  HostMeter host_;
  HostLoad load_;
  FleetScript script_;
  OutputRelay relay_;
  Changes changes_;
  std::string list_error_;
  ReloadSignal reload_signal_;
  ServiceManager service_manager_;
  ControlServer control_server_;
};

}  // namespace adit
