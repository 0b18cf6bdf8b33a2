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

/// All stages of a mission, from scan matching to the sequence, in the order in which they are to
/// be constructed on a bus of one process. What the config file does not say of lasers and vehicle
/// is as given; journals grow in the folder, or nowhere where that is empty. Throws ConfigError.
std::vector<ConfiguredNode> configure_pipeline(const ConfigFile& config, const Lasers& lasers,
                                               const Vehicle& vehicle,
                                               const std::filesystem::path& journals);

}  // namespace adit
