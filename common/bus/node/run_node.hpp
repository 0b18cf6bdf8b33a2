// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/bus/node/node_host.hpp"

namespace adit {

using Configure = std::function<ConfiguredNode(const ConfigFile&)>;

/// What run_node does, apart from the type of the node.
int run_stage(const std::string& stage, const Configure& configure, int argc, char** argv);

/// All of a stage's `main`: reads --config, brings the node onto LCM and runs it until SIGINT or
/// SIGTERM. Returns 0 then, and 2, with one line on stderr, for a wrong command line, config,
/// device or network. `adit-<stage> --help` says more. See configure_node for what a node is.
template <class Node>
int run_node(const std::string& stage, int argc, char** argv) {
  const auto configure = [&](const ConfigFile& file) { return configure_node<Node>(stage, file); };
  return run_stage(stage, configure, argc, argv);
}

}  // namespace adit
