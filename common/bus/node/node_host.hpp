// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/node/stage_bus.hpp"
#include "common/config/config.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

/// Publishes what every stage reports about itself: the configuration at the start and every 10 s
/// (CONFIG), a heartbeat every second (HEARTBEAT), statistics every 5 s (STAGE_STATS). In bus time
/// and independent of the computer, so that a replay gives the same bytes.
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

  /// `bus` must outlive this. The first rejection of each kind is written to `error_stream` (may be
  /// null), one line each.
  NodeHost(Bus& bus, Stage stage, StageBus::Measure measure = StageBus::Measure::kNothing,
           std::ostream* error_stream = nullptr);
  NodeHost(const NodeHost&) = delete;
  NodeHost& operator=(const NodeHost&) = delete;

  /// The bus on which the node is constructed.
  [[nodiscard]] Bus& bus() { return bus_; }

  /// Of each subscription of the stage, in the order of creation.
  [[nodiscard]] std::vector<SubscriptionStats> subscription_stats() const;

  /// Exceptions of the handlers and timers of the node.
  [[nodiscard]] const StageBus::Failures& failures() const { return bus_.failures(); }

  /// Sets the source of the health in the heartbeat; OK without. While it is OK, a handler that has
  /// failed makes the stage degraded, and so does a channel of which most messages are rejected.
  void set_health(std::function<Health()> health) { health_ = std::move(health); }

 private:
  /// What was written to error_stream_ last about something that is counted.
  struct Report {
    std::int64_t count = 0;
    std::optional<std::int64_t> utime;
  };

  void publish_config(std::int64_t utime);
  void publish_heartbeat(std::int64_t utime);
  void publish_stats(std::int64_t utime);
  [[nodiscard]] Health input_health();
  void report_rejections();
  void report_in_turn(std::int64_t utime, std::int64_t count, const std::string& text,
                      Report& last) const;

  StageBus bus_;
  Stage stage_;
  StageBus::Measure measure_;
  std::ostream* error_stream_;
  std::function<Health()> health_;
  std::optional<std::int64_t> last_stats_utime_;
  std::vector<SubscriptionStats> last_stats_;
  std::vector<SubscriptionStats> heartbeat_stats_;  ///< at the last heartbeat
  std::set<std::string> reported_;                  // rejections already written to error_stream_
  Report reported_failures_;
  Report reported_seals_;
};

/// Type-erased interface of a running node.
class NodeInterface {
 public:
  virtual ~NodeInterface() = default;
  [[nodiscard]] virtual Health health() const = 0;
};

/// A node with its parameters, not yet on a bus.
struct ConfiguredNode {
  std::string stage;
  std::string yaml;  ///< the configuration in effect
  std::function<std::unique_ptr<NodeInterface>(Bus&)> construct;
};

/// A node on a bus, with its NodeHost.
class HostedNode {
 public:
  /// `bus` must outlive this.
  HostedNode(Bus& bus, const ConfiguredNode& node,
             StageBus::Measure measure = StageBus::Measure::kNothing,
             std::ostream* error_stream = nullptr);
  HostedNode(const HostedNode&) = delete;
  HostedNode& operator=(const HostedNode&) = delete;

  /// Of each subscription of the stage, in the order of creation.
  [[nodiscard]] std::vector<SubscriptionStats> subscription_stats() const {
    return host_.subscription_stats();
  }
  /// Exceptions of the handlers and timers of the node.
  [[nodiscard]] const StageBus::Failures& failures() const { return host_.failures(); }

 private:
  NodeHost host_;
  std::unique_ptr<NodeInterface> node_;
};

/// A node type with its parameters and the YAML that is published for them. A node has
///   using Params = ...;                      // visited as in common/config
///   Node(Bus& bus, const Params& params);
///   Health health() const;                   // optional; OK without
template <class Node>
ConfiguredNode configured_node(const std::string& stage, const std::string& yaml,
                               const typename Node::Params& params) {
  class NodeAdapter final : public NodeInterface {
   public:
    NodeAdapter(Bus& bus, const typename Node::Params& params) : node_(bus, params) {}
    [[nodiscard]] Health health() const override {
      if constexpr (requires { node_.health(); }) return node_.health();
      return {};
    }

   private:
    Node node_;
  };

  return {stage, yaml, [params](Bus& bus) { return std::make_unique<NodeAdapter>(bus, params); }};
}

/// Loads the parameters from the section of the stage. Throws ConfigError.
template <class Node>
ConfiguredNode configure_node(const std::string& stage, const ConfigFile& file) {
  const auto params = load_section<typename Node::Params>(file, stage);
  return configured_node<Node>(stage, to_yaml(params, stage), params);
}

}  // namespace adit
