// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/bus/node/node_host.hpp"

namespace adit {

using Configure = std::function<ConfiguredNode(const ConfigFile&)>;

/// The part of run_node that does not depend on the type of the node.
int run_stage(const std::string& stage, const Configure& configure, int argc, char** argv);

/// The `main` of a stage: loads --config, runs the node on LCM until SIGINT or SIGTERM and returns
/// 0. Returns 2, with one line on stderr, for an error in the command line, configuration, device
/// or network. `adit-<stage> --help` lists the options; see configured_node for the requirements on
/// a node.
template <class Node>
int run_node(const std::string& stage, int argc, char** argv) {
  const auto configure = [&](const ConfigFile& file) { return configure_node<Node>(stage, file); };
  return run_stage(stage, configure, argc, argv);
}

}  // namespace adit
