// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "common/bus/node/stop_signal.hpp"
#include "viewer/view/viewer_options.hpp"

namespace adit {

/// Serves the logs of one mission, which clients play, until the signal. `on_ready` gets the port
/// in use. Throws std::runtime_error if a log or the port cannot be used.
void run_log_view(const ViewerOptions& options, const std::vector<std::filesystem::path>& logs,
                  const StopSignal& stop, const std::function<void(std::uint16_t)>& on_ready);

}  // namespace adit
