// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "common/bus/node/node_host.hpp"
#include "common/config/config_file.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// All stages of a mission, in the order in which they must be constructed on the bus of one
/// process. `lasers` and `vehicle` replace those of the stages' sections. Journals are written to
/// the folder `journals`; none if it is empty. Throws ConfigError.
std::vector<ConfiguredNode> configure_pipeline(const ConfigFile& config, const Lasers& lasers,
                                               const Vehicle& vehicle,
                                               const std::filesystem::path& journals);

}  // namespace adit
