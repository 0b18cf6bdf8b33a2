// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "common/service/service_manager.hpp"
#include "common/types/procman.hpp"
#include "procs/supervisor/control/control_server.hpp"
#include "procs/supervisor/fleet.hpp"
#include "procs/supervisor/fleet_status.hpp"
#include "procs/supervisor/os/daemon.hpp"
#include "procs/supervisor/os/procfs.hpp"
#include "procs/supervisor/procman/local_deputy.hpp"
#include "procs/supervisor/supervisor_setup.hpp"

namespace adit {

/// Manages the processes of this computer and, if it is in charge, orders the deputies of other
/// computers to manage theirs. Executes local control requests, the start script and, if the
/// configuration allows, orders from the network, all of which can only start and stop commands of
/// the list. The list is reloaded on SIGHUP and on request; if it is invalid, the old list stays in
/// use.
///
/// Times are those of steady_us(), `utime` that of wall_utime().
class Supervisor {
 public:
  struct Changes {
    bool local = false;   ///< a local process has changed
    bool remote = false;  ///< there are new orders for other deputies
    bool list = false;    ///< the process list was reloaded, or failed to
  };

  /// Throws ConfigError for an invalid configuration, std::runtime_error if the control socket
  /// cannot be created.
  explicit Supervisor(const SupervisorParams& params);

  /// Must be called every few 10 ms.
  Changes advance(std::int64_t now_us);
  void measure(std::int64_t now_us);

  /// Applies orders from the network; ignores orders for other deputies. Returns the reason of a
  /// rejected order, with static storage duration, or an empty string; the other orders are
  /// applied.
  std::string_view apply_orders(const ProcmanOrders& orders, std::int64_t now_us);
  void on_message(const ProcmanInfo& info, std::int64_t now_us) {
    fleet_.remotes().on_message(info, now_us);
  }
  void on_message(const ProcmanOutput& output) { fleet_.on_message(output); }
  void on_message(std::string_view channel, std::int64_t now_us) {
    fleet_.on_message(channel, now_us);
  }

  [[nodiscard]] ProcmanInfo info(std::int64_t utime) const;
  /// Empty if this supervisor is not in charge.
  [[nodiscard]] std::vector<ProcmanOrders> orders(std::int64_t utime);
  /// Output of local processes since the last call, in messages of less than 60 kB.
  [[nodiscard]] std::vector<ProcmanOutput> take_output(std::int64_t utime) {
    return relay_.take(fleet_.process_manager(), setup_.deputy, utime);
  }

  /// The deputy_id.
  [[nodiscard]] const std::string& name() const { return setup_.deputy; }

  /// The channels by which processes of the list show that they are alive and answer their input.
  [[nodiscard]] std::set<std::string> liveness_channels() const;

  /// The first problem: of a process, the list or a script. Empty if there is none.
  [[nodiscard]] std::string problem() const;
  /// Whether any local process is in the state kFailed.
  [[nodiscard]] bool any_process_failed() const { return any_failed(fleet_.process_manager()); }
  /// Why the last reload failed; empty if it did not.
  [[nodiscard]] const std::string& list_error() const { return list_error_; }

 private:
  void reload_by_signal(std::int64_t now_us);
  std::string reload(std::int64_t now_us);
  ControlResponse handle_request(const std::vector<std::string>& fields);
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
