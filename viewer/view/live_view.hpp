// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "common/bus/node/stop_signal.hpp"
#include "viewer/view/viewer_options.hpp"

namespace adit {

/// Serves what is on LCM, as it happens, until the signal. Publishes nothing on LCM. `on_ready`
/// gets the port in use. Throws std::runtime_error if LCM or the port cannot be used.
void run_live_view(const ViewerOptions& options, const std::string& lcm_url, const StopSignal& stop,
                   const std::function<void(std::uint16_t)>& on_ready);

}  // namespace adit
