// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "common/bus/node/node_host.hpp"

namespace adit {

/// A node of the stage with this name, with its parameters from the file.
using Configure = std::function<ConfiguredNode(const ConfigFile&, const std::string& stage)>;

/// The part of run_node that does not depend on the type of the node. With `devices` the program
/// has an option that says for which of these it runs; the name of the stage is then
/// `<stage>_<device>`, so that each has a section and a heartbeat.
int run_stage(const std::string& stage, const std::vector<std::string>& devices,
              const Configure& configure, int argc, char** argv);

/// The `main` of a stage: loads --config, runs the node on LCM until SIGINT or SIGTERM and returns
/// 0. Returns 2, with one line on stderr, for an error in the command line, configuration, device
/// or network. `adit-<stage> --help` lists the options; see configured_node for the requirements on
/// a node.
template <class Node>
int run_node(const std::string& stage, int argc, char** argv) {
  const auto configure = [](const ConfigFile& file, const std::string& name) {
    return configure_node<Node>(name, file);
  };
  return run_stage(stage, {}, configure, argc, argv);
}

}  // namespace adit
