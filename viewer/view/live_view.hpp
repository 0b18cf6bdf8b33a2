// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "common/bus/node/stop_signal.hpp"
#include "common/bus/order_seal.hpp"
#include "viewer/view/order_service.hpp"
#include "viewer/view/viewer_options.hpp"

namespace adit {

/// Orders that a live view takes.
struct ViewerOrders {
  std::string token;  ///< of the clients
  SealParams seal = {};
  OrderService::ControlProcess control_process = {};
};

/// Serves what is on LCM, as it happens, until the signal. Publishes nothing on LCM without
/// `orders`. `on_ready` gets the port in use. Throws std::runtime_error if LCM or the port cannot
/// be used.
void run_live_view(const ViewerOptions& options, const std::string& lcm_url,
                   const std::optional<ViewerOrders>& orders, const StopSignal& stop,
                   const std::function<void(std::uint16_t)>& on_ready);

}  // namespace adit
