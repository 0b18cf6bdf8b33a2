// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/picture/exploration_picture.hpp"
#include "procs/exploration/exploration.hpp"

namespace adit {

/// The exploration as it stands, to be drawn, with the way of the robot in map.
ExplorationPicture exploration_picture(const std::string& title, const Exploration& exploration,
                                       std::vector<Eigen::Vector2d> traversed_path = {});

}  // namespace adit
