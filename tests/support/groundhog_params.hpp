// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "sim/simulation/simulation_params.hpp"

namespace adit {

/// The parameters of a stage that is told of lasers, with those of the simulated robot.
template <class Params>
Params with_groundhog_lasers() {
  Params params;
  params.lasers = groundhog_lasers();
  return params;
}

}  // namespace adit
