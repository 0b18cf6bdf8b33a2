// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/bus/node_host.hpp"
#include "common/config/config.hpp"

namespace adit {

/// A node that runs, of whatever type.
class AnyNode {
 public:
  virtual ~AnyNode() = default;
  [[nodiscard]] virtual Health health() const = 0;
};

/// A node with its parameters, not yet on a bus.
struct ConfiguredNode {
  std::string stage;
  std::string yaml;  ///< the configuration in effect
  std::function<std::unique_ptr<AnyNode>(Bus&)> construct;
};

/// A node on a bus, with what every stage says of itself.
class HostedNode {
 public:
  /// `bus` must outlive this.
  HostedNode(Bus& bus, const ConfiguredNode& node,
             StageBus::Measure measure = StageBus::Measure::kNothing,
             std::ostream* complaints = nullptr);
  HostedNode(const HostedNode&) = delete;
  HostedNode& operator=(const HostedNode&) = delete;

 private:
  NodeHost host_;
  std::unique_ptr<AnyNode> node_;
};

/// A node with parameters at hand, and the YAML that says of them what others are to know. A node
/// has
///   using Params = ...;                      // visited as in common/config
///   Node(Bus& bus, const Params& params);
///   Health health() const;                   // where it knows better than "OK"
template <class Node>
ConfiguredNode configured_node(const std::string& stage, const std::string& yaml,
                               const typename Node::Params& params) {
  class NodeBox final : public AnyNode {
   public:
    NodeBox(Bus& bus, const typename Node::Params& params) : node_(bus, params) {}
    [[nodiscard]] Health health() const override {
      if constexpr (requires { node_.health(); }) return node_.health();
      return {};
    }

   private:
    Node node_;
  };

  return {stage, yaml, [params](Bus& bus) { return std::make_unique<NodeBox>(bus, params); }};
}

/// Takes the section of the stage from the file. Throws ConfigError.
template <class Node>
ConfiguredNode configure_node(const std::string& stage, const ConfigFile& file) {
  const auto params = load_section<typename Node::Params>(file, stage);
  return configured_node<Node>(stage, to_yaml(params, stage), params);
}

}  // namespace adit
