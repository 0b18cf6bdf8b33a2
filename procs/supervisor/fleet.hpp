// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "procs/supervisor/keeper.hpp"
#include "procs/supervisor/keeping/ordered_stops.hpp"
#include "procs/supervisor/keeping/script_run.hpp"
#include "procs/supervisor/orders/remote_deputies.hpp"
#include "procs/supervisor/orders/remote_output.hpp"
#include "procs/supervisor/site.hpp"

namespace adit {

/// All processes of the list, on this computer and on others, by their names.
class Fleet {
 public:
  Fleet(const SupervisorSite& site, const RestartPace& pace);

  /// Does to each what a script or a terminal wants. Throws std::invalid_argument, and does
  /// nothing, where a name is not in the list, or a process is another computer's and this
  /// supervisor is not in charge. Of several that are to stop, what depends on others goes first.
  void change(const ScriptChange& change, std::int64_t now_us);

  /// The list of the site is another than `before`: what runs here and has changed is stopped and
  /// started as it is now, what is gone is stopped.
  void relist(const ProcessList& before, std::int64_t now_us);

  [[nodiscard]] Standing standing(const std::string& id, std::int64_t now_us);

  /// Whether it is to be stopped, once what depends on it is.
  [[nodiscard]] bool stops_later(const std::string& id) const { return stops_.waits(id); }

  void heard(std::string_view channel, std::int64_t now_us);
  void heard(const ProcmanOutput& output) {
    remote_output_.heard(output, site_.list, site_.deputy);
  }
  /// What a process has printed; null where it is another computer's of which nothing was heard.
  [[nodiscard]] const OutputLog* output(const std::string& id);

  /// Whether anything has changed on this computer.
  bool advance(std::int64_t now_us);

  [[nodiscard]] const SupervisorSite& site() const { return site_; }
  [[nodiscard]] Keeper& keeper() { return keeper_; }
  [[nodiscard]] const Keeper& keeper() const { return keeper_; }
  [[nodiscard]] RemoteDeputies& remotes() { return remotes_; }

 private:
  void require_may_change(const std::string& id);
  void start(const std::string& id);
  void stop(const OrderedStops::Stop& stop, std::int64_t now_us);
  void stop_in_turn(const ListedCommand& command, bool and_start, std::int64_t now_us);
  void stop_due(std::int64_t now_us);

  const SupervisorSite& site_;
  Keeper keeper_;
  RemoteDeputies remotes_;
  RemoteOutput remote_output_;
  OrderedStops stops_;
};

}  // namespace adit
