// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/hosted_node.hpp"

#include "common/bus/version.hpp"

namespace adit {

HostedNode::HostedNode(Bus& bus, const ConfiguredNode& node, StageBus::Measure measure,
                       std::ostream* complaints)
    : host_(bus, {node.stage, version(), node.yaml}, measure, complaints),
      node_(node.construct(host_.bus())) {
  host_.set_health([this] { return node_->health(); });
}

}  // namespace adit
