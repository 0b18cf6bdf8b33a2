// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/stage_bus.hpp"
#include "common/messages/heartbeat.hpp"

namespace adit {

/// What every stage says of itself: its configuration at the start and each 10 s (CONFIG), that it
/// is alive each second (HEARTBEAT), what it did each 5 s (STAGE_STATS). In bus time and without
/// anything of the machine, so that a replay gives the same bytes.
///
///   NodeHost host(bus, {"mapping", version(), yaml});
///   MappingNode node(host.bus(), params);
class NodeHost {
 public:
  struct Stage {
    std::string name;
    std::string version;
    std::string yaml;  ///< the configuration in effect
  };

  /// `bus` must outlive this. Refusals of a new kind are told to `complaints` (may be null), one
  /// line each.
  NodeHost(Bus& bus, Stage stage, StageBus::Measure measure = StageBus::Measure::kNothing,
           std::ostream* complaints = nullptr);
  NodeHost(const NodeHost&) = delete;
  NodeHost& operator=(const NodeHost&) = delete;

  /// The bus to construct the node on.
  [[nodiscard]] Bus& bus() { return bus_; }

  /// Where the heartbeat gets the health of the node from; OK without.
  void set_health(std::function<Health()> health) { health_ = std::move(health); }

 private:
  void publish_config(std::int64_t utime);
  void publish_heartbeat(std::int64_t utime);
  void publish_stats(std::int64_t utime);
  void complain();

  StageBus bus_;
  Stage stage_;
  StageBus::Measure measure_;
  std::ostream* complaints_;
  std::function<Health()> health_;
  std::optional<std::int64_t> last_stats_utime_;
  std::vector<SubscriptionStats> last_stats_;
  std::set<std::string> told_;  // complaints that were made
};

}  // namespace adit
